#include "programs/godwitd/service/crash_loop_guard.hpp"

#include <gtest/gtest.h>

#include "tests/programs/godwitd/scratch.hpp"

namespace crash_loop_guard_test {

using namespace godwit::daemon;
using godwit::test::scratch;
using namespace std::chrono_literals;

constexpr start_limits limits{3, 600s};

struct ledger_test : testing::Test {
  scratch folder;
  std::string file = folder.file("godwit.starts");

  // A run that nobody ends in order, as its process is gone.
  start_verdict crash(std::int64_t at_ms, const std::string& boot = "boot-1") const {
    return crash_loop_guard(file, limits).begin({boot, at_ms}, false);
  }
  // The same, and the journal says that a vehicle flies.
  start_verdict crash_in_flight(std::int64_t at_ms) const {
    return crash_loop_guard(file, limits).begin({"boot-1", at_ms}, true);
  }
  void end_fast(std::int64_t at_ms) const {
    crash_loop_guard ledger(file, limits);
    (void)ledger.begin({"boot-1", at_ms}, true);
    ledger.end_fast({"boot-1", at_ms});
  }
};

TEST_F(ledger_test, after_too_many_abnormal_ends_a_run_does_not_begin_and_says_what_to_do) {
  for (int n = 1; n <= 3; ++n)
    EXPECT_TRUE(crash(n * 1'000).may_start) << n;
  const auto verdict = crash(4'000);
  EXPECT_FALSE(verdict.may_start);
  EXPECT_NE(verdict.sentence.find("3 times"), std::string::npos) << verdict.sentence;
  EXPECT_NE(verdict.sentence.find(file), std::string::npos) << verdict.sentence;
  EXPECT_FALSE(crash(5'000).may_start) << "asking again is no way around";
  std::filesystem::remove(file);
  EXPECT_TRUE(crash(6'000).may_start);
}

TEST_F(ledger_test, a_run_that_ends_in_order_does_not_count) {
  for (int n = 1; n <= 20; ++n) {
    crash_loop_guard ledger(file, limits);
    ASSERT_TRUE(ledger.begin({"boot-1", n}, false).may_start);
    ledger.end_in_order();
  }
}

TEST_F(ledger_test, an_orderly_run_takes_no_crash_away) {
  EXPECT_TRUE(crash(1).may_start);
  EXPECT_TRUE(crash(2).may_start);
  crash_loop_guard orderly(file, limits);
  EXPECT_TRUE(orderly.begin({"boot-1", 3}, false).may_start);
  orderly.end_in_order();
  EXPECT_TRUE(crash(4).may_start);
  EXPECT_FALSE(crash(5).may_start);
}

TEST_F(ledger_test, what_is_long_ago_does_not_count) {
  for (int n = 1; n <= 20; ++n)
    EXPECT_TRUE(crash(n * 300'001).may_start) << n;
}

TEST_F(ledger_test, power_that_comes_and_goes_is_no_crash) {
  for (int n = 1; n <= 20; ++n)
    EXPECT_TRUE(crash(1'000, "boot-" + std::to_string(n)).may_start) << n;
}

TEST_F(ledger_test, a_file_that_is_none_of_ours_counts_for_nothing_and_is_replaced) {
  folder.write("godwit.starts", "boot-1\n1\nwhat\n2\n3\n4\n");
  EXPECT_TRUE(crash(10).may_start);
  EXPECT_EQ(scratch::read(file), "boot-1\n1\n10\n");
  folder.write("godwit.starts", std::string(100'000, '\xff'));
  EXPECT_TRUE(crash(10).may_start);
  EXPECT_EQ(scratch::read(file), "boot-1\n10\n");
}

TEST_F(ledger_test, a_folder_that_can_not_be_written_is_said_and_no_reason_not_to_start) {
  crash_loop_guard ledger(folder.file("no/godwit.starts"), limits);
  const auto verdict = ledger.begin({"boot-1", 1}, false);
  EXPECT_TRUE(verdict.may_start);
  EXPECT_NE(verdict.sentence.find("can not be written"), std::string::npos) << verdict.sentence;
  ledger.end_in_order();
}

TEST_F(ledger_test, zero_means_any_number_and_no_file) {
  for (int n = 1; n <= 20; ++n)
    EXPECT_TRUE(crash_loop_guard(file, {0, 600s}).begin({"boot-1", n}, false).may_start);
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(ledger_test, in_flight_no_number_of_abnormal_ends_refuses_a_start) {
  for (int n = 1; n <= 200; ++n)
    ASSERT_TRUE(crash_in_flight(n).may_start) << n;
}

TEST_F(ledger_test, in_flight_a_run_after_ten_abnormal_ends_is_reduced_and_says_so) {
  for (int n = 1; n <= 10; ++n)
    EXPECT_FALSE(crash_in_flight(n).is_reduced) << n;
  const auto verdict = crash_in_flight(11);
  EXPECT_TRUE(verdict.is_reduced);
  EXPECT_NE(verdict.sentence.find("10 times"), std::string::npos) << verdict.sentence;
  EXPECT_NE(verdict.sentence.find("ground_port"), std::string::npos) << verdict.sentence;
  EXPECT_FALSE(crash_in_flight(700'000).is_reduced) << "they are long ago";
}

TEST_F(ledger_test, a_fast_end_is_the_only_one_within_ten_minutes) {
  EXPECT_TRUE(crash_in_flight(1).may_end_fast) << "nobody has ended so";
  end_fast(2'000);
  EXPECT_FALSE(crash_in_flight(3'000).may_end_fast);
  EXPECT_FALSE(crash_in_flight(601'999).may_end_fast);
  EXPECT_TRUE(crash_in_flight(602'001).may_end_fast);
}

TEST_F(ledger_test, a_run_of_an_hour_that_ends_fast_counts_from_its_end_on) {
  constexpr std::int64_t hour_ms = 3'600'000;
  crash_loop_guard ledger(file, limits);
  (void)ledger.begin({"boot-1", 1'000}, true);
  ledger.end_fast({"boot-1", hour_ms});
  EXPECT_FALSE(crash_in_flight(hour_ms + 1'000).may_end_fast);
  EXPECT_TRUE(crash_in_flight(hour_ms + 600'001).may_end_fast);
}

TEST_F(ledger_test, a_fast_end_is_kept_when_a_later_run_ends_in_order) {
  end_fast(2'000);
  crash_loop_guard orderly(file, limits);
  EXPECT_TRUE(orderly.begin({"boot-1", 3'000}, false).may_start);
  orderly.end_in_order();
  EXPECT_FALSE(crash_in_flight(4'000).may_end_fast);
}

TEST_F(ledger_test, a_fast_end_is_kept_where_crashes_are_not_counted) {
  crash_loop_guard first(file, {0, 600s});
  EXPECT_TRUE(first.begin({"boot-1", 1}, true).may_end_fast);
  first.end_fast({"boot-1", 1});
  EXPECT_FALSE(crash_loop_guard(file, {0, 600s}).begin({"boot-1", 2}, true).may_end_fast);
}

TEST_F(ledger_test, without_a_file_nobody_ends_fast_because_the_next_run_would_not_know_of_it) {
  EXPECT_FALSE(crash_loop_guard(folder.file("no/godwit.starts"), limits).begin({"boot-1", 1}, true).may_end_fast);
}

TEST(boot_moment, this_moment_has_a_boot_and_goes_on) {
  const auto first = this_moment();
  const auto second = this_moment();
  EXPECT_FALSE(first.boot.empty());
  EXPECT_EQ(first.boot, second.boot);
  EXPECT_GT(first.at_ms, 0);
  EXPECT_LE(first.at_ms, second.at_ms);
}

} // namespace crash_loop_guard_test
