// mission_client as an actor, when all goes well: the way of one mission, and what is told to whom.
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "tests/actors/mission_client/client_world.hpp"

namespace actor_test {

using namespace godwit;
using namespace godwit::mission_client;
using namespace godwit::mission_client::test;
using namespace std::chrono_literals;

void fill_map(service_mission& m, int objects, int ignored) {
  for (int i = 0; i < objects; ++i)
    m.map_objects.push_back({uuid(static_cast<std::uint64_t>(i), 'c'),
                             "vehicle",
                             47.4,
                             8.5,
                             {},
                             0.5,
                             "2026-05-01T08:00:00Z",
                             "2026-05-03T16:20:00Z"});
  for (int i = 0; i < ignored; ++i)
    m.map_ignored.push_back(
        {uuid(static_cast<std::uint64_t>(i), 'd'), "32TMT6634049690", "vehicle", "2026-05-04T10:16:02Z"});
}

TEST(mission_client_actor, a_mission_is_fetched_its_map_is_pulled_and_both_are_told) {
  outside around;
  fill_map(around.service.add(sample_mission(mission_a)), 250, 30);
  around.service.page_rows = 100;
  process p(around);
  begin(p, mission_a);
  ASSERT_EQ(around.listener.loaded.size(), 1U);
  EXPECT_EQ(around.listener.loaded[0].document, around.service.at(mission_a).document);
  ASSERT_EQ(around.listener.pulled.size(), 1U);
  EXPECT_EQ(around.listener.pulled[0].state, pull_state::synced);
  EXPECT_EQ(around.listener.pulled[0].objects, 250U);
  EXPECT_EQ(around.listener.pulled[0].ignored, 30U);
  EXPECT_EQ(around.store.objects.size(), 250U);
  EXPECT_EQ(around.store.chosen, mission_a);
  EXPECT_EQ(around.service.count("/mapobjects"), 4);
  const auto status = p.status();
  EXPECT_EQ(status.revision, 1);
  EXPECT_EQ(status.pull, pull_state::synced);
  EXPECT_EQ(status.connection, connection_state::reachable);
  EXPECT_EQ(status.last_error, "");
  EXPECT_EQ(p.health().colour, runtime::health_colour::green);
}

// A map of 250 objects that was pulled: then one is moved, one removed, one new.
struct changed_map {
  changed_map() {
    auto document = sample_mission(mission_a);
    document.schema_version = "2.3.0";
    fill_map(around.service.add(document), 250, 30);
    around.service.page_rows = 100;
    begin(p, mission_a);
    auto& m = around.service.at(mission_a);
    m.map_objects[7].latitude = 47.5;
    m.map_objects.erase(m.map_objects.begin() + 100);
    m.map_objects.push_back(m.map_objects[0]);
    m.map_objects.back().object_id = uuid(999, 'c');
    around.service.calls.clear();
  }
  void pull_again() {
    p.say(pull_map{mission_a});
    p.advance(3s);
  }
  void expect_the_map_of_the_service() {
    std::map<std::string, double> expected;
    for (const auto& each : around.service.at(mission_a).map_objects)
      expected[each.object_id] = each.latitude;
    std::map<std::string, double> found;
    for (const auto& each : around.store.objects)
      found[each.id] = each.position.latitude_deg;
    EXPECT_EQ(found, expected);
    ASSERT_EQ(around.listener.pulled.size(), 2U);
    EXPECT_EQ(around.listener.pulled[1].state, pull_state::synced) << around.listener.pulled[1].reason;
    EXPECT_EQ(around.listener.pulled[1].objects, expected.size());
    EXPECT_EQ(around.listener.pulled[1].ignored, 30U);
  }

  outside around;
  process p{around};
};

TEST(mission_client_actor, a_map_that_is_pulled_again_brings_only_what_has_changed) {
  changed_map world;
  world.pull_again();
  world.expect_the_map_of_the_service();
  EXPECT_EQ(world.around.store.loaded_objects.size(), 250U) << "two of the service, and the rest of the copy";
  EXPECT_EQ(world.around.service.calls["GET /missions/" + mission_a + "/mapobjects"], 1) << "a page instead of three";
}

TEST(mission_client_actor, a_service_that_does_not_know_its_mark_any_more_gives_all_of_the_map) {
  changed_map world;
  world.around.service.refuses_marks = true;
  world.pull_again();
  world.expect_the_map_of_the_service();
  EXPECT_EQ(world.around.service.calls["GET /missions/" + mission_a + "/mapobjects"], 4);
}

TEST(mission_client_actor, a_service_before_2_3_is_not_asked_for_marks) {
  outside around;
  auto document = sample_mission(mission_a);
  document.schema_version = "2.2.0";
  fill_map(around.service.add(document), 3, 0);
  process p(around);
  begin(p, mission_a);
  EXPECT_TRUE(around.service.at(mission_a).marked.empty());
  EXPECT_EQ(around.store.mark, "");
}

TEST(mission_client_actor, a_mission_that_is_begun_again_is_not_fetched_again) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  begin(p, mission_a);
  EXPECT_EQ(around.listener.loaded.size(), 1U);
  EXPECT_EQ(around.service.calls["GET /missions/" + mission_a], 1);
}

