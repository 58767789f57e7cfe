// Each row of the table of failures, under its own name, and long outages.
#include <gtest/gtest.h>

#include "tests/actors/mission_client/client_world.hpp"

namespace failure_table_test {

using namespace godwit;
using namespace godwit::mission_client;
using namespace godwit::mission_client::test;
using namespace std::chrono_literals;
using runtime::health_colour;

TEST(mission_client_failures, service_unreachable_at_startup_is_tried_a_few_times_then_the_mission_is_refused) {
  outside around;
  around.service.add(sample_mission(mission_a));
  around.service.faults.push_back({});
  process p(around);
  p.say(begin_mission{mission_a});
  p.advance(60s);
  EXPECT_EQ(around.service.count("GET"), 5);
  ASSERT_EQ(around.listener.refused.size(), 1U);
  EXPECT_EQ(around.listener.refused[0].why, refusal::unreachable);
  EXPECT_NE(around.listener.refused[0].reason, "");
  EXPECT_EQ(p.health().colour, health_colour::red);
  EXPECT_EQ(p.status().connection, connection_state::unreachable);
  EXPECT_EQ(p.status().fetch_errors, 5U);
  around.service.faults.clear();
  begin(p, mission_a); // a person has another try
  EXPECT_EQ(around.listener.loaded.size(), 1U);
  EXPECT_EQ(p.health().colour, health_colour::green);
}

TEST(mission_client_failures, a_mission_of_another_schema_is_refused_with_the_beginning_of_what_came) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  m.document.schema_version = "3.0.0";
  process p(around);
  begin(p, mission_a);
  ASSERT_EQ(around.listener.refused.size(), 1U);
  EXPECT_EQ(around.listener.refused[0].why, refusal::invalid);
  EXPECT_NE(around.listener.refused[0].sample.find(mission_a), std::string::npos);
  EXPECT_LE(around.listener.refused[0].sample.size(), 1'024U);
  EXPECT_EQ(p.health().colour, health_colour::red);
  EXPECT_EQ(around.service.count("GET"), 1);
  EXPECT_TRUE(around.listener.loaded.empty());
  process again(around);
  EXPECT_EQ(again.status().refused_sample, around.listener.refused[0].sample) << "kept for analysis, over restarts";
  EXPECT_NE(again.status().refused, "");
  m.document.schema_version = "1.0.0";
  begin(again, mission_a);
  EXPECT_EQ(again.status().refused_sample, "");
  EXPECT_EQ(again.status().schema_version, "1.0.0");
  EXPECT_GT(again.status().last_fetch_ns, 0);
}

TEST(mission_client_failures, a_map_of_another_schema_fails_the_pull_with_the_beginning_of_what_came) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  m.map_objects.push_back({uuid(1), "vehicle", 95, 8.5, {}, 0.5, "2026-05-01T08:00:00Z", "2026-05-03T16:20:00Z"});
  process p(around);
  begin(p, mission_a);
  ASSERT_EQ(around.listener.pulled.size(), 1U);
  EXPECT_EQ(around.listener.pulled[0].state, pull_state::failed);
  EXPECT_NE(around.listener.pulled[0].reason.find("it began with"), std::string::npos);
}

TEST(mission_client_failures, a_pull_that_fails_is_told_and_a_copy_from_before_is_named) {
  outside around;
  around.service.add(sample_mission(mission_a));
  around.service.faults.push_back({.where = "/mapobjects"});
  process p(around);
  begin(p, mission_a);
  p.advance(30s);
  ASSERT_EQ(around.listener.pulled.size(), 1U);
  EXPECT_EQ(around.listener.pulled[0].state, pull_state::failed);
  EXPECT_NE(around.listener.pulled[0].reason, "");
  EXPECT_EQ(around.service.count("/mapobjects"), 5);
  EXPECT_EQ(p.health().colour, health_colour::yellow);
  around.service.faults.clear();
  p.say(pull_map{mission_a});
  p.advance(2s);
  EXPECT_EQ(around.listener.pulled.back().state, pull_state::synced);
}

TEST(mission_client_failures, a_pull_that_fails_with_a_copy_is_a_cached_fallback) {
  outside around;
  around.service.add(sample_mission(mission_a));
  around.store.has_copy = true;
  around.service.faults.push_back({.where = "/mapobjects"});
  process p(around);
  begin(p, mission_a);
  p.advance(30s);
  ASSERT_EQ(around.listener.pulled.size(), 1U);
  EXPECT_EQ(around.listener.pulled[0].state, pull_state::cached_fallback);
  EXPECT_EQ(around.store.sync, store::sync_state::degraded);
}

