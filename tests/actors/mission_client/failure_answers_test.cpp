// What the service's answers lead to, one by one, and what becomes of what earlier missions left.
#include <gtest/gtest.h>

#include "tests/actors/mission_client/client_world.hpp"

namespace failure_answers_test {

using namespace godwit;
using namespace godwit::mission_client;
using namespace godwit::mission_client::test;
using namespace std::chrono_literals;
using runtime::health_colour;

// -- the statuses ---------------------------------------------------------------------------------

struct refused_case {
  planned_fault what;
  refusal why;
};

TEST(mission_client_answers, a_permanent_error_refuses_the_mission_at_once) {
  const std::vector<refused_case> cases{{{.what = fault::status_answer, .status = 401}, refusal::not_allowed},
                                        {{.what = fault::status_answer, .status = 403}, refusal::not_allowed},
                                        {{.what = fault::status_answer, .status = 404}, refusal::not_found},
                                        {{.what = fault::status_answer, .status = 410}, refusal::deleted},
                                        {{.what = fault::status_answer, .status = 400}, refusal::invalid},
                                        {{.what = fault::status_answer, .status = 302}, refusal::misconfigured},
                                        {{.what = fault::wrong_host}, refusal::misconfigured},
                                        {{.what = fault::cut_answer}, refusal::invalid}};
  for (const auto& each : cases) {
    outside around;
    around.service.add(sample_mission(mission_a));
    around.service.faults.push_back(each.what);
    process p(around);
    begin(p, mission_a);
    ASSERT_EQ(around.listener.refused.size(), 1U) << each.what.status;
    EXPECT_EQ(around.listener.refused[0].why, each.why) << each.what.status;
    EXPECT_EQ(around.service.count("GET"), 1) << each.what.status;
    EXPECT_EQ(p.health().colour, health_colour::red) << each.what.status;
  }
}

TEST(mission_client_answers, another_mission_than_the_one_asked_for_is_refused) {
  outside around;
  around.service.missions[mission_a].document = sample_mission(mission_b);
  process p(around);
  begin(p, mission_a);
  ASSERT_EQ(around.listener.refused.size(), 1U);
  EXPECT_EQ(around.listener.refused[0].why, refusal::invalid);
}

TEST(mission_client_answers, not_allowed_waits_for_a_person_and_shows_red) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.service.faults.push_back({.what = fault::status_answer, .status = 401, .posts_only = true});
  p.say(report(mission_a, 1));
  p.advance(120s);
  EXPECT_EQ(around.service.posts("/progress"), 1);
  EXPECT_EQ(p.health().colour, health_colour::red);
  EXPECT_FALSE(p.status().may_deliver);
  EXPECT_NE(p.status().delivery_error.find("401"), std::string::npos);
  around.service.faults.clear();
  EXPECT_EQ(p.retry().tried_now, 1U);
  p.advance(1s);
  EXPECT_EQ(around.service.at(mission_a).reports.size(), 1U);
  EXPECT_EQ(p.health().colour, health_colour::green);
  EXPECT_TRUE(p.status().may_deliver);
  EXPECT_EQ(p.status().delivery_error, "");
}

TEST(mission_client_answers, what_the_service_calls_wrong_is_not_repeated) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.service.faults.push_back({.where = "/progress", .what = fault::status_answer, .status = 422});
  p.say(report(mission_a, 1));
  p.advance(60s);
  EXPECT_EQ(around.service.posts("/progress"), 1);
  EXPECT_EQ(p.status().orphaned, 1U);
}

TEST(mission_client_answers, a_gap_that_the_service_sees_orphans_what_is_after_it_and_loops_never) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  p.say(report(mission_a, 1));
  p.advance(1s);
  around.service.at(mission_a).reports.clear(); // the service has lost it
  for (std::uint32_t i = 2; i <= 5; ++i)
    p.say(report(mission_a, i));
  p.advance(60s);
  EXPECT_EQ(p.status().orphaned, 4U);
  EXPECT_LE(around.service.posts("/progress"), 5);
}

