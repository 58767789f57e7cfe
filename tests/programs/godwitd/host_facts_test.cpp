#include "programs/godwitd/host_facts.hpp"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/programs/godwitd/scratch.hpp"

namespace host_facts_test {

using namespace godwit;
using namespace godwit::daemon;

class set_time final : public runtime::time_source {
public:
  [[nodiscard]] std::int64_t monotonic_ns() const noexcept override { return now_ns; }
  [[nodiscard]] std::int64_t wall_ns() const noexcept override { return now_ns; }
  std::int64_t now_ns = 7;
};

constexpr auto period_ns = std::chrono::nanoseconds(host_facts::period).count();

TEST(host_facts, the_system_is_asked_once_in_a_period_and_not_at_each_look) {
  set_time time;
  int asked = 0;
  host_facts facts([&] { return std::optional<std::uint64_t>(++asked); }, time);
  EXPECT_EQ(facts.free_bytes(), 1U);
  time.now_ns += period_ns - 1;
  EXPECT_EQ(facts.free_bytes(), 1U);
  time.now_ns += 1;
  EXPECT_EQ(facts.free_bytes(), 2U);
}

TEST(host_facts, what_the_system_does_not_say_is_not_known) {
  set_time time;
  host_facts facts([] { return std::optional<std::uint64_t>(); }, time);
  EXPECT_FALSE(facts.free_bytes());
}

TEST(free_bytes_beside, is_known_for_a_file_that_is_not_there_yet_and_for_no_folder_that_is_not) {
  const test::scratch folder;
  EXPECT_GT(free_bytes_beside(folder.file("journal.db")).value_or(0), 0U);
  EXPECT_FALSE(free_bytes_beside(folder.file("nowhere/journal.db")));
}

TEST(host_facts, a_program_that_was_exchanged_while_it_runs_is_seen_within_a_period) {
  set_time time;
  bool is_exchanged = false;
  host_facts facts([] { return std::optional<std::uint64_t>(); }, time, [&] { return is_exchanged; });
  EXPECT_FALSE(facts.is_program_exchanged());
  is_exchanged = true;
  time.now_ns += period_ns;
  EXPECT_TRUE(facts.is_program_exchanged());
}

// As dpkg does it: the new file is moved over the old one.
TEST(is_without_name, a_running_program_whose_file_was_replaced) {
  const test::scratch folder;
  const auto program = folder.file("program");
  std::filesystem::copy_file("/bin/sleep", program);
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl(program.c_str(), program.c_str(), "60", nullptr);
    ::_exit(127);
  }
  const auto link = "/proc/" + std::to_string(child) + "/exe";
  std::error_code failed;
  for (int i = 0; i < 1'000 && std::filesystem::read_symlink(link, failed) != program; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(std::filesystem::read_symlink(link, failed), program);
  EXPECT_FALSE(is_without_name(link));
  std::filesystem::copy_file("/bin/true", folder.file("program.new"));
  std::filesystem::rename(folder.file("program.new"), program);
  EXPECT_TRUE(is_without_name(link));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_FALSE(is_without_name(link)); // nobody runs
}

} // namespace host_facts_test
