#include "programs/godwit-drill/flights/case_runner.hpp"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"
#include "runtime/assert.hpp"

namespace godwit::drill {
namespace {

using clock = std::chrono::steady_clock;

bool write_all(int to, const void* data, std::size_t size) {
  const auto* at = static_cast<const char*>(data);
  while (size > 0) {
    const auto written = ::write(to, at, size);
    if (written < 0 && errno == EINTR)
      continue;
    if (written <= 0)
      return false;
    at += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

bool read_all(int from, void* data, std::size_t size) {
  auto* at = static_cast<char*>(data);
  while (size > 0) {
    const auto got = ::read(from, at, size);
    if (got < 0 && errno == EINTR)
      continue;
    if (got <= 0)
      return false;
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

// The worker's side; it ends when nobody asks any more.
[[noreturn]] void work(int questions, int answers, const std::function<flight_outcome(std::size_t)>& fly) {
  std::uint64_t index = 0;
  while (read_all(questions, &index, sizeof index)) {
    const auto text = io::to_json(fly(index));
    const std::uint64_t size = text.size();
    if (!write_all(answers, &size, sizeof size) || !write_all(answers, text.data(), text.size()))
      break;
  }
  std::fflush(nullptr);
  ::_exit(0); // what was there before the fork is its parent's to end
}

class worker {
public:
  // OTHERS: ends of other workers' pipes, which this one must not hold open.
  worker(const std::function<flight_outcome(std::size_t)>& fly, const std::vector<int>& others) {
    int questions[2] = {};
    int answers[2] = {};
    GODWIT_ASSERT(::pipe(questions) == 0 && ::pipe(answers) == 0, "a worker has its pipes");
    std::fflush(nullptr);
    pid_ = ::fork();
    GODWIT_ASSERT(pid_ >= 0, "a worker can be forked");
    if (pid_ == 0) {
      for (const auto each : others)
        ::close(each);
      ::close(questions[1]);
      ::close(answers[0]);
      work(questions[0], answers[1], fly);
    }
    ::close(questions[0]);
    ::close(answers[1]);
    questions_ = questions[1];
    answers_ = answers[0];
  }
  worker(const worker&) = delete;
  worker& operator=(const worker&) = delete;
  ~worker() { (void)end(); }

  void ask(std::size_t index, clock::time_point until) {
    flying_ = index;
    until_ = until;
    const std::uint64_t number = index;
    (void)write_all(questions_, &number, sizeof number); // one that is gone shows by the end of its answers
  }
  // Nothing: it is gone.
  [[nodiscard]] std::optional<flight_outcome> take() {
    std::uint64_t size = 0;
    if (!read_all(answers_, &size, sizeof size))
      return std::nullopt;
    std::string text(size, '\0');
    if (!read_all(answers_, text.data(), text.size()))
      return std::nullopt;
    flight_outcome result;
    const auto read = io::read_json(nlohmann::json::parse(text), result);
    GODWIT_ASSERT(read.has_value(), "a worker's outcome reads as it was written");
    flying_.reset();
    return result;
  }
  void kill() { ::kill(pid_, SIGKILL); }
  // How it ended, as waitpid() says it.
  int end() {
    if (pid_ <= 0)
      return 0;
    ::close(questions_);
    ::close(answers_);
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return status;
  }

  [[nodiscard]] int questions() const { return questions_; }
  [[nodiscard]] int answers() const { return answers_; }
  [[nodiscard]] std::optional<std::size_t> flying() const { return flying_; }
  [[nodiscard]] bool is_late(clock::time_point now) const { return flying_ && now >= until_; }

private:
  pid_t pid_ = -1;
  int questions_ = -1;
  int answers_ = -1;
  std::optional<std::size_t> flying_;
  clock::time_point until_;
};

std::string sentence_of(int status) {
  if (WIFSIGNALED(status))
    return "its process was ended by signal " + std::to_string(WTERMSIG(status)) +
           "; its output stands above this table";
  return "its process ended by itself with " + std::to_string(WEXITSTATUS(status));
}

class runner {
public:
  runner(std::size_t count, const case_runner_options& options, const std::function<flight_outcome(std::size_t)>& fly,
         const std::function<void(std::size_t, flight_outcome)>& on_outcome)
      : count_(count), options_(options), fly_(fly), on_outcome_(on_outcome) {}

  void run() {
    const auto jobs = std::min<std::size_t>(std::max(options_.jobs, 1U), count_);
    for (std::size_t i = 0; i < jobs; ++i)
      workers_.push_back(begin_worker());
    for (auto& each : workers_)
      ask_next(*each);
    while (done_ < count_)
      wait();
  }

private:
  std::unique_ptr<worker> begin_worker() {
    std::vector<int> others;
    for (const auto& each : workers_)
      if (each)
        others.insert(others.end(), {each->questions(), each->answers()});
    return std::make_unique<worker>(fly_, others);
  }

  void ask_next(worker& whom) {
    if (next_ < count_)
      whom.ask(next_++, clock::now() + options_.most);
  }

  void wait() {
    std::vector<pollfd> ends;
    for (const auto& each : workers_)
      ends.push_back({each->answers(), POLLIN, 0});
    constexpr int look_every_ms = 500;
    (void)::poll(ends.data(), ends.size(), look_every_ms);
    for (std::size_t i = 0; i < workers_.size(); ++i)
      look_at(workers_[i], ends[i].revents != 0);
  }

  void look_at(std::unique_ptr<worker>& which, bool has_news) {
    const auto index = which->flying();
    if (!index)
      return;
    const bool is_late = !has_news && which->is_late(clock::now());
    if (is_late)
      which->kill();
    else if (!has_news)
      return;
    auto outcome = is_late ? std::nullopt : which->take();
    if (!outcome) {
      const auto status = which->end();
      outcome.emplace();
      outcome->flaws.push_back(is_late ? "it had no end after " + std::to_string(options_.most.count() / 1000) + " s"
                                       : sentence_of(status));
      which.reset();
      which = begin_worker();
    }
    ++done_;
    on_outcome_(*index, *std::move(outcome));
    ask_next(*which);
  }

  std::size_t count_;
  const case_runner_options& options_;
  const std::function<flight_outcome(std::size_t)>& fly_;
  const std::function<void(std::size_t, flight_outcome)>& on_outcome_;
  std::vector<std::unique_ptr<worker>> workers_;
  std::size_t next_ = 0;
  std::size_t done_ = 0;
};

} // namespace

void run_cases(std::size_t count, const case_runner_options& options,
               const std::function<flight_outcome(std::size_t index)>& fly,
               const std::function<void(std::size_t index, flight_outcome outcome)>& on_outcome) {
  runner(count, options, fly, on_outcome).run();
}

} // namespace godwit::drill