TEST(mission_client_actor, reports_go_out_in_order_and_many_together) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  for (std::uint32_t i = 1; i <= 250; ++i)
    p.say(report(mission_a, i));
  p.advance(2s);
  const auto& reports = around.service.at(mission_a).reports;
  ASSERT_EQ(reports.size(), 250U);
  for (std::uint32_t i = 0; i < reports.size(); ++i)
    EXPECT_EQ(reports[i].report_no, i + 1);
  EXPECT_LE(around.service.posts("/progress"), 5);
  EXPECT_EQ(around.service.at_once, 1);
  EXPECT_EQ(p.status().pending, 0U);
}

TEST(mission_client_actor, a_report_that_is_told_again_goes_out_once) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  for (int i = 0; i < 3; ++i) {
    p.say(report(mission_a, 1));
    p.advance(1s);
  }
  EXPECT_EQ(around.service.at(mission_a).reports.size(), 1U);
  EXPECT_EQ(around.service.posts("/progress"), 1);
}

TEST(mission_client_actor, an_acknowledged_insert_replaces_the_mission_in_memory) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  p.say(insert(mission_a, 1, 1));
  p.advance(1s);
  ASSERT_EQ(around.listener.loaded.size(), 2U);
  EXPECT_EQ(around.listener.loaded[1].cause, load_cause::changed);
  EXPECT_EQ(around.listener.loaded[1].document.revision, 2);
  ASSERT_EQ(around.listener.outcomes.size(), 1U);
  EXPECT_EQ(around.listener.outcomes[0].verdict, change_verdict::done);
  p.say(tail(mission_a, 2, 2));
  p.advance(1s);
  EXPECT_EQ(around.listener.loaded.back().document.revision, 3);
  EXPECT_EQ(p.status().revision, 3);
}

TEST(mission_client_actor, an_assignment_is_told_once_and_its_response_is_delivered) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.service.assign(mission_a, sample_assignment(m.document, 1));
  p.advance(5s);
  ASSERT_EQ(around.listener.arrived.size(), 1U);
  const auto& assigned = around.listener.arrived[0].assignment;
  EXPECT_EQ(assigned, m.assignments[0]);
  p.say(response(mission_a, assigned, mission::assignment_outcome::accepted, 1));
  p.advance(5s);
  EXPECT_EQ(m.responses.size(), 1U);
  EXPECT_EQ(around.listener.arrived.size(), 1U);
  EXPECT_EQ(p.status().revision, 2);
  EXPECT_LE(around.service.count("/assignments"), 5);
}

TEST(mission_client_actor, a_rejected_assignment_leaves_the_revision_and_the_next_one_is_told) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.service.assign(mission_a, sample_assignment(m.document, 1));
  p.advance(1s);
  p.say(response(mission_a, m.assignments[0], mission::assignment_outcome::rejected, 1));
  p.advance(1s);
  around.service.assign(mission_a, sample_assignment(m.document, 2));
  p.advance(2s);
  EXPECT_EQ(around.listener.arrived.size(), 2U);
  EXPECT_EQ(p.status().revision, 1);
}

TEST(mission_client_actor, an_assignment_comes_again_after_a_restart_until_it_is_responded_to) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  {
    process p(around);
    begin(p, mission_a);
    around.service.assign(mission_a, sample_assignment(m.document, 1));
    p.advance(1s);
    EXPECT_EQ(around.listener.arrived.size(), 1U);
  }
  {
    process p(around);
    p.advance(1s);
    EXPECT_EQ(around.listener.arrived.size(), 2U);
    p.say(response(mission_a, m.assignments[0], mission::assignment_outcome::rejected, 1));
    p.advance(1s);
  }
  process p(around);
  p.advance(1s);
  EXPECT_EQ(around.listener.arrived.size(), 2U);
}

