// What people are shown of a flight is what is flown, and what the checks have found.
#include "actors/executor/people_views.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace people_views_test {

using sim::personality;
using tests::flight_world;

class people_views : public testing::TestWithParam<personality> {};

vehicle_view vehicle_at(double latitude, double longitude) {
  vehicle_view result;
  io::mavlink::home_position m;
  m.latitude = static_cast<std::int32_t>(latitude * 1e7);
  m.longitude = static_cast<std::int32_t>(longitude * 1e7);
  m.altitude = 488'000;
  result.take(m, 1);
  return result;
}

TEST_P(people_views, the_plan_is_the_mission_and_the_way_through_the_items_on_the_vehicle) {
  flight_world world({.who = GetParam()});
  const auto mission = tests::short_mission(GetParam());
  EXPECT_FALSE(plan_view_of(world.durable(), {}).mission);
  world.load(mission);
  ASSERT_TRUE(world.run_until_phase(phase::flying, 60)) << world.story();
  const auto shown = plan_view_of(world.durable(), vehicle_at(47.4, 8.5));
  ASSERT_TRUE(shown.mission);
  EXPECT_EQ(shown.mission->mission_id, mission.mission_id);
  EXPECT_EQ(shown.generation, world.durable().progress.last_generation);
  ASSERT_GE(shown.way.size(), 2U);
  EXPECT_LE(shown.way.size(), world.durable().flown->items.size());
  for (const auto& each : shown.way) {
    EXPECT_NEAR(each.latitude, mission.return_point->latitude, 0.1);
    EXPECT_NEAR(each.longitude, mission.return_point->longitude, 0.1);
  }
  for (const auto& each : world.durable().flown->items)
    EXPECT_TRUE(each.x == 0 || std::ranges::any_of(shown.way,
                                                   [&](const auto& at) {
                                                     return at.latitude == each.x / 1e7 && at.longitude == each.y / 1e7;
                                                   }))
        << "coordinates keep their digits";
  ASSERT_TRUE(shown.home);
  EXPECT_NEAR(shown.home->latitude, 47.4, 1e-6);
  EXPECT_NEAR(shown.home->above_sea_m, 488, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, people_views,
                         testing::Values(personality::rover, personality::px4, personality::ardupilot),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

TEST(people_views_of_checks, a_report_is_named_only_while_it_waits_for_an_acknowledgement) {
  preflight::state s;
  s.now = preflight::phase::awaiting_ack;
  s.report = preflight::open_report{7, {"the map is old"}, 0, {}};
  EXPECT_EQ(preflight_view_of(s, {}).report, 7U);
  s.now = preflight::phase::pass;
  s.report->acknowledged_by = "anna";
  const auto acknowledged = preflight_view_of(s, {});
  EXPECT_EQ(acknowledged.report, 0U);
  EXPECT_EQ(acknowledged.acknowledged_by, "anna");
}

TEST(people_views_of_checks, all_findings_are_shown_with_their_sentences_and_when_they_were_made) {
  preflight::dated_report last;
  last.at_ns = 1'500'000'000;
  last.what.findings = {{"battery", preflight::verdict::fail, "The battery is at 12 %: charge it."}};
  const auto shown = preflight_view_of({}, last);
  EXPECT_EQ(shown.looked_ms, 1'500);
  ASSERT_EQ(shown.findings.size(), 1U);
  EXPECT_EQ(shown.findings[0].verdict, "fail");
  EXPECT_EQ(shown.findings[0].sentence, "The battery is at 12 %: charge it.");
  EXPECT_TRUE(preflight_view_of({}, {}).findings.empty());
}

} // namespace people_views_test
} // namespace godwit::executor