TEST(mission_client_failures, a_copy_that_an_operator_accepts_is_accepted_at_the_store_also_when_that_is_busy) {
  outside around;
  around.service.add(sample_mission(mission_a));
  around.store.has_copy = true;
  around.service.faults.push_back({.where = "/mapobjects"});
  {
    process p(around);
    begin(p, mission_a);
    p.advance(30s);
    around.store.is_busy = true;
    p.say(accept_copy{mission_a});
    p.advance(1s);
    EXPECT_EQ(around.store.sync, store::sync_state::degraded);
  } // SIGKILL
  around.store.is_busy = false;
  process again(around);
  again.advance(10s);
  EXPECT_EQ(around.store.sync, store::sync_state::cached_fallback);
}

TEST(mission_client_failures, a_map_that_is_synced_has_no_copy_to_accept) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  p.say(accept_copy{mission_a});
  p.advance(1s);
  EXPECT_EQ(around.store.sync, store::sync_state::synced);
}

TEST(mission_client_failures, an_insert_that_fails_ends_within_two_seconds_and_leaves_the_decision) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.service.faults.push_back({.where = "/waypoints"});
  p.say(insert(mission_a, 1, 1));
  p.advance(2'100ms);
  ASSERT_EQ(around.listener.outcomes.size(), 1U);
  EXPECT_EQ(around.listener.outcomes[0].verdict, change_verdict::unknown);
  EXPECT_EQ(around.service.count("/waypoints"), 3);
  EXPECT_EQ(p.status().pending, 0U);
}

TEST(mission_client_failures, an_insert_into_silence_ends_within_two_seconds) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.service.faults.push_back({.where = "/waypoints", .what = fault::silence});
  p.say(insert(mission_a, 1, 1));
  p.advance(2'100ms);
  ASSERT_EQ(around.listener.outcomes.size(), 1U);
  EXPECT_EQ(around.listener.outcomes[0].verdict, change_verdict::unknown);
}

TEST(mission_client_failures, a_push_that_fails_stays_in_the_outbox_with_growing_pauses_until_it_is_through) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.store.owe(mission_a, 20);
  around.service.faults.push_back({.what = fault::status_answer, .posts_only = true});
  p.say(push_map{mission_a});
  p.advance(60s);
  EXPECT_EQ(p.health().colour, health_colour::yellow);
  EXPECT_EQ(p.status().pending, 1U);
  EXPECT_EQ(p.status().push_pending, 20U);
  EXPECT_LE(around.service.count("POST"), 8);
  EXPECT_TRUE(around.listener.resolved.empty());
  around.service.faults.clear();
  p.advance(60s);
  EXPECT_EQ(around.service.at(mission_a).observations.size(), 20U);
  EXPECT_EQ(around.listener.resolved.size(), 1U);
  EXPECT_EQ(p.health().colour, health_colour::green);
}

TEST(mission_client_failures, a_push_that_is_partly_done_repeats_only_the_missing_part) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.store.owe(mission_a, 20, 10);
  around.service.faults.push_back({.where = "/mapobjects/ignored", .posts_only = true});
  p.say(push_map{mission_a});
  p.advance(20s);
  EXPECT_EQ(around.service.at(mission_a).observations.size(), 20U);
  EXPECT_EQ(around.service.calls["POST /missions/" + mission_a + "/mapobjects"], 1);
  around.service.faults.clear();
  p.advance(40s);
  EXPECT_EQ(around.service.calls["POST /missions/" + mission_a + "/mapobjects"], 1);
  EXPECT_EQ(around.service.at(mission_a).ignored.size(), 10U);
  EXPECT_EQ(around.listener.resolved.size(), 1U);
}

