#include "programs/godwitd/control/request_line.hpp"

#include <gtest/gtest.h>

namespace request_line_test {

using namespace godwit::control;

TEST(control_request_line, says_what_to_do) {
  EXPECT_EQ(read_request(R"({"do": "status"})")->what, request_kind::status);
  const auto retry = read_request(R"({"do": "outbox_retry", "key": "abc"})");
  ASSERT_TRUE(retry);
  EXPECT_EQ(retry->what, request_kind::outbox_retry);
  EXPECT_EQ(retry->key, "abc");
}

TEST(control_request_line, what_means_nothing_is_refused_with_the_form) {
  for (const auto* line : {"", "status", "[]", "{}", R"({"do": 7})", R"({"do": "land"})", "{\"do\": \"status\""})
    EXPECT_FALSE(read_request(line)) << line;
}

TEST(control_request_line, a_word_to_the_flight_says_whose_it_is) {
  const auto start = read_request(R"({"do": "start", "by": "anna"})");
  ASSERT_TRUE(start) << start.error();
  EXPECT_EQ(start->what, request_kind::command);
  EXPECT_EQ(start->said.kind, godwit::operators::command_kind::start);
  EXPECT_EQ(start->said.by, "anna");
  EXPECT_FALSE(read_request(R"({"do": "start"})"));
}

TEST(control_request_line, an_acknowledgement_names_its_report) {
  EXPECT_EQ(read_request(R"({"do": "acknowledge", "by": "anna", "report": 3})")->said.report, 3U);
  for (const auto* line :
       {R"({"do": "acknowledge", "by": "anna"})", R"({"do": "acknowledge", "by": "anna", "report": -1})",
        R"({"do": "acknowledge", "by": "anna", "report": 4294967297})"})
    EXPECT_FALSE(read_request(line)) << line;
  EXPECT_EQ(read_request(R"({"do": "acknowledge", "by": "anna", "report": 4294967295})")->said.report, 4294967295U);
}

TEST(control_request_line, who_is_sent_elsewhere_is_told_where) {
  const auto go =
      read_request(R"({"do": "go_to", "by": "anna", "place": {"latitude": 47.5, "longitude": 8.5, "altitude_m": 40}})");
  ASSERT_TRUE(go) << go.error();
  EXPECT_EQ(go->said.place, (godwit::mission::position{47.5, 8.5, 40}));
  EXPECT_FALSE(read_request(R"({"do": "go_to", "by": "anna"})"));
  EXPECT_FALSE(read_request(R"({"do": "insert", "by": "anna", "place": {"latitude": "north"}})"));
}

TEST(control_request_line, a_command_may_have_an_id_a_deadline_and_the_state_that_it_is_meant_for) {
  const auto start = read_request(
      R"({"do": "start", "by": "anna", "id": "a-1", "valid_until_ns": 1800000000000000000, "state": "ready/none"})");
  ASSERT_TRUE(start) << start.error();
  EXPECT_EQ(start->id, "a-1");
  EXPECT_EQ(start->valid_until_ns, 1'800'000'000'000'000'000);
  EXPECT_EQ(start->said.state, "ready/none");
  EXPECT_FALSE(read_request(R"({"do": "start", "by": "anna", "valid_until_ns": 18446744073709551615})"));
  EXPECT_FALSE(read_request(R"({"do": "start", "by": "anna", "valid_until_ns": "soon"})"));
}

TEST(control_request_line, control_is_taken_given_and_handed_over_to_somebody) {
  const auto take = read_request(R"({"do": "control", "by": "anna", "act": "take_over"})");
  ASSERT_TRUE(take) << take.error();
  EXPECT_EQ(take->act, godwit::operator_bridge::control_act::take_over);
  EXPECT_EQ(take->by, "anna");
  EXPECT_EQ(read_request(R"({"do": "control", "act": "hand_over", "to": "bob"})")->to, "bob");
  EXPECT_FALSE(read_request(R"({"do": "control", "act": "hand_over"})"));
  EXPECT_FALSE(read_request(R"({"do": "control", "act": "steal"})"));
}

TEST(control_request_line, the_audit_is_asked_for_by_its_newest_rows) {
  EXPECT_EQ(read_request(R"({"do": "audit"})")->rows, 50U);
  EXPECT_EQ(read_request(R"({"do": "audit", "rows": 200})")->rows, 200U);
  EXPECT_EQ(read_request(R"({"do": "audit", "before": 1200})")->before, 1'200U);
  EXPECT_FALSE(read_request(R"({"do": "audit", "before": -1})"));
  for (const auto* line :
       {R"({"do": "audit", "rows": 0})", R"({"do": "audit", "rows": 201})", R"({"do": "audit", "rows": -1})"})
    EXPECT_FALSE(read_request(line)) << line;
}

TEST(control_request_line, of_a_link_to_log_in_the_hash_is_told) {
  const std::string hash(64, 'a');
  EXPECT_EQ(read_request(R"({"do": "login", "by": "anna", "link_hash": ")" + hash + R"("})")->key, hash);
  EXPECT_FALSE(read_request(R"({"do": "login", "by": "anna", "link_hash": "the link"})"));
  EXPECT_FALSE(read_request(R"({"do": "login"})"));
}

TEST(control_request_line, giving_the_signing_key_says_whose_word_it_is) {
  const auto given = read_request(R"({"do": "sign", "by": "anna"})");
  ASSERT_TRUE(given) << given.error();
  EXPECT_EQ(given->what, request_kind::sign);
  EXPECT_EQ(given->by, "anna");
  EXPECT_FALSE(given->ends_signing);
  EXPECT_TRUE(read_request(R"({"do": "sign", "by": "anna", "off": true})")->ends_signing);
  EXPECT_FALSE(read_request(R"({"do": "sign"})"));
  EXPECT_FALSE(read_request(R"({"do": "sign", "by": "anna", "off": "yes"})"));
}

TEST(control_request_line, a_waypoint_at_a_point_has_its_number_and_an_altitude_and_no_place) {
  const auto insert = read_request(R"({"do": "insert", "by": "anna", "point": 3, "altitude_m": 40.5})");
  ASSERT_TRUE(insert) << insert.error();
  EXPECT_EQ(insert->point, 3U);
  EXPECT_EQ(insert->said.place->altitude_m, 40.5);
  for (const auto* line :
       {R"({"do": "insert", "by": "anna", "point": 3})",
        R"({"do": "insert", "by": "anna", "point": 0, "altitude_m": 40})",
        R"({"do": "insert", "by": "anna", "point": 3, "altitude_m": 40, "place": {}})",
        R"({"do": "insert", "point": 3, "altitude_m": 40})", R"({"do": "go_to", "by": "anna", "point": 3})"})
    EXPECT_FALSE(read_request(line)) << line;
}

TEST(control_request_line, a_decision_names_the_point_and_who_says_it) {
  const auto confirm = read_request(R"({"do": "confirm", "by": "anna", "point": 3})");
  ASSERT_TRUE(confirm) << confirm.error();
  EXPECT_EQ(confirm->what, request_kind::decide_point);
  EXPECT_EQ(confirm->decided.number, 3U);
  EXPECT_EQ(confirm->decided.says, godwit::scan_controller::decision::confirm);
  EXPECT_EQ(read_request(R"({"do": "decline", "by": "anna", "point": 3})")->decided.says,
            godwit::scan_controller::decision::decline);
  for (const auto* line : {R"({"do": "confirm", "by": "anna"})", R"({"do": "confirm", "point": 3})",
                           R"({"do": "confirm", "by": "anna", "point": -3})"})
    EXPECT_FALSE(read_request(line)) << line;
}

TEST(control_request_line, an_override_has_a_rule_and_a_time) {
  const auto one =
      read_request(R"({"do": "override", "by": "anna", "rule": "operator_link", "seconds": 60, "reason": "a hill"})");
  ASSERT_TRUE(one) << one.error();
  EXPECT_EQ(one->what, request_kind::override_rule);
  EXPECT_EQ(one->overridden.scope, godwit::failsafe::rule::operator_link);
  EXPECT_EQ(one->overridden.reason, "anna: a hill");
  EXPECT_EQ(one->lasts_s, 60);
  for (const auto* line :
       {R"({"do": "override", "rule": "all", "seconds": 60})", R"({"do": "override", "rule": "fence", "seconds": 0})",
        R"({"do": "override", "rule": "fence", "seconds": 9223372036})",
        R"({"do": "override", "rule": "fence", "seconds": 18446744073709551615})",
        R"({"do": "override", "rule": "fence", "seconds": 1e3})"})
    EXPECT_FALSE(read_request(line)) << line;
}

TEST(control_request_line, a_crash_names_its_actor) {
  const auto crash = read_request(R"({"do": "crash", "actor": "executor"})");
  ASSERT_TRUE(crash);
  EXPECT_EQ(crash->what, request_kind::crash);
  EXPECT_EQ(crash->key, "executor");
}

TEST(control_request_line, a_refusal_is_one_line_of_json) {
  EXPECT_EQ(refusal_line("no\nway"), R"({"error":"no\nway","ok":false})");
}

} // namespace request_line_test
