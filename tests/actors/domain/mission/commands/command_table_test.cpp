#include "actors/domain/mission/commands/command_table.hpp"

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "actors/domain/mission/commands/command_policy.hpp"

namespace godwit::mission {
namespace command_table_test {

using enum vehicle_profile;

constexpr vehicle_profile all[] = {arducopter,      arduplane, quadplane,      ardurover,
                                   px4_multicopter, px4_vtol,  px4_fixed_wing, px4_rover};

item_answer answer_of(std::uint16_t id, vehicle_profile vehicle) { return command_of(id)->answer_of(vehicle); }

// Seen on the wire; each is one that the vehicles answer differently.
TEST(command_table, says_who_takes_a_command_who_passes_it_over_and_who_refuses_it) {
  EXPECT_EQ(answer_of(16, arducopter), item_answer::taken);
  EXPECT_EQ(answer_of(18, px4_multicopter), item_answer::refused);
  EXPECT_EQ(answer_of(18, ardurover), item_answer::taken);
  EXPECT_EQ(answer_of(21, ardurover), item_answer::skipped);
  EXPECT_EQ(answer_of(82, arducopter), item_answer::taken);
  EXPECT_EQ(answer_of(82, arduplane), item_answer::refused);
  EXPECT_EQ(answer_of(82, ardurover), item_answer::skipped);
  EXPECT_EQ(answer_of(205, ardurover), item_answer::skipped);
  EXPECT_EQ(answer_of(214, arducopter), item_answer::refused);
  EXPECT_EQ(answer_of(214, px4_rover), item_answer::taken);
  EXPECT_EQ(answer_of(3000, quadplane), item_answer::taken);
  EXPECT_EQ(answer_of(3000, arduplane), item_answer::skipped);
}

TEST(command_table, what_stops_motors_or_changes_the_mode_is_in_no_mission) {
  for (const std::uint16_t id : {185, 300, 400})
    EXPECT_EQ(command_of(id)->kind, command_class::never) << id;
}

TEST(command_table, what_can_not_be_judged_is_guarded) {
  for (const std::uint16_t id :
       {92, 176, 179, 187, 194, 207, 208, 210, 212, 213, 217, 218, 222, 223, 42701, 42702, 42703})
    EXPECT_EQ(command_of(id)->kind, command_class::guarded) << id;
}

TEST(command_table, every_row_has_its_number_and_a_name) {
  std::size_t rows = 0;
  for (unsigned id = 0; id <= std::numeric_limits<std::uint16_t>::max(); ++id)
    if (const auto* row = command_of(static_cast<std::uint16_t>(id))) {
      EXPECT_EQ(row->id, id);
      EXPECT_FALSE(row->name.empty()) << id;
      ++rows;
    }
  EXPECT_EQ(rows, 156U);
}

TEST(command_table, what_a_landing_makes_a_vehicle_forget_is_state_and_what_its_outputs_keep_is_not) {
  EXPECT_EQ(command_of(178)->state, command_state::speed);
  EXPECT_EQ(command_of(206)->state, command_state::trigger);
  EXPECT_EQ(command_of(195)->state, command_state::roi);
  EXPECT_EQ(command_of(205)->state, command_state::gimbal);
  for (const std::uint16_t id : {181, 183, 187, 211, 216})
    EXPECT_EQ(command_of(id)->state, command_state::none) << id;
}

TEST(command_policy, a_mission_holds_what_moves_acts_waits_and_jumps_and_some_vehicle_takes) {
  for (const std::uint16_t id : {16, 17, 18, 31, 82, 84, 85, 93, 112, 177, 183, 189, 195, 206, 211, 600, 3000})
    EXPECT_EQ(why_not_carried(id, {}), "") << id;
  EXPECT_EQ(why_not_carried(36, {}), "every vehicle refuses a mission with it");
}

TEST(command_policy, what_is_guarded_or_unknown_is_held_only_where_its_number_is_allowed) {
  for (const std::uint16_t id : {92, 179, 187, 207, 208, 218, 87, 12'345}) {
    EXPECT_NE(why_not_carried(id, {}).find("flight.allowed_commands allows it where it names " + std::to_string(id)),
              std::string::npos)
        << why_not_carried(id, {});
    EXPECT_EQ(why_not_carried(id, std::vector{id}), "") << id;
    EXPECT_NE(why_not_carried(id, std::vector<std::uint16_t>{1}), "") << id;
  }
}

TEST(command_policy, what_stops_motors_is_held_by_no_mission_whatever_is_allowed) {
  for (const std::uint16_t id : {185, 224, 300, 400})
    EXPECT_EQ(why_not_carried(id, std::vector{id}),
              "no mission may stop motors, change the mode, pause or start a mission");
}

TEST(command_table, a_number_without_a_row_is_unknown) {
  for (const std::uint16_t id : {0, 15, 87, 12345, 65535})
    EXPECT_EQ(command_of(id), nullptr) << id;
}

TEST(command_table, each_vehicle_takes_a_waypoint_and_has_a_name_of_its_own) {
  for (const auto vehicle : all) {
    EXPECT_EQ(answer_of(16, vehicle), item_answer::taken);
    EXPECT_EQ(io::value_of<vehicle_profile>(io::name_of(vehicle)), vehicle);
  }
}

} // namespace command_table_test
} // namespace godwit::mission
