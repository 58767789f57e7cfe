#include "programs/godwit-sim/vehicle/autopilot/mode_table.hpp"

#include <set>

#include <gtest/gtest.h>

namespace godwit::sim {
namespace mode_table_test {

TEST(mode_table, names_and_numbers_are_unique) {
  for (const auto table : {rover_modes(), px4_modes(), copter_modes(), plane_modes()}) {
    std::set<std::uint32_t> numbers;
    std::set<std::string_view> names;
    for (const auto& each : table) {
      EXPECT_TRUE(numbers.insert(each.custom).second) << each.name;
      EXPECT_TRUE(names.insert(each.name).second) << each.name;
      EXPECT_EQ(find_mode(table, each.custom), &each);
    }
  }
}

TEST(mode_table, px4_has_the_numbers_that_were_recorded) {
  EXPECT_EQ(find_mode(px4_modes(), 50'593'792)->name, "AUTO.LOITER");
  EXPECT_EQ(find_mode(px4_modes(), 67'371'008)->name, "AUTO.MISSION");
  EXPECT_EQ(find_mode(px4_modes(), 67'371'008)->base, 29);
  EXPECT_EQ(px4_mode(4, 5), 0x5040000U);
  EXPECT_EQ(px4_mode(4, 2), 0x2040000U);
}

TEST(mode_table, each_has_the_modes_that_are_asked_for_by_kind) {
  for (const auto table : {rover_modes(), px4_modes(), copter_modes(), plane_modes()}) {
    EXPECT_TRUE(has_mode_of_kind(table, mode_kind::mission));
    EXPECT_TRUE(has_mode_of_kind(table, mode_kind::come_back));
    EXPECT_EQ(mode_of_kind(table, mode_kind::hold).kind, mode_kind::hold);
  }
  EXPECT_FALSE(has_mode_of_kind(rover_modes(), mode_kind::land));
  EXPECT_TRUE(has_mode_of_kind(px4_modes(), mode_kind::take_off));
  EXPECT_TRUE(has_mode_of_kind(copter_modes(), mode_kind::guided));
  EXPECT_FALSE(has_mode_of_kind(plane_modes(), mode_kind::land));
  EXPECT_EQ(mode_of_kind(plane_modes(), mode_kind::hold).name, "LOITER") << "not CIRCLE";
}

TEST(mode_table, an_unknown_number_is_no_mode) { EXPECT_EQ(find_mode(copter_modes(), 99), nullptr); }

} // namespace mode_table_test
} // namespace godwit::sim
