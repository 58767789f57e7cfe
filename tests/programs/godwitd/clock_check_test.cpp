#include "programs/godwitd/clock_check.hpp"

#include <gtest/gtest.h>

namespace godwit::daemon {
namespace clock_check_test {

constexpr std::int64_t year_s = 31'557'600;

TEST(clock_check, a_clock_that_is_years_off_is_no_reason_not_to_start) {
  EXPECT_FALSE(objection_to_clock(clock_now()));
  EXPECT_FALSE(objection_to_clock({0, 0})) << "a computer without a battery begins in 1970";
  EXPECT_FALSE(objection_to_clock({100 * year_s, 5 * year_s}));
}

TEST(clock_check, beyond_what_64_bits_of_nanoseconds_hold_it_says_so) {
  EXPECT_TRUE(objection_to_clock({350 * year_s, 0}));
  EXPECT_TRUE(objection_to_clock({0, 300 * year_s})) << "the clock of the timers";
}

} // namespace clock_check_test
} // namespace godwit::daemon
