#include "actors/executor/progress/open_mission.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/progress/progress_fixture.hpp"

namespace godwit::executor::progress {
namespace open_mission_test {

using namespace test;

TEST(open_mission, report_no_rises_by_one_in_each_mission_without_a_gap) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.reached(0);
  d.take(mission_opened{"other", 1});
  d.fly({"X"});
  d.take(mission_opened{"m", 1});
  d.fly({"B"}, 1);
  std::vector<std::pair<std::string, std::uint32_t>> numbers;
  for (const auto& each : d.reports)
    numbers.emplace_back(each.mission_id, each.report_no);
  EXPECT_EQ(numbers, (std::vector<std::pair<std::string, std::uint32_t>>{{"m", 1}, {"m", 2}, {"other", 1}, {"m", 3}}));
}

TEST(open_mission, generations_rise_over_all_missions) {
  progress_fixture d;
  d.fly({"A"});
  d.take(mission_opened{"other", 1});
  d.fly({"X"});
  EXPECT_EQ(d.said(), (texts{"started A#0 g1", "started X#0 g2"}));
}

TEST(open_mission, the_plan_of_the_mission_before_counts_no_more) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.current(1); // waits for its REACHED
  d.take(mission_opened{"other", 1});
  EXPECT_EQ(d.said(), (texts{"started A#0 g1", "reached A#0 g1 inferred", "started B#1 g1"}));
  EXPECT_EQ(d.reports.back().mission_id, "m");
  d.current(1);
  d.reached(1);
  EXPECT_EQ(d.said(), texts{});
}

TEST(open_mission, opened_again_it_goes_on) {
  progress_fixture d;
  d.fly({"A", "B"});
  EXPECT_TRUE(d.take(mission_opened{"m", 1}).empty());
  EXPECT_TRUE(d.is_armed());
}

TEST(open_mission, past_missions_are_bounded_and_the_oldest_is_forgotten) {
  progress_fixture d;
  for (std::size_t i = 0; i < 2 * max_past_missions; ++i)
    d.take(mission_opened{"mission " + std::to_string(i), 1});
  EXPECT_EQ(d.s.past_missions.size(), max_past_missions);
  EXPECT_EQ(d.s.past_missions.back().mission_id, "mission 62");
  EXPECT_EQ(d.s.past_missions.front().mission_id, "mission 31");
}

mission::progress_report report_of_before(mission::progress_kind kind) {
  mission::progress_report result;
  result.mission_id = "lost";
  result.generation = 7;
  result.report_no = 12;
  result.kind = kind;
  return result;
}

TEST(open_mission, after_a_lost_journal_numbers_and_generations_go_on_after_those_of_the_service) {
  progress_fixture d;
  d.take(earlier_reports_told{"lost", 12, report_of_before(mission::progress_kind::reached)});
  d.take(earlier_reports_told{"lost", 3, {}}); // an older answer
  EXPECT_TRUE(is_begun(d.s, "lost"));
  EXPECT_FALSE(has_ended(d.s, "lost", 1));
  d.take(mission_opened{"lost", 1});
  d.fly({"A"});
  ASSERT_FALSE(d.reports.empty());
  EXPECT_EQ(d.reports.back().report_no, 13U);
  EXPECT_EQ(d.reports.back().generation, 8U);
}

TEST(open_mission, one_that_the_service_was_told_is_complete_has_ended) {
  progress_fixture d;
  d.take(earlier_reports_told{"lost", 12, report_of_before(mission::progress_kind::complete)});
  EXPECT_TRUE(has_ended(d.s, "lost", 1));
  EXPECT_FALSE(has_ended(d.s, "lost", 2));
  EXPECT_FALSE(is_begun(d.s, "lost")) << "a newer revision is flown like a new mission";
}

// Of the mission that is flown, by another life.
mission::progress_report known_report(mission::progress_kind kind, const std::string& item, std::uint32_t generation) {
  auto result = report_of_before(kind);
  result.mission_id = "m";
  result.generation = generation;
  if (!item.empty())
    result.item_id = item;
  return result;
}

