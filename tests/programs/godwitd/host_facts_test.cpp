#include "programs/godwitd/host_facts.hpp"

#include <gtest/gtest.h>

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

} // namespace host_facts_test
