// Kills a process that writes to a journal, at random, again and again on the same file.
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <map>
#include <random>
#include <sstream>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>

#include "runtime/journal/journal_reader.hpp"
#include "tests/runtime/journal/journal_fixture.hpp"

namespace godwit::tests {
namespace {

using namespace godwit::runtime;

int rounds() {
  const char* full = std::getenv("GODWIT_FULL");
  return full != nullptr && std::string(full) == "1" ? 200 : 20;
}

std::uint64_t seed() {
  const char* given = std::getenv("GODWIT_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : std::random_device{}();
}

// A running victim and the reading end of its standard output.
class victim {
public:
  explicit victim(const std::string& journal) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
      std::abort();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    std::string program = GODWIT_JOURNAL_VICTIM;
    std::string argument = journal;
    char* arguments[] = {program.data(), argument.data(), nullptr};
    if (::posix_spawn(&pid_, program.c_str(), &actions, nullptr, arguments, environ) != 0)
      pid_ = -1;
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    output_ = ends[0];
  }
  ~victim() { ::close(output_); }

  [[nodiscard]] bool running() const { return pid_ > 0; }

  // Reads until END or the end of the output.
  void read_until(std::chrono::steady_clock::time_point end, std::string& text) {
    char buffer[65536];
    for (;;) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
      pollfd ready{output_, POLLIN, 0};
      if (left.count() <= 0 || ::poll(&ready, 1, static_cast<int>(left.count())) <= 0)
        return;
      const auto count = ::read(output_, buffer, sizeof buffer);
      if (count <= 0)
        return;
      text.append(buffer, static_cast<std::size_t>(count));
      if (stop_at_first_)
        return;
    }
  }

  // Lets it work for TIME after its first acknowledgement, kills it, and returns all that it said.
  std::string kill_after(std::chrono::microseconds time) {
    std::string text;
    stop_at_first_ = true;
    read_until(std::chrono::steady_clock::now() + std::chrono::seconds(20), text);
    stop_at_first_ = false;
    read_until(std::chrono::steady_clock::now() + time, text);
    ::kill(pid_, SIGKILL);
    int status = 0;
    ::waitpid(pid_, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "it ended by itself, exit status " << WEXITSTATUS(status);
    read_until(std::chrono::steady_clock::now() + std::chrono::seconds(20), text);
    return text;
  }

private:
  pid_t pid_ = -1;
  int output_ = -1;
  bool stop_at_first_ = false;
};

void note_acknowledged(const std::string& text, std::map<std::string, std::int64_t>& highest, std::int64_t& count) {
  std::istringstream lines(text);
  std::string actor;
  std::int64_t number = 0;
  while (lines >> actor >> number) {
    ++count;
    highest[actor] = std::max(highest[actor], number);
  }
}

TEST(sigkill_test, loses_no_acknowledged_event_and_the_journal_stays_sound) {
  const auto started_with = seed();
  std::cout << "seed " << started_with << " (GODWIT_SEED runs it again)\n";
  std::mt19937_64 random(started_with);
  std::uniform_int_distribution<int> life_us(2'000, 40'000);
  scratch_folder folder;
  const auto path = folder.path("journal.db");
  std::map<std::string, std::int64_t> highest;
  std::int64_t acknowledged = 0;
  for (int round = 1; round <= rounds(); ++round) {
    SCOPED_TRACE("round " + std::to_string(round) + ", seed " + std::to_string(started_with));
    victim running(path);
    ASSERT_TRUE(running.running());
    note_acknowledged(running.kill_after(std::chrono::microseconds(life_us(random))), highest, acknowledged);
    auto journal = sqlite_journal::open({.path = path, .check = integrity_check::full});
    ASSERT_TRUE(journal) << journal.error().message();
    ASSERT_EQ((*journal)->status().run, static_cast<std::uint64_t>(2 * round))
        << "each opening counts, none starts anew";
    for (const auto& [actor, number] : highest) {
      const auto state = recover(**journal, actor, 1'000'000);
      ASSERT_TRUE(state) << state.error().message();
      ASSERT_GE(state->last_event, number) << "an acknowledged event of " << actor << " is lost";
      ASSERT_EQ(state->effects.size(), 1U) << "an event and its effect commit together";
      ASSERT_EQ(state->effects[0].id.event, state->last_event);
      // Without a gap: recover itself refuses one. The snapshot and the events after it make the whole count.
      const auto covered = state->snapshot ? state->snapshot->number : 0;
      ASSERT_EQ(covered + static_cast<std::int64_t>(state->events.size()), state->last_event);
    }
  }
  std::cout << rounds() << " rounds, " << acknowledged << " acknowledged events\n";
  EXPECT_GT(acknowledged, rounds());
}

} // namespace
} // namespace godwit::tests
