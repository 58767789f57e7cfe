#include "programs/godwit-drill/flights/flight_drill.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace shrink_test {

using godwit::drill::not_needed_to_fail;
using faults = std::vector<std::uint64_t>;

bool has(const faults& which, std::uint64_t fault) { return std::ranges::find(which, fault) != which.end(); }

TEST(shrink, leaves_the_one_fault_that_fails_alone) {
  EXPECT_EQ(not_needed_to_fail(5, [](const faults& without) { return !has(without, 3); }), (faults{0, 1, 2, 4}));
}

TEST(shrink, leaves_faults_that_fail_together) {
  const auto fails = [](const faults& without) { return !has(without, 1) && !has(without, 4); };
  EXPECT_EQ(not_needed_to_fail(6, fails), (faults{0, 2, 3, 5}));
}

TEST(shrink, leaves_out_what_was_needed_beside_another_fault_only) {
  // 0 hides the flaw unless 2 is there, too.
  const auto fails = [](const faults& without) { return has(without, 0) == has(without, 2) || has(without, 0); };
  const auto result = not_needed_to_fail(3, fails);
  EXPECT_TRUE(fails(result));
  for (std::uint64_t fault = 0; fault < 3; ++fault) {
    auto more = result;
    more.push_back(fault);
    EXPECT_TRUE(has(result, fault) || !fails(more)) << fault;
  }
}

TEST(shrink, leaves_out_all_of_a_flight_that_fails_without_any) {
  EXPECT_EQ(not_needed_to_fail(3, [](const faults&) { return true; }), (faults{0, 1, 2}));
}

TEST(shrink, leaves_out_nothing_that_is_needed) {
  EXPECT_TRUE(not_needed_to_fail(3, [](const faults& without) { return without.empty(); }).empty());
  EXPECT_TRUE(not_needed_to_fail(0, [](const faults&) { return true; }).empty());
}

} // namespace shrink_test
