// The places of a mission are judged against home, whichever way the mission came; and the home for which a file was
// planned is compared with the vehicle's, and never flown to.
#include <gtest/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/station_plans.hpp"

namespace godwit::executor {
namespace places_flight_test {

using mission::progress_kind;
using tests::is_told;

class places : public testing::TestWithParam<sim::personality> {
protected:
  [[nodiscard]] static bool drives() { return GetParam() == sim::personality::rover; }
  // With latitude and longitude of w2 swapped.
  [[nodiscard]] static mission::document swapped_mission() {
    auto result = tests::short_mission(GetParam());
    for (auto& each : result.items)
      if (mission::id_of(each) == "w2")
        swap_place(each);
    return result;
  }
  static void swap_place(mission::item& each) {
    auto& at = std::get<mission::waypoint>(each).at;
    std::swap(at.latitude, at.longitude);
  }
};

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST_P(places, a_mission_with_latitude_and_longitude_swapped_is_never_armed) {
  flight_world world({.who = GetParam()});
  world.load(swapped_mission());
  ASSERT_TRUE(world.run_until([&] { return has(world.durable().preflight.reason, "swapped"); }, 60)) << world.story();
  EXPECT_TRUE(has(world.durable().preflight.reason, "'w2' is 5,650 km south-east of home")) << world.story();
  world.run_for(120);
  EXPECT_EQ(world.durable().status.now, phase::preflight) << world.story();
  EXPECT_FALSE(world.vehicle().describe().armed);
  EXPECT_EQ(world.orders(), 0) << "not even the plan is brought";
}

TEST_P(places, a_mission_11_km_high_is_never_armed) {
  flight_world world({.who = GetParam()});
  auto mission = tests::short_mission(GetParam());
  std::get<mission::waypoint>(mission.items[drives() ? 0 : 1]).at.altitude_m = 11'000;
  world.load(mission);
  if (drives()) { // it has no heights
    EXPECT_TRUE(world.run_until_phase(phase::flying, 60)) << world.story();
    return;
  }
  world.run_for(60);
  EXPECT_EQ(world.durable().status.now, phase::preflight) << world.story();
  EXPECT_TRUE(has(world.durable().preflight.reason, "'w1' is 11,000 m above home")) << world.durable().preflight.reason;
  EXPECT_EQ(world.orders(), 0);
}

TEST_P(places, a_plan_of_a_station_for_another_place_is_refused_at_once) {
  flight_world world(by_stations(GetParam()));
  world.run_for(10);
  auto items = station_items(GetParam());
  std::swap(items[2].x, items[2].y);
  world.station_says(taken(numbered(items)));
  ASSERT_FALSE(world.judged().empty());
  EXPECT_EQ(world.judged().back().verdict, ground_port::plan_verdict::refused);
  EXPECT_TRUE(was_said(world, "the plan is not taken: Item 3 'item-3' is 5,650 km south-east of home"))
      << world.story();
  EXPECT_FALSE(world.durable().mission);
}

TEST_P(places, a_plan_of_a_station_that_came_before_home_was_known_does_not_start) {
  flight_world world(by_stations(GetParam()));
  auto items = station_items(GetParam());
  std::swap(items[2].x, items[2].y);
  world.station_says(taken(numbered(items)));
  world.run_for(60);
  EXPECT_NE(world.durable().status.now, phase::ready) << world.story();
  world.station_says(start_of(world, numbered(items)));
  world.run_for(10);
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
}

TEST_P(places, an_assignment_in_flight_for_another_place_is_rejected_and_the_flight_goes_on) {
  flight_world world({.who = GetParam()});
  const auto mission = tests::short_mission(GetParam());
  ASSERT_TRUE(tests::fly_to(world, mission, progress_kind::reached, "w1")) << world.story();
  mission::assignment assignment;
  assignment.assignment_id = "11111111-2222-4333-8444-555555555555";
  assignment.base_revision = mission.revision;
  assignment.revision = mission.revision + 1;
  assignment.replace_after_item_id = "w2";
  assignment.items = {tests::place(GetParam(), "n1", 0, 0)};
  swap_place(assignment.items.front());
  world.assign(assignment);
  ASSERT_TRUE(world.run_until([&] { return !world.answers().empty(); }, 60)) << world.story();
  const auto& answer = world.answers().front().response;
  EXPECT_EQ(answer.outcome, mission::assignment_outcome::rejected);
  EXPECT_TRUE(has(answer.reason.value_or(""), "'n1' is 5,650 km south-east of home; at most 50 km are allowed "
                                              "(flight.max_distance_m); with latitude and longitude swapped"))
      << answer.reason.value_or("");
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_TRUE(is_told(world, progress_kind::reached, "w3")) << world.story();
}

TEST_P(places, an_assignment_on_the_ground_for_another_place_is_rejected_and_the_mission_before_stays) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until_phase(phase::ready, 60)) << world.story();
  mission::assignment assignment{"11111111-2222-4333-8444-555555555555",
                                 mission.revision,
                                 mission.revision + 1,
                                 "w2",
                                 {tests::place(GetParam(), "n1", 0, 0)}};
  swap_place(assignment.items.front());
  world.assign(assignment);
  ASSERT_TRUE(world.run_until([&] { return !world.answers().empty(); }, 20)) << world.story();
  EXPECT_EQ(world.answers().front().response.outcome, mission::assignment_outcome::rejected);
  EXPECT_EQ(world.durable().mission->items, mission.items);
  EXPECT_EQ(world.durable().status.now, phase::ready) << world.story();
}

