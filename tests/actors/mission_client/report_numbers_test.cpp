// The numbers of reports at the service: without a gap, and on from what it had, whatever was lost on this side.
#include <gtest/gtest.h>

#include "tests/actors/mission_client/client_world.hpp"

namespace report_numbers_test {

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

// Of the plan after those that the service has from before.
report_progress next_plans(std::uint32_t number) {
  auto result = report(mission_a, number);
  result.report.generation = 2;
  return result;
}

// At item INDEX, as a process with another journal tells it.
report_progress at_item(std::uint32_t number, std::uint32_t index,
                        mission::progress_kind kind = mission::progress_kind::reached) {
  auto result = report(mission_a, number);
  result.report.kind = kind;
  result.report.item_id = "w" + std::to_string(index);
  result.report.item_index = index;
  return result;
}

std::vector<std::string> items(const service_mission& m) {
  std::vector<std::string> result;
  for (const auto& each : m.reports)
    result.push_back(std::string(io::name_of(each.kind)) + " " + each.item_id.value_or(""));
  return result;
}

// What another journal has delivered.
void deliver_before(service_mission& m, std::uint32_t count) {
  for (std::uint32_t i = 1; i <= count; ++i)
    m.reports.push_back(report(mission_a, i).report);
}

TEST(mission_client_reports, a_journal_that_was_lost_goes_on_after_the_last_number_of_the_service) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  deliver_before(m, 3);
  process p(around);
  begin(p, mission_a);
  p.say(next_plans(1));
  p.say(next_plans(2));
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
  // Whoever goes on after it is not renumbered.
  p.say(next_plans(4));
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
  p.say(next_plans(1));
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

// Reports up to the second are delivered, of which this older journal has the first.
class older_journal : public testing::Test {
protected:
  older_journal() {
    process p(around);
    begin(p, mission_a);
    p.say(at_item(1, 1));
    p.advance(2s);
    older = around.disk.actors;
    p.say(at_item(2, 2));
    p.advance(2s);
    EXPECT_EQ(numbers(mission()), (std::vector<std::uint32_t>{1, 2}));
  }
  void put_back() { around.disk.actors = older; }
  [[nodiscard]] const service_mission& mission() const { return around.service.missions.at(mission_a); }

  outside around{.disk = {}, .service = with_mission(), .store = {}, .listener = {}};
  std::map<std::string, runtime::simulated_disk::actor_rows> older;

private:
  static scripted_service with_mission() {
    scripted_service result;
    result.add(sample_mission(mission_a));
    return result;
  }
};

TEST_F(older_journal, goes_on_after_the_last_report_of_the_service_and_says_so) {
  put_back();
  process p(around);
  p.advance(2s);
  ASSERT_EQ(around.listener.earlier.size(), 1U);
  EXPECT_EQ(around.listener.earlier[0].mission_id, mission_a);
  EXPECT_EQ(around.listener.earlier[0].earlier.last_report_no, 2U);
  EXPECT_EQ(around.listener.earlier[0].earlier.last_report, at_item(2, 2).report);
  p.say(at_item(3, 3));
  p.advance(2s);
  EXPECT_EQ(items(mission()), (std::vector<std::string>{"reached w1", "reached w2", "reached w3"}));
  EXPECT_EQ(around.service.other_bodies, 0);
  EXPECT_EQ(p.status().lost_reports, 0U);
}

TEST_F(older_journal, what_the_service_has_is_not_told_again_and_what_it_has_not_gets_the_next_number) {
  put_back();
  process p(around);
  p.say(at_item(2, 1));
  p.say(at_item(3, 2, mission::progress_kind::started));
  p.say(at_item(4, 2));
  p.say(at_item(5, 3, mission::progress_kind::started));
  p.advance(2s);
  EXPECT_EQ(items(mission()), (std::vector<std::string>{"reached w1", "reached w2", "started w3"}));
  EXPECT_EQ(numbers(mission()), (std::vector<std::uint32_t>{1, 2, 3}));
  EXPECT_EQ(around.service.other_bodies, 0);
  EXPECT_EQ(around.service.repeated_rows, 0U);
}

TEST_F(older_journal, no_report_goes_out_before_the_service_has_said_what_it_has) {
  put_back();
  around.service.faults.push_back({.where = "/progress", .what = fault::no_connection, .times = 3});
  process p(around);
  p.say(at_item(2, 3));
  p.advance(1s);
  EXPECT_EQ(numbers(mission()).size(), 2U);
  EXPECT_NE(p.health().colour, health_colour::green);
  p.advance(20s);
  EXPECT_EQ(items(mission()), (std::vector<std::string>{"reached w1", "reached w2", "reached w3"}));
}

TEST_F(older_journal, what_a_process_without_an_answer_has_numbered_is_numbered_anew_by_the_next_one) {
  put_back();
  around.service.faults.push_back({.what = fault::no_connection});
  {
    process p(around);
    p.say(at_item(2, 1));
    p.say(at_item(3, 3));
    p.advance(1s);
  }
  around.service.faults.clear();
  process p(around);
  p.advance(40s);
  EXPECT_EQ(items(mission()), (std::vector<std::string>{"reached w1", "reached w2", "reached w3"}));
  EXPECT_EQ(around.service.other_bodies, 0);
}

TEST_F(older_journal, of_a_report_that_was_on_its_way_no_second_one_is_made) {
  put_back();
  process p(around);
  p.advance(2s);
  p.say(at_item(2, 2)); // told before the executor has heard of it
  p.say(at_item(3, 3));
  p.advance(2s);
  EXPECT_EQ(items(mission()), (std::vector<std::string>{"reached w1", "reached w2", "reached w3"}));
}

TEST_F(older_journal, one_that_has_all_reports_goes_on_as_before) {
  process p(around);
  p.say(at_item(3, 3));
  p.advance(2s);
  EXPECT_TRUE(around.listener.earlier.empty());
  EXPECT_EQ(numbers(mission()), (std::vector<std::uint32_t>{1, 2, 3}));
}

TEST_F(older_journal, a_service_that_does_not_tell_its_last_report_is_told_as_before) {
  around.service.knows_progress_call = false;
  process p(around);
  p.say(at_item(3, 3));
  p.advance(2s);
  EXPECT_EQ(numbers(mission()), (std::vector<std::uint32_t>{1, 2, 3}));
}

} // namespace report_numbers_test
