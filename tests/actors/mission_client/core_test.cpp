#include "actors/mission_client/core.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "actors/mission_client/retry_policy.hpp"
#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"
#include "messages/mission/item_fields.hpp"

namespace core_test {

using namespace godwit;
using namespace godwit::mission_client;

const std::string mission_a = "a";
constexpr std::int64_t hour_ns = 3'600 * second_ns;

report_progress report(std::uint32_t number, const std::string& mission = mission_a) {
  report_progress result;
  result.key = mission + std::to_string(number);
  result.report.mission_id = mission;
  result.report.report_no = number;
  return result;
}

insert_waypoint insert(const std::string& key) {
  insert_waypoint result;
  result.mission_id = mission_a;
  result.insert.idempotency_key = key;
  return result;
}

mission::document document(std::int32_t revision) {
  mission::document result;
  result.mission_id = mission_a;
  result.revision = revision;
  return result;
}

template <class E>
std::vector<E> only(const std::vector<effect>& all) {
  std::vector<E> result;
  for (const auto& each : all)
    if (const auto* found = std::get_if<E>(&each))
      result.push_back(*found);
  return result;
}

// A mission that is fetched and pulled.
state ready() {
  state s;
  (void)durable_core::apply(s, begin_mission{mission_a}, 1);
  (void)durable_core::apply(s, earlier_delivered{}, 2);
  (void)durable_core::apply(s, mission_fetched{document(1), {}}, 3);
  (void)durable_core::apply(s, pull_ended{{mission_a, pull_state::synced, 0, 0, {}}}, 4);
  return s;
}

TEST(mission_client_core, the_phases_follow_each_other_and_each_is_told) {
  state s;
  EXPECT_TRUE(durable_core::apply(s, begin_mission{mission_a}, 1).empty());
  EXPECT_EQ(s.now, phase::delivering_earlier);
  (void)durable_core::apply(s, earlier_delivered{}, 2);
  EXPECT_EQ(s.now, phase::fetching);
  EXPECT_EQ(only<mission_loaded>(durable_core::apply(s, mission_fetched{document(5), {}}, 3)).size(), 1U);
  EXPECT_EQ(s.now, phase::pulling);
  EXPECT_EQ(s.revision, 5);
  EXPECT_EQ(only<map_pulled>(durable_core::apply(s, pull_ended{{mission_a, pull_state::synced, 1, 2, {}}}, 4)).size(),
            1U);
  EXPECT_EQ(s.now, phase::ready);
}

TEST(mission_client_core, an_event_that_comes_in_the_wrong_phase_or_twice_changes_nothing) {
  auto s = ready();
  const auto before = io::to_json(s);
  EXPECT_TRUE(durable_core::apply(s, earlier_delivered{}, 9).empty());
  EXPECT_TRUE(durable_core::apply(s, mission_fetched{document(7), {}}, 9).empty());
  EXPECT_TRUE(durable_core::apply(s, fetch_failed{{mission_a, refusal::invalid, "x", {}}}, 9).empty());
  EXPECT_TRUE(durable_core::apply(s, pull_ended{{mission_a, pull_state::failed, 0, 0, "x"}}, 9).empty());
  EXPECT_TRUE(durable_core::apply(s, begin_mission{mission_a}, 9).empty());
  EXPECT_TRUE(durable_core::apply(s, pull_map{"b"}, 9).empty());
  EXPECT_TRUE(durable_core::apply(s, rows_delivered{{"nobody"}}, 9).empty());
  EXPECT_TRUE(durable_core::apply(s, rows_failed{{"nobody"}, "x", 0}, 9).empty());
  EXPECT_TRUE(durable_core::apply(s, change_failed{"nobody", change_verdict::unknown, "x"}, 9).empty());
  EXPECT_EQ(io::to_json(s), before);
}

TEST(mission_client_core, a_key_that_is_known_changes_nothing_before_and_after_delivery) {
  auto s = ready();
  for (int i = 0; i < 2; ++i) {
    (void)durable_core::apply(s, report(1), 10);
    (void)durable_core::apply(s, insert("k"), 10);
    EXPECT_EQ(s.rows.size(), 2U);
  }
  (void)durable_core::apply(s, rows_delivered{{"a1"}}, 11);
  (void)durable_core::apply(s, change_done{"k", document(2)}, 11);
  EXPECT_TRUE(durable_core::apply(s, report(1), 12).empty());
  EXPECT_TRUE(durable_core::apply(s, insert("k"), 12).empty());
  EXPECT_TRUE(s.rows.empty());
}

TEST(mission_client_core, reports_for_which_there_was_no_room_leave_no_gap_behind_them) {
  auto s = ready();
  (void)durable_core::apply(s, report(1), 10);
  outbox_row other;
  other.mission_id = "b";
  s.rows.resize(max_outbox_rows, other);
  (void)durable_core::apply(s, report(2), 11);
  (void)durable_core::apply(s, report(3), 12);
  EXPECT_EQ(s.rows.size(), max_outbox_rows);
  s.rows.pop_back(); // delivered
  (void)durable_core::apply(s, report(4), 13);
  ASSERT_EQ(s.rows.size(), max_outbox_rows);
  EXPECT_NE(s.rows.back().body.find(R"("report_no":2)"), std::string::npos) << s.rows.back().body;
  EXPECT_EQ(s.missions.at(0).lost_reports, 2U);
  EXPECT_EQ(s.refused_rows, 2U);
}

TEST(mission_client_core, the_window_counts_power_off_time_and_still_gives_one_more_try) {
  auto s = ready();
  (void)durable_core::apply(s, report(1), hour_ns);
  (void)durable_core::apply(s, rows_failed{{"a1"}, "down", 0}, hour_ns);
  auto restored = s; // two days without power
  const auto now = 49 * hour_ns;
  EXPECT_EQ(restored.rows[0].state, row_state::pending);
  EXPECT_TRUE(is_due(restored.rows[0].next_try_ns, now));
  (void)durable_core::apply(restored, rows_failed{{"a1"}, "down", 0}, now);
  EXPECT_EQ(restored.rows[0].state, row_state::expired);
  EXPECT_NE(restored.rows[0].last_error.find("down"), std::string::npos);
}

TEST(mission_client_core, a_clock_that_is_set_neither_shortens_nor_lengthens_the_window) {
  for (const auto jump : {-100 * hour_ns, 100 * hour_ns}) {
    auto s = ready();
    const auto begin = 1'000 * hour_ns;
    (void)durable_core::apply(s, report(1), begin);
    (void)durable_core::apply(s, rows_failed{{"a1"}, "down", 0}, begin);
    const auto wait = s.rows[0].next_try_ns - begin;
    (void)durable_core::apply(s, clock_jumped{jump}, begin + jump);
    EXPECT_EQ(s.rows[0].next_try_ns, begin + jump + wait);
    (void)durable_core::apply(s, rows_failed{{"a1"}, "down", 0}, begin + jump + 23 * hour_ns);
    EXPECT_EQ(s.rows[0].state, row_state::pending);
    (void)durable_core::apply(s, rows_failed{{"a1"}, "down", 0}, begin + jump + 24 * hour_ns);
    EXPECT_EQ(s.rows[0].state, row_state::expired);
  }
}

TEST(mission_client_core, a_first_failure_that_lies_ahead_begins_the_window_anew) {
  auto s = ready();
  (void)durable_core::apply(s, report(1), 1'000 * hour_ns);
  (void)durable_core::apply(s, rows_failed{{"a1"}, "down", 0}, 1'000 * hour_ns);
  (void)durable_core::apply(s, rows_failed{{"a1"}, "down", 0}, hour_ns); // started without a clock
  EXPECT_EQ(s.rows[0].first_failure_ns, hour_ns);
  EXPECT_EQ(s.rows[0].state, row_state::pending);
}

TEST(mission_client_core, a_full_outbox_refuses_reports_loudly_and_keeps_room_for_what_matters_more) {
  auto s = ready();
  for (std::uint32_t i = 1; i <= max_outbox_rows; ++i) {
    outbox_row row;
    row.key = "a" + std::to_string(i);
    row.mission_id = mission_a;
    row.order = s.next_order++;
    s.rows.push_back(std::move(row));
  }
  (void)durable_core::apply(s, report(max_outbox_rows + 1), 10);
  EXPECT_EQ(s.rows.size(), max_outbox_rows);
  EXPECT_EQ(s.refused_rows, 1U);
  EXPECT_TRUE(only<change_outcome>(durable_core::apply(s, insert("k"), 10)).empty());
  EXPECT_EQ(s.rows.size(), max_outbox_rows + 1);
  for (std::size_t i = 1; i < outbox_reserve; ++i)
    (void)durable_core::apply(s, insert("k" + std::to_string(i)), 10);
  const auto outcomes = only<change_outcome>(durable_core::apply(s, insert("last"), 10));
  ASSERT_EQ(outcomes.size(), 1U);
  EXPECT_EQ(outcomes[0].verdict, change_verdict::refused);
  EXPECT_EQ(s.refused_rows, 2U);
}

TEST(mission_client_core, an_older_mission_in_an_answer_does_not_replace_a_newer_one) {
  auto s = ready();
  (void)durable_core::apply(s, insert("k"), 10);
  (void)durable_core::apply(s, insert("l"), 10);
  EXPECT_EQ(only<mission_loaded>(durable_core::apply(s, change_done{"l", document(3)}, 11)).size(), 1U);
  const auto late = durable_core::apply(s, change_done{"k", document(2)}, 12);
  EXPECT_TRUE(only<mission_loaded>(late).empty());
  EXPECT_EQ(only<change_outcome>(late).size(), 1U);
  EXPECT_TRUE(only<mission_loaded>(durable_core::apply(s, mission_looked_up{mission_a, document(3), {}}, 13)).empty());
  EXPECT_EQ(s.revision, 3);
}

TEST(mission_client_core, what_an_expired_report_has_after_it_expires_too) {
  auto s = ready();
  for (std::uint32_t i = 1; i <= 3; ++i)
    (void)durable_core::apply(s, report(i), hour_ns);
  (void)durable_core::apply(s, rows_failed{{"a1"}, "down", 0}, hour_ns);
  (void)durable_core::apply(s, rows_failed{{"a1"}, "down", 0}, 25 * hour_ns);
  EXPECT_EQ(count_rows(s.rows).expired, 3U);
}

TEST(mission_client_core, queued_again_by_hand_a_row_begins_anew_and_its_place_in_the_order_stays) {
  auto s = ready();
  for (std::uint32_t i = 1; i <= 3; ++i)
    (void)durable_core::apply(s, report(i), hour_ns);
  (void)durable_core::apply(s, rows_refused{{"a1", "a2"}, "404", true}, 2 * hour_ns);
  EXPECT_EQ(count_rows(s.rows).orphaned, 2U);
  const auto answers = only<retry_answer>(durable_core::apply(s, retry_outbox{}, 3 * hour_ns));
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].queued, 2U);
  EXPECT_EQ(answers[0].tried_now, 1U);
  EXPECT_EQ(s.rows[0].key, "a1");
  EXPECT_EQ(s.rows[0].tries, 0U);
  EXPECT_EQ(s.rows[0].first_failure_ns, 0);
  EXPECT_EQ(count_rows(s.rows).pending, 3U);
}

deliver_picture picture(const std::string& observation_id, const std::string& mission = mission_a) {
  return {mission, observation_id, observation_id + ".jpg", hour_ns};
}

TEST(mission_client_core, a_picture_is_noted_once_and_only_for_a_service_that_takes_pictures) {
  for (const auto& [version, rows] : {std::pair{"2.2.0", 1U}, std::pair{"2.10.0", 1U}, std::pair{"3.0.0", 1U},
                                      std::pair{"2.1.9", 0U}, std::pair{"2.0.0", 0U}, std::pair{"1.9.0", 0U}}) {
    auto s = ready();
    s.schema_version = version;
    for (int time = 0; time < 2; ++time)
      EXPECT_EQ(only<picture_noted>(durable_core::apply(s, picture("o"), 9)).size(), 1U) << "who has it may forget it";
    ASSERT_EQ(s.rows.size(), rows) << version;
    if (rows == 0)
      continue;
    EXPECT_EQ(s.rows[0].subject, "o.jpg");
    (void)durable_core::apply(s, rows_delivered{{s.rows[0].key}}, 10);
    (void)durable_core::apply(s, picture("o"), 11);
    EXPECT_TRUE(s.rows.empty()) << "it was delivered";
  }
}

TEST(mission_client_core, pictures_of_a_flight_wait_for_its_push_and_those_of_earlier_ones_do_not) {
  auto s = ready();
  EXPECT_TRUE(is_in_flight(s, mission_a));
  EXPECT_FALSE(is_in_flight(s, "earlier"));
  (void)durable_core::apply(s, push_map{mission_a}, 9);
  EXPECT_FALSE(is_in_flight(s, mission_a));
}

TEST(mission_client_core, a_deleted_mission_orphans_its_own_rows_only_and_is_told_once) {
  auto s = ready();
  (void)durable_core::apply(s, report(1), 10);
  (void)durable_core::apply(s, report(1, "other"), 10);
  (void)durable_core::apply(s, insert("k"), 10);
  const auto first = durable_core::apply(s, mission_gone{mission_a}, 11);
  EXPECT_EQ(only<mission_deleted>(first).size(), 1U);
  EXPECT_EQ(only<change_outcome>(first).at(0).verdict, change_verdict::refused);
  EXPECT_TRUE(only<mission_deleted>(durable_core::apply(s, mission_gone{mission_a}, 12)).empty());
  EXPECT_EQ(count_rows(s.rows, mission_a).orphaned, 1U);
  EXPECT_EQ(count_rows(s.rows, "other").pending, 1U);
  ASSERT_EQ(s.store_operations.size(), 1U);
  EXPECT_EQ(s.store_operations[0].kind, store_operation_kind::delete_mission);
  (void)durable_core::apply(s, store_operation_done{s.store_operations[0]}, 13);
  EXPECT_TRUE(s.store_operations.empty());
}

TEST(mission_client_core, a_mission_is_settled_when_nothing_of_it_is_pending_and_once) {
  auto s = ready();
  (void)durable_core::apply(s, report(1), 10);
  EXPECT_TRUE(durable_core::apply(s, push_map{mission_a}, 10).empty());
  (void)durable_core::apply(s, batch_planned{"o", mission_a, destination::observations}, 11);
  (void)durable_core::apply(s, batch_planned{"i", mission_a, destination::ignored_items}, 11);
  EXPECT_TRUE(only<mission_resolved>(durable_core::apply(s, batch_empty{"o"}, 12)).empty());
  EXPECT_TRUE(only<mission_resolved>(durable_core::apply(s, batch_empty{"i"}, 12)).empty());
  const auto resolved = only<mission_resolved>(durable_core::apply(s, rows_delivered{{"a1"}}, 13));
  ASSERT_EQ(resolved.size(), 1U);
  EXPECT_EQ(resolved[0].orphaned, 0U);
  EXPECT_TRUE(only<mission_resolved>(durable_core::apply(s, report(2), 14)).empty());
}

TEST(mission_client_core, a_push_that_is_asked_for_again_looks_again_for_what_was_seen_since) {
  auto s = ready();
  (void)durable_core::apply(s, report(1), 10); // still waits
  (void)durable_core::apply(s, push_map{mission_a}, 10);
  (void)durable_core::apply(s, batch_planned{"o", mission_a, destination::observations}, 11);
  (void)durable_core::apply(s, batch_empty{"o"}, 12);
  EXPECT_TRUE(find_note(s, mission_a)->seen_done);
  (void)durable_core::apply(s, push_map{mission_a}, 13);
  EXPECT_FALSE(find_note(s, mission_a)->seen_done);
}

TEST(mission_client_core, what_was_seen_after_a_mission_was_deleted_is_kept_aside_by_the_store) {
  auto s = ready();
  (void)durable_core::apply(s, mission_gone{mission_a}, 10);
  (void)durable_core::apply(s, store_operation_done{s.store_operations.at(0)}, 11);
  const auto resolved = only<mission_resolved>(durable_core::apply(s, push_map{mission_a}, 12));
  EXPECT_EQ(resolved.size(), 1U);
  ASSERT_EQ(s.store_operations.size(), 1U);
  EXPECT_EQ(s.store_operations[0].kind, store_operation_kind::orphan_mission);
}

TEST(mission_client_core, notes_of_missions_are_bounded_and_the_one_that_is_owed_something_stays) {
  auto s = ready();
  (void)durable_core::apply(s, report(1, "owed"), 10);
  for (int i = 0; i < 200; ++i)
    (void)durable_core::apply(s, begin_mission{"m" + std::to_string(i)}, 11 + i);
  EXPECT_EQ(s.missions.size(), max_mission_notes);
  EXPECT_NE(find_note(s, "owed"), nullptr);
}

TEST(mission_client_core, open_assignments_are_bounded_and_told_again_after_a_restart) {
  auto s = ready();
  assignments_seen seen{mission_a, {}};
  for (int i = 0; i < 40; ++i)
    seen.assignments.push_back({std::to_string(i), 1, 2 + i, {}, {}});
  EXPECT_EQ(only<assignment_arrived>(durable_core::apply(s, seen, 10)).size(), max_open_assignments);
  EXPECT_EQ(durable_core::resume(s, 11).size(), max_open_assignments);
  respond_to_assignment answer{mission_a, "0", {}};
  answer.response.idempotency_key = "r";
  (void)durable_core::apply(s, answer, 12);
  EXPECT_EQ(s.revision, 2);
  EXPECT_EQ(durable_core::resume(s, 13).size(), max_open_assignments - 1);
  (void)durable_core::apply(s, rows_delivered{{"r"}}, 14);
  EXPECT_EQ(s.assignments.size(), max_open_assignments - 1);
}

TEST(mission_client_core, the_state_reads_back_from_its_text) {
  auto s = ready();
  (void)durable_core::apply(s, report(1), 10);
  (void)durable_core::apply(s, insert("k"), 10);
  (void)durable_core::apply(s, mission_gone{"other"}, 10);
  assignments_seen seen{mission_a, {{"x", 1, 2, {}, {mission::return_home{"home"}}}}};
  (void)durable_core::apply(s, seen, 10);
  state again;
  const auto read = io::read_json(nlohmann::json::parse(io::to_json(s)), again);
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(io::to_json(again), io::to_json(s));
}

} // namespace core_test
