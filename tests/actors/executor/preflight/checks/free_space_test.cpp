#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace free_space_test {

using namespace test;

constexpr std::uint64_t mib = 1024 * 1024;

result with(std::optional<std::uint64_t> bytes) {
  auto seen = good_facts();
  seen.journal.free_bytes = bytes;
  return check_free_space(seen, {});
}

TEST(free_space_check, passes_with_enough) { EXPECT_EQ(with(512 * mib).how, verdict::pass); }

TEST(free_space_check, degrades_when_the_disk_is_filling_and_says_the_same_however_much_is_left) {
  const auto found = with(512 * mib - 1);
  EXPECT_EQ(found.how, verdict::degraded);
  EXPECT_TRUE(has(found.sentence, "Less than 512 MiB")) << found.sentence;
  EXPECT_EQ(with(64 * mib), found);
}

TEST(free_space_check, degrades_when_it_is_not_known) { EXPECT_EQ(with(std::nullopt).how, verdict::degraded); }

TEST(free_space_check, fails_when_the_disk_is_all_but_full) {
  EXPECT_EQ(with(64 * mib - 1).how, verdict::fail);
  EXPECT_EQ(with(0).how, verdict::fail);
}

} // namespace free_space_test
} // namespace godwit::executor::preflight