TEST(mission_client_failures, a_mission_deleted_in_flight_is_told_and_what_is_owed_is_kept_as_orphaned) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  m.is_deleted = true;
  around.store.owe(mission_a, 20);
  p.say(report(mission_a, 1));
  p.say(report(mission_a, 2));
  p.advance(1s);
  ASSERT_EQ(around.listener.deleted.size(), 1U);
  EXPECT_EQ(around.store.deleted_missions, std::vector<std::string>{mission_a});
  p.say(report(mission_a, 3));
  p.say(push_map{mission_a});
  p.advance(10s);
  ASSERT_EQ(around.listener.resolved.size(), 1U);
  EXPECT_EQ(around.listener.resolved[0].orphaned, 3U);
  EXPECT_EQ(around.store.orphans[mission_a].size(), 20U);
  EXPECT_EQ(p.status().orphaned, 3U);
  EXPECT_EQ(p.health().colour, health_colour::yellow);
  EXPECT_EQ(around.listener.deleted.size(), 1U);
  const auto calls = around.service.count("");
  p.advance(60s);
  EXPECT_EQ(around.service.count(""), calls);
  m.is_deleted = false; // somebody has mended it, and a person queues again what was kept
  EXPECT_EQ(p.retry().queued, 3U);
  p.advance(10s);
  EXPECT_EQ(m.reports.size(), 3U);
  EXPECT_EQ(m.observations.size(), 20U);
  EXPECT_EQ(around.store.owed(), 0U);
}

TEST(mission_client_failures, a_push_for_a_deleted_mission_is_kept_as_orphaned_and_can_be_queued_again) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.store.owe(mission_a, 600, 5);
  around.service.faults.push_back({.what = fault::status_answer, .status = 404});
  p.say(push_map{mission_a});
  p.advance(5s);
  ASSERT_EQ(around.listener.resolved.size(), 1U);
  EXPECT_GE(p.status().orphaned, 1U);
  EXPECT_TRUE(m.observations.empty());
  EXPECT_TRUE(around.listener.deleted.empty()); // a mistyped address gives 404 as well
  around.service.faults.clear();
  const auto answer = p.retry();
  EXPECT_GE(answer.queued, 1U);
  EXPECT_EQ(answer.error, "");
  p.advance(10s);
  EXPECT_EQ(m.observations.size(), 600U);
  EXPECT_EQ(m.ignored.size(), 5U);
  EXPECT_EQ(p.status().orphaned, 0U);
}

// -- long outages ---------------------------------------------------------------------------------

TEST(mission_client_failures, service_down_for_three_hours_then_all_is_delivered_within_the_bound_of_tries) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.store.owe(mission_a, 1'200, 30);
  around.service.faults.push_back({});
  for (std::uint32_t i = 1; i <= 500; ++i)
    p.say(report(mission_a, i));
  p.say(push_map{mission_a});
  p.advance(3h, 100ms);
  // 1 + 2 + 4 + ... + 256 s, then every 300 s, each up to a fifth shorter: at most 9 + 10'800 / 240 tries in a lane.
  constexpr int bound = 54;
  EXPECT_LE(around.service.count("POST /missions/" + mission_a + "/progress"), bound);
  EXPECT_LE(around.service.calls["POST /missions/" + mission_a + "/mapobjects"], bound);
  EXPECT_LE(around.service.calls["POST /missions/" + mission_a + "/mapobjects/ignored"], bound);
  EXPECT_GE(around.service.posts("/progress"), 30);
  around.service.faults.clear();
  p.advance(400s, 100ms);
  const auto& m = around.service.at(mission_a);
  EXPECT_EQ(m.reports.size(), 500U);
  EXPECT_EQ(m.observations.size(), 1'200U);
  EXPECT_EQ(m.ignored.size(), 30U);
  EXPECT_EQ(around.service.other_bodies, 0);
  EXPECT_EQ(around.listener.resolved.size(), 1U);
}

TEST(mission_client_failures, after_24_hours_of_failures_it_is_kept_as_expired_and_a_person_can_queue_it_again) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.store.owe(mission_a, 700);
  around.service.faults.push_back({});
  p.say(report(mission_a, 1));
  p.say(push_map{mission_a});
  p.advance(23h, 1s);
  EXPECT_EQ(p.status().expired, 0U);
  p.advance(90min, 1s);
  EXPECT_EQ(p.status().expired, 2U);
  EXPECT_EQ(around.listener.resolved.at(0).expired, 2U);
  const auto calls = around.service.count("POST");
  p.advance(1h, 1s);
  EXPECT_EQ(around.service.count("POST"), calls);
  around.service.faults.clear();
  EXPECT_EQ(p.retry(report(mission_a, 1).key).queued, 1U);
  EXPECT_EQ(p.retry().queued, 1U);
  EXPECT_NE(p.retry(uuid(999)).error, "");
  p.advance(5s);
  EXPECT_EQ(around.service.at(mission_a).reports.size(), 1U);
  EXPECT_EQ(around.service.at(mission_a).observations.size(), 700U);
}

} // namespace failure_table_test
