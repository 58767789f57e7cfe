// A survey with a camera: where it is switched on and off, and what is left of it.
#include <gtest/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/executor/plan/builder.hpp"
#include "actors/executor/plan/places.hpp"
#include "actors/executor/plan/vehicle_items.hpp"
#include "actors/executor/plan/way_home.hpp"
#include "tests/actors/executor/plan/missions.hpp"

namespace godwit::executor::plan {
namespace survey_planner_test {

using commands = std::vector<int>;

const mission::takeoff up{"up", 20};

// Three lines of 200 m.
mission::document survey_with(const mission::survey_camera& camera) {
  auto area = survey_of("field", tests::box(100, 0, 300, 90), 30, 90);
  area.camera = camera;
  return mission_of({up, area, mission::return_home{"home"}});
}

const mission::survey_camera each_10_m{{10, {}}, {}, 0};

flight_plan plan_of(const mission::document& mission, const plan_setting& setting, const plan_from& from = {}) {
  const auto plans = build_plans(mission, setting, from);
  return plans ? plans->front() : flight_plan{};
}

TEST(survey_planner, pictures_are_taken_on_the_lines_and_not_between_them) {
  const auto plan = plan_of(survey_with(each_10_m), px4_copter);
  ASSERT_EQ(commands_of(plan), (commands{22, 16, 206, 16, 206, 16, 206, 16, 206, 16, 206, 16, 206, 20}));
  EXPECT_FLOAT_EQ(plan.items[2].param1, 10);
  EXPECT_FLOAT_EQ(plan.items[2].param3, 1) << "the first at once";
  EXPECT_FLOAT_EQ(plan.items[4].param1, 0);
  EXPECT_FLOAT_EQ(plan.items[4].param3, 1) << "and one at the end";
  EXPECT_FLOAT_EQ(plan.items[1].param2, 2) << "a PX4 would begin 10 m before the line";
  EXPECT_EQ(plan.map.items[1].pictures, 66U) << "two of them at the ends of each line";
}

TEST(survey_planner, a_trigger_by_the_micrometre_is_flown_and_counted_to_a_bound) {
  const auto plan = plan_of(survey_with({{1e-9, {}}, {}, 0}), px4_copter);
  EXPECT_EQ(plan.map.items.at(1).pictures, 3'000'006U);
}

TEST(survey_planner, pictures_by_time_are_begun_and_ended_by_the_camera) {
  const auto plan = plan_of(survey_with({{{}, 2}, {}, 0}), ardupilot_copter);
  ASSERT_GE(plan.items.size(), 6U);
  EXPECT_EQ(plan.items[3].command, 2000);
  EXPECT_FLOAT_EQ(plan.items[3].param2, 2);
  EXPECT_EQ(plan.items[5].command, 2001);
  EXPECT_EQ(plan.map.items[1].pictures, 0U) << "by time nobody can plan them";
}

TEST(survey_planner, a_gimbal_looks_down_before_the_first_line) {
  auto camera = each_10_m;
  camera.gimbal_pitch_deg = -90;
  const auto plan = plan_of(survey_with(camera), px4_copter);
  ASSERT_EQ(plan.items[1].command, 1000);
  EXPECT_FLOAT_EQ(plan.items[1].param1, -90);
  EXPECT_EQ(plan.surveys[0].first_line_sequence, 2);
}

TEST(survey_planner, lines_are_flown_on_before_and_after_the_turn) {
  auto camera = each_10_m;
  camera.turnaround_m = 25;
  const auto plan = plan_of(survey_with(camera), px4_copter);
  auto first = commands_of(plan);
  first.resize(7);
  ASSERT_EQ(first, (commands{22, 16, 16, 206, 16, 206, 16}));
  const auto place = [&](std::size_t i) { return geo::point{plan.items[i].x * 1e-7, plan.items[i].y * 1e-7}; };
  EXPECT_NEAR(geo::distance_m(place(1), place(2)), 25, 0.1);
  EXPECT_NEAR(geo::distance_m(place(2), place(4)), 200, 0.1);
  EXPECT_NEAR(geo::distance_m(place(1), place(6)), 250, 0.1);
  EXPECT_EQ(plan.map.items[1].pictures, 66U) << "none in the turns";
}

TEST(survey_planner, a_line_is_done_at_its_end_and_not_before) {
  for (const double turn_m : {0.0, 25.0}) {
    auto camera = each_10_m;
    camera.turnaround_m = turn_m;
    const auto plan = plan_of(survey_with(camera), px4_copter);
    const auto& survey = plan.surveys.at(0);
    ASSERT_EQ(survey.line_count, 3);
    const int entry = survey.first_line_sequence + (turn_m > 0 ? 1 : 0);
    const auto done = [&](int sequence) { return lines_done_at(survey, static_cast<std::uint16_t>(sequence)); };
    EXPECT_EQ(done(entry), 0U);
    EXPECT_EQ(done(entry + 2), 0U) << "on the line";
    EXPECT_EQ(done(entry + 4), 1U) << "after it";
    EXPECT_EQ(done(entry + 2 * survey.items_per_line + 2), 2U);
    EXPECT_EQ(done(entry + 3 * survey.items_per_line), 3U);
  }
}

// No picture is taken on the way back to the line that was left, and none is missing on it.
TEST(survey_planner, the_rest_of_a_survey_begins_at_its_line_with_the_camera_off) {
  const auto whole = plan_of(survey_with(each_10_m), px4_copter);
  auto setting = px4_copter;
  setting.is_under_way = true;
  setting.start = at(200, 50, 50);
  setting.stops_camera = camera_to_stop(whole.items, 7); // on its second line
  const auto rest = plan_of(survey_with(each_10_m), setting, {1, 1});
  ASSERT_EQ(commands_of(rest), (commands{206, 16, 206, 16, 206, 16, 206, 16, 206, 20}));
  EXPECT_FALSE(camera_to_stop(whole.items, 5)) << "between two lines";
  EXPECT_FLOAT_EQ(rest.items[0].param1, 0);
  EXPECT_FLOAT_EQ(rest.items[0].param3, 0) << "no picture where it is";
  EXPECT_EQ(rest.map.items[0].pictures, 44U);
  EXPECT_EQ(rest.map.items[0].first_sequence, 1) << "the end of the pictures belongs to no item";
  EXPECT_EQ(lines_done_at(rest.surveys.at(0), rest.surveys.at(0).first_line_sequence), 1U);
}

TEST(survey_planner, the_rest_of_a_survey_goes_on_with_its_line_where_the_last_picture_was_taken) {
  auto camera = each_10_m;
  camera.turnaround_m = 25;
  const auto whole = plan_of(survey_with(camera), px4_copter);
  const auto place = [](const flight_plan& plan, std::size_t i) {
    return geo::point{plan.items[i].x * 1e-7, plan.items[i].y * 1e-7};
  };
  const auto from = place(whole, 8); // the second line
  const auto bearing = geo::bearing_deg(from, place(whole, 10));
  const auto picture = geo::destination(from, bearing, 70);
  auto setting = px4_copter;
  setting.is_under_way = true;
  setting.start = at(200, 50, 50);
  plan_from rest_from{1, 1};
  rest_from.line = progress::begun_line{"field", {picture.latitude_deg, picture.longitude_deg}, {.taken = 30}};
  const auto rest = plan_of(survey_with(camera), setting, rest_from);
  auto first = commands_of(rest);
  ASSERT_GE(first.size(), 6U);
  first.resize(6);
  ASSERT_EQ(first, (commands{16, 16, 206, 16, 206, 16}));
  EXPECT_NEAR(geo::distance_m(place(rest, 0), geo::destination(from, bearing, 45)), 0, 0.2) << "straight to it";
  EXPECT_NEAR(geo::distance_m(place(rest, 1), picture), 0, 0.2);
  EXPECT_NEAR(geo::distance_m(place(rest, 3), place(whole, 10)), 0, 0.2);
  EXPECT_EQ(rest.map.items[0].pictures, 30U + 15 + 22);
  EXPECT_TRUE(rest.map.items[0].continues_line);
}

TEST(survey_planner, the_way_home_from_a_line_begins_with_the_end_of_its_pictures) {
  auto setting = ardupilot_copter;
  setting.is_under_way = true;
  EXPECT_EQ(commands_of(way_home({waypoint("turn", at(50, 0, 50))}, setting)), (commands{16, 20}));
  const auto whole = plan_of(survey_with(each_10_m), ardupilot_copter);
  setting.stops_camera = camera_to_stop(whole.items, 4); // to the end of its first line
  EXPECT_EQ(commands_of(way_home({waypoint("turn", at(50, 0, 50))}, setting)), (commands{206, 16, 20}));
}

} // namespace survey_planner_test
} // namespace godwit::executor::plan