TEST(mission_client_actor, after_the_flight_all_that_the_store_owes_is_delivered_and_the_mission_is_settled) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.store.owe(mission_a, 1'234, 56);
  p.advance(2s);
  EXPECT_EQ(around.store.owed(), 1'290U); // nothing before somebody says so
  p.say(push_map{mission_a});
  p.advance(5s);
  EXPECT_EQ(around.service.at(mission_a).observations.size(), 1'234U);
  EXPECT_EQ(around.service.at(mission_a).ignored.size(), 56U);
  EXPECT_EQ(around.store.owed(), 0U);
  ASSERT_EQ(around.listener.resolved.size(), 1U);
  EXPECT_EQ(around.listener.resolved[0].orphaned, 0U);
  EXPECT_EQ(around.service.calls["POST /missions/" + mission_a + "/mapobjects"], 3);
  EXPECT_EQ(p.status().push_pending, 0U);
}

TEST(mission_client_actor, what_an_earlier_mission_left_is_delivered_before_the_next_one_is_fetched) {
  outside around;
  around.service.add(sample_mission(mission_a));
  around.service.add(sample_mission(mission_b));
  {
    process p(around);
    begin(p, mission_a);
    around.store.owe(mission_a, 700, 10);
    around.service.faults.push_back({.where = mission_a});
    p.say(report(mission_a, 1));
    p.advance(100ms);
  }
  around.service.faults.clear();
  process p(around);
  p.say(begin_mission{mission_b});
  while (around.service.count("GET /missions/" + mission_b) == 0)
    p.advance(10ms);
  EXPECT_EQ(around.service.at(mission_a).reports.size(), 1U);
  EXPECT_EQ(around.service.at(mission_a).observations.size(), 700U);
  EXPECT_EQ(around.service.at(mission_a).ignored.size(), 10U);
  p.advance(1s);
  EXPECT_EQ(around.listener.loaded.back().document.mission_id, mission_b);
}

TEST(mission_client_actor, a_batch_that_the_outbox_does_not_know_is_delivered_under_its_own_key) {
  outside around;
  around.service.add(sample_mission(mission_a));
  around.service.add(sample_mission(mission_b));
  around.store.owe(mission_a, 5);
  (void)around.store.take({uuid(77), mission_a, store::destination::observations, 500});
  process p(around);
  begin(p, mission_b);
  EXPECT_EQ(around.service.at(mission_a).observations.size(), 5U);
  EXPECT_EQ(around.store.delivered_keys, std::vector<std::string>{uuid(77)});
}

TEST(mission_client_actor, the_table_of_deliveries_shows_tries_errors_and_what_is_delivered) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.service.faults.push_back({.where = "/progress", .times = 1});
  p.say(report(mission_a, 1));
  p.advance(500ms);
  const auto& row = around.disk.outbox.at(report(mission_a, 1).key);
  EXPECT_EQ(row.destination, "progress");
  EXPECT_EQ(row.tries, 1);
  EXPECT_EQ(row.state, runtime::delivery_state::pending);
  EXPECT_EQ(row.last_error, "nobody listens there");
  EXPECT_GT(row.next_try_ns, row.first_failure_ns);
  p.advance(2s);
  EXPECT_EQ(row.state, runtime::delivery_state::delivered);
}

TEST(mission_client_actor, nothing_is_delivered_that_is_not_on_the_disk) {
  outside around;
  around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  p.world.journal().fail_writes(true);
  p.say(report(mission_a, 1));
  p.advance(1s);
  EXPECT_EQ(around.service.posts("/progress"), 0);
  p.world.journal().fail_writes(false);
  p.advance(1s);
  EXPECT_EQ(around.service.at(mission_a).reports.size(), 1U);
}

TEST(mission_client_actor, the_same_steps_give_the_same_trace) {
  const auto run = [] {
    outside around;
    around.service.add(sample_mission(mission_a));
    around.store.owe(mission_a, 600, 3);
    around.service.faults.push_back({.where = "/mapobjects", .times = 2, .posts_only = true});
    process p(around);
    begin(p, mission_a);
    p.say(report(mission_a, 1));
    p.say(push_map{mission_a});
    p.advance(5s);
    return p.world.trace().lines();
  };
  const auto first = run();
  EXPECT_GT(first.size(), 50U);
  EXPECT_EQ(first, run());
}

} // namespace actor_test
