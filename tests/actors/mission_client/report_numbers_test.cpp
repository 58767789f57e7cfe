// The numbers of reports at the service: without a gap, and on from what it had, whatever was lost on this side.
#include <gtest/gtest.h>

#include "tests/actors/mission_client/client_world.hpp"

namespace {

using namespace godwit;
using namespace godwit::mission_client;
using namespace godwit::mission_client::test;
using namespace std::chrono_literals;
using runtime::crash_point;
using runtime::health_colour;

std::vector<std::uint32_t> numbers(const service_mission& m) {
  std::vector<std::uint32_t> result;
  for (const auto& each : m.reports)
    result.push_back(each.report_no);
  return result;
}

// What another journal has delivered.
void deliver_before(service_mission& m, std::uint32_t count) {
  for (std::uint32_t i = 1; i <= count; ++i)
    m.reports.push_back(report(mission_a, i).report);
}

TEST(mission_client_reports, a_journal_that_was_lost_goes_on_behind_the_last_number_of_the_service) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  deliver_before(m, 3);
  process p(around);
  begin(p, mission_a);
  p.say(report(mission_a, 1));
  p.say(report(mission_a, 2));
  p.advance(2s);
  EXPECT_EQ(numbers(m), (std::vector<std::uint32_t>{1, 2, 3, 4, 5}));
  EXPECT_EQ(around.service.repeated_rows, 0U) << "none is taken for one from before";
  EXPECT_EQ(around.service.other_bodies, 0);
  EXPECT_EQ(p.status().lost_reports, 0U);
}

TEST(mission_client_reports, what_the_service_has_and_this_journal_has_not_is_told_with_the_mission) {
  outside around;
  deliver_before(around.service.add(sample_mission(mission_a)), 3);
  process p(around);
  begin(p, mission_a);
  p.advance(2s);
  ASSERT_EQ(around.listener.loaded.size(), 1U);
  const auto& earlier = around.listener.loaded[0].earlier;
  ASSERT_TRUE(earlier && earlier->last_report);
  EXPECT_EQ(earlier->last_report_no, 3U);
  EXPECT_EQ(*earlier->last_report, report(mission_a, 3).report);
  // Whoever goes on behind it is not renumbered.
  p.say(report(mission_a, 4));
  p.advance(2s);
  EXPECT_EQ(around.service.repeated_rows, 0U);
  EXPECT_EQ(p.status().lost_reports, 0U);
}

TEST(mission_client_reports, of_a_mission_whose_reports_are_all_known_nothing_is_told) {
  outside around;
  around.service.add(sample_mission(mission_a));
  around.service.add(sample_mission(uuid(2)));
  process p(around);
  begin(p, mission_a);
  p.say(report(mission_a, 1));
  p.advance(2s);
  begin(p, uuid(2));
  p.advance(2s);
  begin(p, mission_a);
  p.advance(2s);
  ASSERT_EQ(around.listener.loaded.size(), 3U);
  EXPECT_FALSE(around.listener.loaded[2].earlier);
}

TEST(mission_client_reports, a_last_report_of_another_mission_is_refused) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  m.reports.push_back(report(uuid(2), 1).report);
  process p(around);
  begin(p, mission_a);
  p.advance(2s);
  ASSERT_EQ(around.listener.refused.size(), 1U);
  EXPECT_NE(around.listener.refused[0].reason.find(uuid(2)), std::string::npos);
}

TEST(mission_client_reports, a_response_names_the_last_report_as_the_service_numbers_it) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  deliver_before(m, 3);
  process p(around);
  begin(p, mission_a);
  p.say(report(mission_a, 1));
  around.service.assign(mission_a, sample_assignment(m.document, 1));
  p.advance(5s);
  ASSERT_EQ(around.listener.arrived.size(), 1U);
  const auto& assigned = around.listener.arrived[0].assignment;
  p.say(response(mission_a, assigned, mission::assignment_outcome::accepted, 1));
  p.advance(2s);
  ASSERT_TRUE(m.responses.at(assigned.assignment_id).last_progress);
  EXPECT_EQ(m.responses.at(assigned.assignment_id).last_progress->report_no, 4U);
}

TEST(mission_client_reports, a_service_that_does_not_tell_the_number_is_begun_with_as_it_was) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  around.service.knows_progress_call = false;
  process p(around);
  begin(p, mission_a);
  ASSERT_EQ(around.listener.loaded.size(), 1U);
  p.say(report(mission_a, 1));
  p.advance(2s);
  EXPECT_EQ(numbers(m), (std::vector<std::uint32_t>{1}));
}

TEST(mission_client_reports, a_mission_is_not_begun_before_the_number_is_known) {
  outside around;
  around.service.add(sample_mission(mission_a));
  around.service.faults.push_back({.where = "/progress", .what = fault::no_connection, .times = 2});
  process p(around);
  begin(p, mission_a);
  EXPECT_TRUE(around.listener.loaded.empty());
  p.advance(20s);
  EXPECT_EQ(around.listener.loaded.size(), 1U);
}

TEST(mission_client_reports, one_that_never_came_leaves_no_gap_at_the_service_and_is_counted) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  p.say(report(mission_a, 1));
  p.say(report(mission_a, 4));
  p.say(report(mission_a, 5));
  p.advance(2s);
  EXPECT_EQ(numbers(m), (std::vector<std::uint32_t>{1, 2, 3}));
  EXPECT_EQ(p.status().lost_reports, 2U);
  EXPECT_EQ(p.health().colour, health_colour::yellow);
  EXPECT_NE(p.health().reason.find("2 reports of progress are lost"), std::string::npos) << p.health().reason;
  EXPECT_EQ(p.status().orphaned, 0U);
}

TEST(mission_client_reports, one_that_crashes_the_actor_three_times_holds_no_later_one_back) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  p.say(report(mission_a, 1));
  p.advance(2s);
  for (int i = 0; i < 3; ++i)
    p.world.crash_at("mission_client", crash_point::before_handler);
  p.say(report(mission_a, 2));
  p.say(report(mission_a, 3));
  p.advance(10s);
  EXPECT_EQ(around.disk.dead_letters.size(), 1U);
  EXPECT_EQ(numbers(m), (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(p.status().lost_reports, 1U);
}

} // namespace