TEST(mission_client_answers, a_stale_insert_is_told_and_the_newest_mission_is_fetched) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  m.document.revision = 4;
  p.say(insert(mission_a, 1, 1));
  p.advance(2s);
  ASSERT_EQ(around.listener.outcomes.size(), 1U);
  EXPECT_EQ(around.listener.outcomes[0].verdict, change_verdict::stale);
  ASSERT_EQ(around.listener.loaded.size(), 2U);
  EXPECT_EQ(around.listener.loaded[1].cause, load_cause::looked_up);
  EXPECT_EQ(around.listener.loaded[1].document.revision, 4);
  EXPECT_EQ(m.changes, 0);
}

TEST(mission_client_answers, an_insert_whose_answers_are_lost_is_looked_up_and_took_effect_once) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.service.faults.push_back({.where = "/waypoints", .what = fault::lost_answer});
  p.say(insert(mission_a, 1, 1));
  p.advance(5s);
  EXPECT_EQ(m.changes, 1);
  ASSERT_EQ(around.listener.outcomes.size(), 1U);
  EXPECT_EQ(around.listener.outcomes[0].verdict, change_verdict::unknown);
  ASSERT_EQ(around.listener.loaded.size(), 2U);
  EXPECT_EQ(around.listener.loaded[1].cause, load_cause::looked_up);
  EXPECT_EQ(around.listener.loaded[1].document.revision, 2);
}

TEST(mission_client_answers, an_insert_is_looked_up_as_soon_as_the_service_answers) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.service.faults.push_back({.where = "/waypoints", .what = fault::lost_answer, .times = 1});
  around.service.faults.push_back({.what = fault::no_connection});
  p.say(insert(mission_a, 1, 1));
  p.advance(600s, 100ms);
  EXPECT_EQ(around.listener.loaded.size(), 1U);
  around.service.faults.clear();
  p.advance(60s);
  ASSERT_EQ(around.listener.loaded.size(), 2U);
  EXPECT_EQ(around.listener.loaded[1].document.revision, 2);
}

TEST(mission_client_answers, retry_after_is_the_least_that_is_waited) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.service.faults.push_back({.where = "/progress",
                                   .what = fault::status_answer,
                                   .status = 429,
                                   .retry_after_ns = 90 * second_ns,
                                   .times = 1});
  p.say(report(mission_a, 1));
  p.advance(89s);
  EXPECT_EQ(around.service.posts("/progress"), 1);
  p.advance(3s);
  EXPECT_EQ(around.service.at(mission_a).reports.size(), 1U);
}

TEST(mission_client_answers, two_hundred_from_a_portal_on_the_way_is_no_receipt) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.service.faults.push_back({.where = "/progress", .what = fault::cut_answer, .times = 2});
  p.say(report(mission_a, 1));
  p.advance(500ms);
  EXPECT_EQ(p.status().pending, 1U);
  p.advance(10s);
  EXPECT_EQ(p.status().pending, 0U);
  EXPECT_EQ(around.service.at(mission_a).reports.size(), 1U);
}

TEST(mission_client_answers, an_assignment_that_an_insert_overtakes_is_told_all_the_same) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.service.faults.push_back({.where = "/assignments", .what = fault::lost_answer, .gets_only = true});
  p.advance(40s); // the poll that was under way has ended
  around.service.assign(mission_a, sample_assignment(m.document, 1));
  p.say(insert(mission_a, 1, 1));
  p.advance(5s);
  ASSERT_EQ(around.listener.loaded.size(), 2U);
  EXPECT_EQ(around.listener.loaded[1].document.revision, 2);
  EXPECT_TRUE(around.listener.arrived.empty());
  around.service.faults.clear();
  p.advance(120s);
  ASSERT_EQ(around.listener.arrived.size(), 1U);
  const auto& told = around.listener.arrived[0].assignment;
  p.say(response(mission_a, told, mission::assignment_outcome::rejected, 1));
  p.advance(60s);
  EXPECT_EQ(m.responses.size(), 1U);
  EXPECT_EQ(around.listener.arrived.size(), 1U);
}

