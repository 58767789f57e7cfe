#include "tests/support/victim.hpp"

#include <array>
#include <cerrno>
#include <csignal>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace godwit::tests {

namespace {

using std::chrono::steady_clock;

constexpr std::chrono::seconds rest_of_pipe{20}; // a process that was killed closes its end at once

} // namespace

victim::victim(const std::string& program, const std::vector<std::string>& arguments) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    return;
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (auto& each : words)
    pointers.push_back(each.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  if (::posix_spawn(&pid_, program.c_str(), &actions, nullptr, pointers.data(), environ) != 0)
    pid_ = -1;
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  output_ = ends[0];
}

victim::~victim() {
  if (started()) {
    ::kill(pid_, SIGKILL);
    (void)reap();
  }
  if (output_ >= 0)
    ::close(output_);
}

void victim::wait_for_words(std::chrono::microseconds at_most) {
  read_until(steady_clock::now() + at_most, stop_at::first_words);
}

void victim::listen(std::chrono::microseconds time) { read_until(steady_clock::now() + time, stop_at::end_of_time); }

bool victim::kill() {
  if (!started()) // -1 would mean every process
    return false;
  ::kill(pid_, SIGKILL);
  const int status = reap();
  read_until(steady_clock::now() + rest_of_pipe, stop_at::end_of_time);
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
}

int victim::wait_for_end(std::chrono::microseconds at_most) {
  if (!started())
    return -1;
  read_until(steady_clock::now() + at_most, stop_at::end_of_time);
  if (!output_ended_)
    ::kill(pid_, SIGKILL);
  const int status = reap();
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void victim::read_until(steady_clock::time_point end, stop_at where) {
  std::array<char, 65536> buffer;
  while (!output_ended_) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - steady_clock::now());
    pollfd ready{output_, POLLIN, 0};
    if (left.count() <= 0)
      return;
    const int count = ::poll(&ready, 1, static_cast<int>(left.count()));
    if (count == 0)
      return;
    if (count < 0)
      continue; // interrupted
    const auto bytes = ::read(output_, buffer.data(), buffer.size());
    output_ended_ = bytes == 0 || (bytes < 0 && errno != EINTR);
    if (bytes > 0)
      said_.append(buffer.data(), static_cast<std::size_t>(bytes));
    if (bytes > 0 && where == stop_at::first_words)
      return;
  }
}

int victim::reap() {
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  return status;
}

} // namespace godwit::tests
