// One mission after the other: the service is asked for the vehicle's next one.
#include <gtest/gtest.h>

#include "tests/actors/mission_client/client_world.hpp"

namespace next_mission_test {

using namespace godwit;
using namespace godwit::mission_client;
using namespace godwit::mission_client::test;
using namespace std::chrono_literals;
using runtime::health_colour;

constexpr const char* next_call = "/vehicles/bird-1/missions/next";

begin_next after(std::vector<std::string> over) { return {"bird-1", std::move(over)}; }

report_progress completion(const std::string& mission_id, std::uint32_t number) {
  auto result = report(mission_id, number);
  result.report.kind = mission::progress_kind::complete;
  result.report.item_id.reset();
  result.report.item_index.reset();
  return result;
}

outside with_two_missions() {
  outside around;
  around.service.add(sample_mission(mission_a));
  around.service.add(sample_mission(mission_b));
  around.service.next_missions = {mission_a, mission_b};
  return around;
}

TEST(next_mission, is_loaded_as_one_that_was_asked_for_and_numbers_its_own_reports) {
  auto around = with_two_missions();
  process p(around);
  p.say(after({}));
  p.advance(2s);
  ASSERT_EQ(around.listener.loaded.size(), 1U);
  EXPECT_EQ(around.listener.loaded[0].document.mission_id, mission_a);
  ASSERT_EQ(around.listener.pulled.size(), 1U);
  p.say(report(mission_a, 1));
  p.say(completion(mission_a, 2));
  p.say(after({mission_a}));
  p.advance(2s);
  ASSERT_EQ(around.listener.loaded.size(), 2U);
  EXPECT_EQ(around.listener.loaded[1].document.mission_id, mission_b);
  p.say(report(mission_b, 1));
  p.advance(2s);
  EXPECT_EQ(around.service.at(mission_a).reports.size(), 2U) << "delivered before the next was asked for";
  ASSERT_EQ(around.service.at(mission_b).reports.size(), 1U);
  EXPECT_EQ(around.service.at(mission_b).reports[0].report_no, 1U);
  EXPECT_EQ(around.service.other_bodies, 0);
}

TEST(next_mission, is_waited_for_with_one_call_at_a_time_and_health_is_green) {
  outside around;
  process p(around);
  p.say(after({}));
  p.advance(95s);
  EXPECT_GE(around.service.count(next_call), 3);
  EXPECT_LE(around.service.count(next_call), 5) << "30 s each";
  EXPECT_TRUE(p.status().waits_for_next);
  EXPECT_EQ(p.status().mission_id, "");
  EXPECT_EQ(p.health().colour, health_colour::green);
  EXPECT_NE(p.health().reason.find("next mission"), std::string::npos);
  around.service.add(sample_mission(mission_a));
  around.service.next_missions = {mission_a};
  p.advance(1s);
  EXPECT_EQ(around.listener.loaded.size(), 1U) << "the long poll is answered";
  EXPECT_FALSE(p.status().waits_for_next);
}

TEST(next_mission, said_again_while_one_is_loaded_changes_nothing) {
  auto around = with_two_missions();
  process p(around);
  p.say(after({}));
  p.advance(2s);
  const auto calls = around.service.count(next_call);
  p.say(after({}));
  p.say(after({mission_b}));
  p.advance(5s);
  EXPECT_EQ(around.listener.loaded.size(), 1U);
  EXPECT_EQ(around.service.count(next_call), calls);
  EXPECT_EQ(p.status().mission_id, mission_a);
}

TEST(next_mission, a_killed_process_goes_on_asking_and_with_the_one_that_was_given) {
  auto around = with_two_missions();
  auto p = std::make_unique<process>(around);
  p->say(after({}));
  p->advance(10ms);
  p = std::make_unique<process>(around);
  p->advance(25ms);
  p = std::make_unique<process>(around);
  p->advance(3s);
  ASSERT_EQ(around.listener.loaded.size(), 1U);
  EXPECT_EQ(around.listener.loaded[0].document.mission_id, mission_a);
}

TEST(next_mission, one_that_can_not_be_fetched_is_refused_by_its_name_and_asked_for_anew) {
  outside around;
  around.service.next_missions = {mission_a};
  process p(around);
  p.say(after({}));
  p.advance(5s);
  ASSERT_EQ(around.listener.refused.size(), 1U);
  EXPECT_EQ(around.listener.refused[0].mission_id, mission_a);
  EXPECT_EQ(around.listener.refused[0].why, refusal::not_found);
  around.service.add(sample_mission(mission_a));
  p.say(after({}));
  p.advance(5s);
  EXPECT_EQ(around.listener.loaded.size(), 1U);
}

// -- bad answers ------------------------------------------------------------------------------------------

struct bad_answer_row {
  const char* name;
  planned_fault fault;
  std::string vehicle;
  std::string part_of_sentence;
  bool waits_for_person;
};

class bad_next : public testing::TestWithParam<bad_answer_row> {};

TEST_P(bad_next, is_a_sentence_and_asked_for_again_within_bounds) {
  const auto& row = GetParam();
  auto around = with_two_missions();
  around.service.vehicle = row.vehicle;
  if (row.fault.what != fault::none)
    around.service.faults.push_back(row.fault);
  process p(around);
  p.say(after({}));
  p.advance(600s, 100ms);
  EXPECT_TRUE(around.listener.loaded.empty());
  EXPECT_NE(p.status().last_error.find(row.part_of_sentence), std::string::npos) << p.status().last_error;
  EXPECT_NE(p.health().colour, health_colour::green);
  EXPECT_EQ(p.health().colour == health_colour::red, row.waits_for_person) << p.health().reason;
  EXPECT_LE(around.service.count("/missions/next"), row.waits_for_person ? 1 : 30) << "in 10 minutes";
  around.service.vehicle = "bird-1";
  around.service.faults.clear();
  if (row.waits_for_person)
    (void)p.retry();
  p.advance(60s, 100ms);
  EXPECT_EQ(around.listener.loaded.size(), 1U) << p.status().last_error;
}

INSTANTIATE_TEST_SUITE_P(
    each, bad_next,
    testing::Values(
        bad_answer_row{"unknown_vehicle", {.what = fault::none}, "bird-2", "knows no vehicle \"bird-1\"", false},
        bad_answer_row{
            "conflict", {.where = "/next", .what = fault::status_answer, .status = 409}, "bird-1", "409", false},
        bad_answer_row{
            "forbidden", {.where = "/next", .what = fault::status_answer, .status = 403}, "bird-1", "403", true},
        bad_answer_row{
            "unavailable", {.where = "/next", .what = fault::status_answer, .status = 503}, "bird-1", "503", false},
        bad_answer_row{
            "malformed", {.where = "/next", .what = fault::cut_answer}, "bird-1", "names no next mission", false},
        bad_answer_row{"silence", {.where = "/next", .what = fault::silence}, "bird-1", "no byte", false}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(next_mission, one_that_is_over_on_board_is_not_begun_again_and_said_to_be_so) {
  auto around = with_two_missions();
  process p(around);
  p.say(after({mission_a})); // the service does not know that it is over
  p.advance(300s, 100ms);
  EXPECT_TRUE(around.listener.loaded.empty());
  EXPECT_NE(p.status().last_error.find("is over on board"), std::string::npos) << p.status().last_error;
  EXPECT_LE(around.service.count(next_call), 20);
  around.service.next_missions = {mission_b};
  p.advance(60s, 100ms);
  ASSERT_EQ(around.listener.loaded.size(), 1U);
  EXPECT_EQ(around.listener.loaded[0].document.mission_id, mission_b);
}

TEST(next_mission, one_of_another_vehicle_is_not_flown) {
  auto around = with_two_missions();
  around.service.answers_for = "bird-7";
  process p(around);
  p.say(after({}));
  p.advance(120s, 100ms);
  EXPECT_TRUE(around.listener.loaded.empty());
  EXPECT_NE(p.status().last_error.find("of vehicle \"bird-7\" instead of \"bird-1\""), std::string::npos)
      << p.status().last_error;
}

} // namespace next_mission_test