TEST_P(places, a_revision_in_flight_for_another_place_is_refused_and_the_one_before_is_flown) {
  flight_world world({.who = GetParam()});
  const auto mission = tests::short_mission(GetParam());
  ASSERT_TRUE(tests::fly_to(world, mission, progress_kind::reached, "w1")) << world.story();
  auto next = swapped_mission();
  next.revision = mission.revision + 1;
  world.load(next);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_TRUE(was_said(world, "can not be flown, and the one before stays")) << world.story();
  EXPECT_TRUE(is_told(world, progress_kind::reached, "w3")) << world.story();
}

// What a file becomes whose home was planned elsewhere.
mission::document planned_elsewhere(sim::personality who) {
  auto result = tests::short_mission(who);
  const auto there = std::get<mission::waypoint>(tests::place("", 350, 0, 0)).at;
  result.planned_home = mission::planned_home{there.latitude, there.longitude, 488};
  result.return_point.reset();
  if (auto* back = std::get_if<mission::return_home>(&result.items.back()))
    back->to = mission::return_goal::home;
  return result;
}

TEST_P(places, a_planned_home_350_m_from_the_vehicles_waits_for_a_person_and_is_never_flown_to) {
  flight_world world({.who = GetParam()});
  const auto mission = planned_elsewhere(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until([&] { return world.durable().preflight.report.has_value(); }, 60)) << world.story();
  const auto& found = world.durable().preflight.report->sentences;
  EXPECT_TRUE(std::ranges::any_of(found, [](const auto& each) {
    return has(each, "planned home of the mission is 350 m north of the vehicle's");
  })) << world.story();
  world.run_for(20);
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
  ASSERT_TRUE(world.acknowledge()) << world.story();
  const geo::point there{mission.planned_home->latitude, mission.planned_home->longitude};
  double nearest_m = 1e9;
  const auto is_done = [&] {
    const auto at = world.vehicle().describe().where;
    nearest_m = std::min(nearest_m, geo::distance_m(there, {at.latitude_deg, at.longitude_deg}));
    return world.durable().status.now == phase::done;
  };
  ASSERT_TRUE(world.run_until(is_done, 900)) << world.story();
  if (GetParam() == sim::personality::plane) // it lands where its own way leads, by a long approach
    return;
  EXPECT_GT(nearest_m, 200) << "the mission itself keeps farther away";
  ASSERT_FALSE(world.durable().flown->items.empty());
  if (!drives()) {
    EXPECT_EQ(world.durable().flown->items.back().command, number(mav_cmd::nav_return_to_launch));
  }
}

INSTANTIATE_TEST_SUITE_P(each, places,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::rover,
                                         sim::personality::plane),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

} // namespace places_flight_test
} // namespace godwit::executor
