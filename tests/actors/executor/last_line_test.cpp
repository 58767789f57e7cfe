// The fences and rally points of a mission go to the vehicle as well: on the ground, after the plan and before the
// start, in the way of nothing.
#include "actors/domain/mission/convert/item_list_import.hpp"
#include "tests/actors/executor/station_plans.hpp"

namespace godwit::executor {
namespace last_line_test {

class last_line_of : public testing::TestWithParam<sim::personality> {
protected:
  [[nodiscard]] static flight_world::options with_last_line() {
    auto result = by_stations(GetParam());
    result.brings_last_line = true;
    return result;
  }
  [[nodiscard]] int fence_on_vehicle() { return world.vehicle().describe().fence_count; }
  [[nodiscard]] int rally_on_vehicle() { return world.vehicle().describe().rally_count; }
  [[nodiscard]] bool comes_to_have(int fence, int rally = 0) {
    return world.run_until([&] { return fence_on_vehicle() == fence && rally_on_vehicle() == rally; }, 30);
  }

  flight_world world{with_last_line()};
  upload items = station_items(GetParam());
};

upload rally_points(sim::personality who, const std::vector<double>& north_m = {10, 20}) {
  upload result;
  for (const double north : north_m) {
    auto each = waypoint_at(who, north, 0);
    each.command = number(mav_cmd::nav_rally_point);
    each.mission_type = number(mav_mission_type::rally);
    result.push_back(each);
  }
  return numbered(result);
}

TEST_P(last_line_of, the_fence_of_a_station_goes_to_the_vehicle_and_is_read_back_before_the_start) {
  world.station_says(taken(fence_around(GetParam(), 500), mav_mission_type::fence));
  ASSERT_TRUE(bring(world, items));
  ASSERT_TRUE(comes_to_have(4)) << world.story();
  world.run_for(1);
  EXPECT_TRUE(was_said(world, "the fence of the mission went to the vehicle as well (4 items)")) << world.story();
  const bool has_parameter = GetParam() != sim::personality::rover;
  EXPECT_EQ(was_said(world, "godwit sets no parameters"), has_parameter) << world.story();
  ASSERT_TRUE(fly_to_end(world, items)) << world.story();
  EXPECT_EQ(fence_on_vehicle(), 4);
}

TEST_P(last_line_of, the_rally_points_of_a_station_go_there_with_its_plan) {
  world.station_says(taken(rally_points(GetParam()), mav_mission_type::rally));
  EXPECT_EQ(rally_on_vehicle(), 0) << "not before there is a plan";
  ASSERT_TRUE(bring(world, items));
  ASSERT_TRUE(comes_to_have(0, 2)) << world.story();
  world.run_for(1);
  EXPECT_TRUE(was_said(world, "its returns lead to one of them")) << world.story();
}

// Seen of PX4: its return led to one of them, 33 m from home, and the flight counted as ended by a person.
TEST_P(last_line_of, a_return_of_the_plan_or_an_operator_that_ends_at_a_rally_point_is_complete) {
  for (const bool is_called : {false, true}) {
    flight_world flown{with_last_line()};
    flown.station_says(taken(rally_points(GetParam(), {40}), mav_mission_type::rally));
    if (GetParam() == sim::personality::rover && !is_called)
      continue; // its plan returns to no rally point
    ASSERT_TRUE(bring(flown, items)) << flown.story();
    ASSERT_TRUE(flown.run_until([&] { return flown.vehicle().describe().rally_count == 1; }, 30)) << flown.story();
    const auto place = rally_points(GetParam(), {40}).front();
    const auto north = [&] { return flown.vehicle().describe().where.latitude_deg - place.x * 1e-7; };
    ASSERT_TRUE(fly_two_items(flown, items)) << flown.story();
    ASSERT_TRUE(flown.run_until([&] { return north() > 0; }, 600)) << flown.story();
    if (is_called) {
      ASSERT_TRUE(flown.say(operators::command_kind::come_home).is_taken) << flown.sentence();
    }
    ASSERT_TRUE(flown.run_until_phase(is_called ? phase::aborted : phase::done)) << flown.story();
    EXPECT_FALSE(was_said(flown, "moved the vehicle's home")) << flown.story();
    if (GetParam() != sim::personality::plane) {      // which lands as its plan says, or circles
      EXPECT_NEAR(north(), 0, 5e-5) << flown.story(); // 5 m
    }
  }
}

TEST_P(last_line_of, what_is_cleared_with_the_plan_is_cleared_on_the_vehicle) {
  world.station_says(taken(fence_around(GetParam(), 500), mav_mission_type::fence));
  world.station_says(taken(rally_points(GetParam()), mav_mission_type::rally));
  ASSERT_TRUE(bring(world, items));
  ASSERT_TRUE(comes_to_have(4, 2)) << world.story();
  world.run_for(1);
  for (const auto type : {mav_mission_type::mission, mav_mission_type::fence, mav_mission_type::rally})
    world.station_says(plan_cleared{type, {255, 190}});
  ASSERT_TRUE(comes_to_have(0)) << world.story();
  EXPECT_FALSE(world.durable().mission);
}

TEST_P(last_line_of, a_fence_that_is_cleared_alone_is_cleared_on_the_vehicle_before_the_next_start) {
  world.station_says(taken(fence_around(GetParam(), 500), mav_mission_type::fence));
  ASSERT_TRUE(bring(world, items));
  ASSERT_TRUE(comes_to_have(4)) << world.story();
  world.station_says(plan_cleared{mav_mission_type::fence, {255, 190}});
  ASSERT_TRUE(comes_to_have(0)) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  ASSERT_TRUE(fly_to_end(world, items));
  EXPECT_FALSE(was_said(world, "the vehicle keeps the fence")) << world.story();
}

TEST_P(last_line_of, the_point_to_which_a_breach_leads_goes_to_the_vehicle_with_its_fence) {
  auto fence = fence_around(GetParam(), 500);
  auto point = tests::waypoint_at(GetParam(), 0, 0);
  point.command = io::mavlink::number(io::mavlink::mav_cmd::nav_fence_return_point);
  fence.push_back(point);
  world.station_says(taken(tests::numbered(fence), mav_mission_type::fence));
  ASSERT_TRUE(bring(world, items));
  ASSERT_TRUE(comes_to_have(5)) << world.story();
}

TEST_P(last_line_of, what_somebody_else_has_put_there_is_left_alone_where_the_mission_has_none) {
  ASSERT_TRUE(bring(world, items));
  world.run_for(2);
  const auto orders = world.last_line_orders();
  EXPECT_EQ(orders, 0) << world.story();
  world.station_says(plan_cleared{mav_mission_type::mission, {255, 190}});
  world.run_for(5);
  EXPECT_EQ(world.last_line_orders(), 0) << world.story();
}

TEST_P(last_line_of, a_vehicle_that_takes_none_flies_all_the_same) {
  world.lose_fences(true);
  world.station_says(taken(fence_around(GetParam(), 500), mav_mission_type::fence));
  ASSERT_TRUE(bring(world, items));
  world.station_says(start_of(world, items));
  ASSERT_TRUE(world.run_until([&] { return !world.start_answers().empty(); }, 10)) << world.story();
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::started);
  EXPECT_TRUE(was_said(world, "the fence is not surely on the vehicle, and godwit alone watches it")) << world.story();
  EXPECT_EQ(world.guarded().size(), 1U);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

TEST_P(last_line_of, an_automatic_start_waits_for_it_and_not_for_long) {
  auto wanted = with_last_line();
  wanted.start = start_policy::automatic;
  for (const bool is_lost : {false, true}) {
    flight_world automatic(wanted);
    automatic.lose_fences(is_lost);
    automatic.station_says(taken(fence_around(GetParam(), 500), mav_mission_type::fence));
    automatic.station_says(taken(items));
    ASSERT_TRUE(automatic.run_until_phase(phase::flying, 60)) << automatic.story();
    EXPECT_EQ(automatic.vehicle().describe().fence_count, is_lost ? 0 : 4) << automatic.story();
  }
}

TEST_P(last_line_of, an_armed_vehicle_and_one_that_a_person_has_are_brought_none) {
  ASSERT_TRUE(bring(world, items));
  (void)world.station_does(act_kind::arm, {254, 190});
  world.station_says(taken(fence_around(GetParam(), 500), mav_mission_type::fence));
  world.arm_by_hand();
  world.run_for(10);
  EXPECT_EQ(fence_on_vehicle(), 0) << world.story();
  EXPECT_EQ(world.last_line_orders(), 0);
}

TEST_P(last_line_of, in_flight_the_vehicle_keeps_the_fence_with_which_it_took_off) {
  world.station_says(taken(fence_around(GetParam(), 500), mav_mission_type::fence));
  ASSERT_TRUE(bring(world, items));
  ASSERT_TRUE(comes_to_have(4)) << world.story();
  ASSERT_TRUE(fly_two_items(world, items));
  const auto orders = world.last_line_orders();
  world.station_says(taken(fence_around(GetParam(), 400), mav_mission_type::fence));
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.last_line_orders(), orders) << world.story();
}

TEST_P(last_line_of, a_crash_while_it_is_brought_leaves_a_plan_that_can_be_prepared_and_a_fence_that_can_be_cleared) {
  world.station_says(taken(fence_around(GetParam(), 500), mav_mission_type::fence));
  world.station_says(taken(items));
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.crash_all();
  ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::restarted; }, 20));
  ASSERT_TRUE(world.say(operators::command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  ASSERT_TRUE(comes_to_have(4)) << world.story();
  world.run_for(1);
  for (const auto type : {mav_mission_type::mission, mav_mission_type::fence})
    world.station_says(plan_cleared{type, {255, 190}});
  ASSERT_TRUE(comes_to_have(0)) << world.story();
}

TEST_P(last_line_of, the_fences_of_a_service_go_there_too_unless_it_is_set_otherwise) {
  for (const bool is_set : {true, false}) {
    flight_world other({.who = GetParam(), .start = start_policy::on_command, .brings_last_line = is_set});
    auto mission = tests::short_mission(GetParam());
    mission.geofences = mission::import_fence_list(fence_around(GetParam(), 500))->geofences;
    other.load(mission);
    ASSERT_TRUE(other.run_until_phase(phase::ready)) << other.story();
    other.run_for(5);
    EXPECT_EQ(other.vehicle().describe().fence_count, is_set ? 4 : 0) << other.story();
  }
}

// By its own fence the vehicle would have to be inside of all of them, and the mission means one of them.
TEST_P(last_line_of, several_inclusions_of_a_mission_stay_with_godwit_and_that_is_said) {
  flight_world other({.who = GetParam(), .start = start_policy::on_command});
  auto mission = tests::short_mission(GetParam());
  for (const double half_side_m : {500.0, 600.0})
    mission.geofences.push_back(mission::import_fence_list(fence_around(GetParam(), half_side_m))->geofences.front());
  other.load(mission);
  ASSERT_TRUE(other.run_until_phase(phase::ready)) << other.story();
  other.run_for(5);
  EXPECT_EQ(other.vehicle().describe().fence_count, 0) << other.story();
  EXPECT_EQ(other.last_line_orders(), 0);
  EXPECT_TRUE(was_said(other, "godwit alone watches the others")) << other.story();
  ASSERT_TRUE(other.say(operators::command_kind::start).is_taken);
  ASSERT_TRUE(other.run_until_phase(phase::flying)) << other.story();
  EXPECT_EQ(other.guarded().size(), 2U);
}

INSTANTIATE_TEST_SUITE_P(each, last_line_of,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::rover,
                                         sim::personality::plane),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

} // namespace last_line_test
} // namespace godwit::executor