// -- the pull -------------------------------------------------------------------------------------

TEST(mission_client_answers, a_next_that_is_not_known_any_more_begins_the_load_anew) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  for (std::uint64_t i = 0; i < 30; ++i)
    m.map_objects.push_back(
        {uuid(i, 'c'), "vehicle", 47.4, 8.5, {}, 0.5, "2026-05-01T08:00:00Z", "2026-05-03T16:20:00Z"});
  around.service.page_rows = 10;
  around.service.forget_pages();
  process p(around);
  begin(p, mission_a);
  EXPECT_EQ(around.store.loads, 2);
  EXPECT_EQ(around.store.objects.size(), 30U);
  EXPECT_EQ(around.listener.pulled.at(0).state, pull_state::synced);
}

TEST(mission_client_answers, a_map_whose_pages_never_end_is_given_up_at_a_bound_and_the_reason_is_said) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  m.map_objects.push_back(
      {uuid(1, 'c'), "vehicle", 47.4, 8.5, {}, 0.5, "2026-05-01T08:00:00Z", "2026-05-03T16:20:00Z"});
  around.service.page_rows = 0; // a `next` each time, and nothing before it
  process p(around);
  begin(p, mission_a);
  ASSERT_EQ(around.listener.pulled.size(), 1U);
  EXPECT_NE(around.listener.pulled[0].state, pull_state::synced);
  EXPECT_NE(around.listener.pulled[0].reason.find("has no end"), std::string::npos) << around.listener.pulled[0].reason;
}

TEST(mission_client_answers, a_load_that_the_store_gave_up_is_begun_anew_a_few_times) {
  outside around;
  around.service.add(sample_mission(mission_a));
  around.store.given_up_loads = 2;
  process p(around);
  begin(p, mission_a);
  EXPECT_EQ(around.listener.pulled.at(0).state, pull_state::synced);
  around.store.given_up_loads = 100;
  around.store.has_copy = false;
  around.service.add(sample_mission(mission_b));
  begin(p, mission_b);
  EXPECT_EQ(around.listener.pulled.at(1).state, pull_state::failed);
  EXPECT_EQ(around.store.loads, 3 + max_loads);
}

TEST(mission_client_answers, a_store_that_is_busy_is_asked_again) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  around.store.is_busy = true;
  begin(p, mission_a);
  around.store.is_busy = false;
  p.advance(10s);
  EXPECT_EQ(around.listener.pulled.at(0).state, pull_state::synced);
}

// -- what earlier missions left -------------------------------------------------------------------

TEST(mission_client_answers, what_an_earlier_mission_left_holds_up_the_next_one_for_a_few_tries_only) {
  outside around;
  around.service.add(sample_mission(mission_a));
  around.service.add(sample_mission(mission_b));
  process p(around);
  begin(p, mission_a);
  around.service.faults.push_back({.where = mission_a});
  around.store.owe(mission_a, 10);
  p.say(report(mission_a, 1));
  p.advance(100ms);
  p.say(begin_mission{mission_b});
  p.advance(60s);
  ASSERT_EQ(around.listener.loaded.size(), 2U);
  EXPECT_EQ(p.health().colour, health_colour::yellow);
  EXPECT_EQ(p.status().pending, 2U);
  around.service.faults.clear(); // it went on meanwhile
  p.advance(120s);
  EXPECT_EQ(around.service.at(mission_a).observations.size(), 10U);
  EXPECT_EQ(around.service.at(mission_a).reports.size(), 1U);
  EXPECT_EQ(p.health().colour, health_colour::green);
}

} // namespace failure_answers_test
