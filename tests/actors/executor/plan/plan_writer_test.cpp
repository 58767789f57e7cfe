#include "actors/executor/plan/plan_writer.hpp"

#include <gtest/gtest.h>

#include "actors/executor/plan/vehicle_items.hpp"
#include "tests/actors/executor/plan/missions.hpp"

namespace godwit::executor::plan {
namespace plan_writer_test {

TEST(plan_writer, a_speed_that_is_owed_stands_in_front_of_the_first_flight_behind_the_take_off) {
  plan_writer writer(px4_copter, at(0, 0, 0), false, 6.0);
  writer.begin_item("up", 0);
  writer.add_take_off(takeoff_item(at(0, 0, 30), px4_copter));
  writer.begin_item("w", 1);
  writer.add_nav(waypoint_item(at(100, 0, 30), 0, 0, px4_copter));
  const auto plan = writer.finished();
  EXPECT_EQ(commands_of(plan), (std::vector<int>{22, 178, 16}));
  EXPECT_EQ(plan.map.items[1].first_sequence, 1);
  EXPECT_EQ(plan.map.items[1].sequence_count, 2);
  EXPECT_EQ(plan.map.items[1].first_nav_sequence, 2);
}

TEST(plan_writer, home_that_is_set_again_is_an_ardupilots_first_item_and_belongs_to_no_item_of_the_mission) {
  for (auto setting : {ardupilot_copter, px4_copter}) {
    setting.is_home_set_again = true;
    const bool is_item = is_ardupilot(setting);
    plan_writer writer(setting, at(100, 0, 30), false, {});
    writer.begin_item("up", 0);
    writer.add_take_off(takeoff_item(at(100, 0, 30), setting));
    const auto plan = writer.finished();
    EXPECT_EQ(commands_of(plan), is_item ? (std::vector<int>{179, 22}) : (std::vector<int>{22}));
    EXPECT_EQ(plan.map.start_sequence, is_item ? 1 : 0);
    EXPECT_EQ(plan.map.total, is_item ? 2 : 1);
    EXPECT_EQ(plan.items.at(plan.map.start_sequence).current, 1);
    if (is_item) {
      EXPECT_EQ(plan.items[1].seq, 1);
      EXPECT_EQ(plan.items[1].x, plan.items[0].x);
      EXPECT_EQ(plan.items[1].z, plan.items[0].z) << "above the sea";
    }
    plan_writer in_flight(setting, at(100, 0, 30), true, {});
    in_flight.begin_item("w", 0);
    in_flight.add_nav(waypoint_item(at(0, 0, 30), 0, 0, setting));
    EXPECT_EQ(in_flight.finished().items.size(), is_item ? 2U : 1U);
  }
}

TEST(plan_writer, a_new_speed_ends_what_is_owed) {
  plan_writer writer(px4_copter, at(0, 0, 30), true, 6.0);
  writer.begin_item("slow", 0);
  writer.set_speed(3);
  writer.begin_item("w", 1);
  writer.add_nav(waypoint_item(at(100, 0, 30), 0, 0, px4_copter));
  EXPECT_EQ(commands_of(writer.finished()), (std::vector<int>{178, 16}));
  EXPECT_EQ(writer.speed_mps(), 3.0);
}

TEST(plan_writer, speeds_behind_the_last_flight_are_left_out) {
  plan_writer writer(ardupilot_copter, at(0, 0, 30), true, {});
  writer.begin_item("w", 0);
  writer.add_nav(waypoint_item(at(100, 0, 30), 0, 0, ardupilot_copter));
  writer.begin_item("a", 1);
  writer.set_speed(3);
  writer.begin_item("b", 2);
  writer.set_speed(4);
  const auto plan = writer.finished();
  EXPECT_EQ(commands_of(plan), (std::vector<int>{16}));
  EXPECT_EQ(plan.map.items[1].sequence_count, 0);
  EXPECT_EQ(plan.map.items[2].sequence_count, 0);
  EXPECT_EQ(plan.map.items[2].first_sequence, 2);
}

TEST(plan_writer, a_circle_is_a_polygon_around_it) {
  plan_writer writer(px4_plane, at(0, 0, 50), true, {});
  writer.begin_item("l", 0);
  writer.cruise_to(at(500, 0, 50));
  writer.circle(80);
  writer.add_nav(loiter_item(at(500, 0, 50), 10, 80, px4_plane));
  const geo::local_projection centre(tests::place(500, 0));
  int chords = 0;
  for (const auto& each : writer.finished().legs) {
    if (each.kind != leg_kind::circle)
      continue;
    const auto from = centre.to_local({each.from.latitude, each.from.longitude});
    const auto to = centre.to_local({each.to.latitude, each.to.longitude});
    EXPECT_NEAR(std::hypot((from.east_m + to.east_m) / 2, (from.north_m + to.north_m) / 2), 80, 0.01);
    ++chords;
  }
  EXPECT_EQ(chords, 16);
  EXPECT_EQ(writer.here(), at(500, 0, 50));
}

} // namespace plan_writer_test
} // namespace godwit::executor::plan