TEST(open_mission, with_an_older_journal_it_counts_from_where_the_service_knows_it) {
  progress_fixture d;
  d.upload({"A", "B", "C", "D"});
  d.take(earlier_reports_told{"m", 12, known_report(mission::progress_kind::reached, "B", 2)});
  d.wait_s(5);
  d.current(2);
  d.reached(2);
  d.current(3);
  EXPECT_EQ(d.said(), (texts{"started C#2 g2", "reached C#2 g2", "started D#3 g2"}));
  EXPECT_EQ(d.reports.front().report_no, 13U);
  EXPECT_EQ(d.news_told(), (texts{"generation_opened g1"})) << "and is not sent back to its start";
}

TEST(open_mission, what_the_service_knows_as_started_is_not_started_again) {
  progress_fixture d;
  d.upload({"A", "B", "C"});
  d.take(earlier_reports_told{"m", 12, known_report(mission::progress_kind::started, "B", 2)});
  d.wait_s(5);
  d.current(1);
  d.reached(1);
  EXPECT_EQ(d.said(), texts{"reached B#1 g2"});
}

TEST(open_mission, a_plan_of_which_the_service_knows_the_end_is_not_told_again) {
  progress_fixture d;
  d.upload({"A", "B"});
  d.take(earlier_reports_told{"m", 12, known_report(mission::progress_kind::complete, "", 2)});
  d.wait_s(5);
  d.current(0);
  d.reached(0);
  d.current(1);
  d.reached(1);
  EXPECT_EQ(d.said(), texts{});
  EXPECT_TRUE(d.s.plan->generation.is_finished);
}

TEST(open_mission, a_plan_of_which_the_service_knows_the_last_item_is_complete) {
  progress_fixture d;
  d.upload({"A", "B"});
  d.take(earlier_reports_told{"m", 12, known_report(mission::progress_kind::reached, "B", 2)});
  EXPECT_EQ(d.said(), texts{"complete g2 inferred"});
}

TEST(open_mission, of_a_plan_that_another_revision_has_replaced_nothing_is_told) {
  progress_fixture d;
  d.upload({"A", "B"});
  auto newer = known_report(mission::progress_kind::reached, "Z", 5);
  newer.revision = 2;
  d.take(earlier_reports_told{"m", 12, newer});
  d.wait_s(5);
  d.current(0);
  d.reached(0);
  EXPECT_EQ(d.said(), texts{});
  EXPECT_EQ(d.s.paused, pause_reason::foreign_plan);
}

TEST(open_mission, what_the_service_had_before_this_journal_was_further_changes_nothing) {
  progress_fixture d;
  d.fly({"A", "B", "C"});
  d.reached(0);
  d.current(1);
  d.said();
  d.take(earlier_reports_told{"m", 1, known_report(mission::progress_kind::started, "A", 1)});
  d.reached(1);
  EXPECT_EQ(d.said(), texts{"reached B#1 g1"});
}

TEST(open_mission, generations_told_of_another_mission_leave_the_plan_the_newest) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.take(earlier_reports_told{"lost", 12, report_of_before(mission::progress_kind::reached)});
  d.reached(0);
  EXPECT_EQ(d.reports.back().generation, 7U);
}

TEST(open_mission, an_abort_is_reported_once_and_nothing_counts_after_it) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.current(1);
  d.take(mission_aborted{});
  d.take(mission_aborted{});
  d.take(vehicle_rebooted{});
  d.take(mission_aborted{});
  d.reached(1);
  EXPECT_EQ(d.said(), (texts{"started A#0 g1", "reached A#0 g1 inferred", "started B#1 g1", "aborted g1"}));
  EXPECT_EQ(d.s.paused, pause_reason::aborted);
  EXPECT_FALSE(d.reports.back().item_id);
}

TEST(open_mission, an_aborted_mission_goes_on_when_it_is_started_anew) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.take(mission_aborted{});
  d.said();
  d.start_at(0);
  d.started();
  d.current(0);
  EXPECT_EQ(d.said(), texts{"started A#0 g2"});
}

TEST(open_mission, a_complete_mission_is_not_aborted) {
  progress_fixture d;
  d.fly({"A"});
  d.reached(0);
  d.said();
  d.take(mission_aborted{});
  EXPECT_EQ(d.said(), texts{});
}

} // namespace open_mission_test
} // namespace godwit::executor::progress
