#include <gtest/gtest.h>

#include "programs/godwitd/checks/start_checks.hpp"
#include "tests/programs/godwitd/scratch.hpp"

namespace state_check_test {

using namespace godwit::daemon;
using godwit::test::scratch;

TEST(state_check, what_is_not_there_yet_is_no_objection) {
  const scratch folder;
  EXPECT_FALSE(objection_to_journal(folder.file("godwit.db")));
  EXPECT_FALSE(objection_to_map(folder.file("godwit.map.db")));
}

TEST(state_check, a_foreign_file_is_named) {
  const scratch folder;
  const auto notes = folder.write("notes", "these are my notes");
  for (const auto& objection : {objection_to_journal(notes), objection_to_map(notes)}) {
    ASSERT_TRUE(objection);
    EXPECT_NE(objection->find(notes), std::string::npos) << *objection;
  }
}

} // namespace state_check_test

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

namespace limit_check_test {

TEST(limit_check, what_is_too_little_is_named_with_what_is_needed) {
  EXPECT_FALSE(objection_to_limits(limits_now()));
  EXPECT_FALSE(objection_to_limits({least_address_space, least_descriptors}));
  EXPECT_NE(objection_to_limits({least_address_space - 1, 1'024})->find("ulimit -v"), std::string::npos);
  EXPECT_NE(objection_to_limits({least_address_space, 20})->find("ulimit -n"), std::string::npos);
}

} // namespace limit_check_test

} // namespace godwit::daemon
