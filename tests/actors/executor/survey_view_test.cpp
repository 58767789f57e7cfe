#include "actors/executor/flight/watches/survey_view.hpp"

#include <gtest/gtest.h>

namespace survey_view_test {

using namespace godwit;
using namespace godwit::executor;

// Home is item 0; take-off 1; a survey of three lines from 2 to 7; a waypoint 8.
state in_survey_at(std::uint16_t current) {
  state s;
  s.status.now = phase::flying;
  s.status.in_flight = true;
  s.mission.emplace().mission_id = "m";
  s.mission->items = {mission::takeoff{"up", 20},
                      mission::survey{"field", {{47, 8}, {47, 8.01}, {47.01, 8}}, 20, 10, {}},
                      mission::waypoint{"w", {}, 0, 0, {}}};
  s.flown.emplace().mission = *s.mission;
  s.flown->surveys = {{1, 0, 2, 3}};
  auto& generation = s.progress.plan.emplace().generation;
  generation.number = 4;
  generation.is_armed = true;
  generation.current = current;
  return s;
}

TEST(survey_view, on_the_way_to_the_first_line_it_is_at_the_beginning_and_nothing_is_flown) {
  const auto seen = survey_progress_of(in_survey_at(2));
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->mission_id, "m");
  EXPECT_EQ(seen->item_id, "field");
  EXPECT_EQ(seen->generation, 4U);
  EXPECT_TRUE(seen->is_flying);
  EXPECT_TRUE(seen->is_at_beginning);
  EXPECT_EQ(seen->lines, 3U);
  EXPECT_EQ(seen->lines_done, 0U);
  EXPECT_EQ(seen->polygon.size(), 3U);
}

TEST(survey_view, a_line_is_done_when_the_vehicle_is_past_its_end) {
  EXPECT_EQ(survey_progress_of(in_survey_at(3))->lines_done, 0U);
  EXPECT_FALSE(survey_progress_of(in_survey_at(3))->is_at_beginning);
  EXPECT_EQ(survey_progress_of(in_survey_at(4))->lines_done, 1U);
  EXPECT_EQ(survey_progress_of(in_survey_at(7))->lines_done, 2U);
  EXPECT_EQ(survey_progress_of(in_survey_at(8))->lines_done, 3U);
}

TEST(survey_view, a_survey_that_ends_the_plan_is_done_when_the_plan_is) {
  auto s = in_survey_at(7);
  s.progress.plan->generation.is_finished = true;
  EXPECT_EQ(survey_progress_of(s)->lines_done, 3U);
}

TEST(survey_view, before_the_first_survey_there_is_none) {
  EXPECT_EQ(survey_progress_of(in_survey_at(1))->item_id, "");
}

TEST(survey_view, one_that_an_earlier_plan_began_is_not_at_its_beginning) {
  auto s = in_survey_at(2);
  s.flown->surveys[0].lines_before = 1;
  EXPECT_FALSE(survey_progress_of(s)->is_at_beginning);
  EXPECT_EQ(survey_progress_of(s)->lines, 4U);
}

TEST(survey_view, who_is_held_does_not_fly_it_and_on_the_ground_nothing_is_told) {
  auto s = in_survey_at(4);
  s.status.now = phase::paused;
  EXPECT_FALSE(survey_progress_of(s)->is_flying);
  s.status.in_flight = false;
  EXPECT_FALSE(survey_progress_of(s));
}

TEST(survey_view, a_mission_is_scanned_when_it_has_a_survey_or_as_it_is_set) {
  auto s = in_survey_at(2);
  EXPECT_TRUE(scans(s, scan_policy::with_survey));
  EXPECT_FALSE(scans(s, scan_policy::none));
  s.mission->items.erase(s.mission->items.begin() + 1);
  EXPECT_FALSE(scans(s, scan_policy::with_survey));
  EXPECT_TRUE(scans(s, scan_policy::all));
  s.mission.reset();
  EXPECT_FALSE(scans(s, scan_policy::all));
}

} // namespace survey_view_test
