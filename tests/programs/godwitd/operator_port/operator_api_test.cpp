// What operators do over HTTP, down to the executor and the audit.
#include "programs/godwitd/operator_port/operator_api.hpp"

#include <gtest/gtest.h>

#include "actors/domain/mission/utc_text.hpp"
#include "tests/programs/godwitd/operator_port/api_world.hpp"

namespace godwit::operator_port::tests {

std::string api_world::utc_in(std::int64_t seconds) const {
  return mission::utc_text(world.time().wall_ns() + seconds * 1'000'000'000);
}

namespace operator_api_test {

using namespace std::chrono_literals;
using operators::role;

constexpr const char* commands = "/api/v1/commands";
constexpr const char* control = "/api/v1/control";
constexpr const char* overrides = "/api/v1/overrides";
constexpr const char* points = "/api/v1/points";
constexpr const char* session = "/api/v1/session";

std::string pilot(api_world& world, const std::string& name = "anna") {
  auto token = world.log_in(name, role::operator_);
  (void)world.ask_as(token, "POST", control, {{"act", "take"}});
  return token;
}

TEST(operator_api, a_command_of_who_has_control_is_obeyed) {
  api_world world;
  const auto answer = world.ask_as(pilot(world), "POST", commands, world.command("start", "a1"));
  EXPECT_EQ(answer.status, 200U);
  EXPECT_EQ(answer.body.at("verdict"), "taken");
  ASSERT_EQ(world.obeyed.size(), 1U);
  EXPECT_EQ(world.obeyed[0].by, "anna");
}

TEST(
    operator_api,
    command_without_session_expired_replayed_cross_origin_wrong_role_without_control_late_stale_has_no_effect_and_one_audit_row_each) {
  api_world world;
  const auto anna = pilot(world);
  const auto bob = world.log_in("bob", role::operator_);
  const auto eve = world.log_in("eve", role::viewer);
  ASSERT_EQ(world.ask_as(anna, "POST", commands, world.command("start", "first")).status, 200U);
  ASSERT_EQ(world.obeyed.size(), 1U);
  const auto expect = [&](const std::string& who, const nlohmann::json& body, unsigned status,
                          const api_world::headers& more = {}) {
    const auto rows = world.rows();
    const auto answer = world.ask_as(who, "POST", commands, body, more);
    EXPECT_EQ(answer.status, status) << answer.body.dump();
    EXPECT_EQ(world.rows(), rows + 1) << answer.body.dump();
    EXPECT_EQ(world.obeyed.size(), 1U) << answer.body.dump();
  };
  expect("nobody", world.command("resume", "n1"), 401);
  expect(anna, world.command("start", "first"), 200); // as the first time
  expect(anna, world.command("resume", "o1"), 403, {{"Origin", "http://evil.example"}});
  expect(eve, world.command("resume", "e1"), 403);
  expect(bob, world.command("resume", "b1"), 423);
  auto late = world.command("resume", "l1");
  late["valid_until"] = world.utc_in(-1);
  expect(anna, late, 408);
  auto stale = world.command("resume", "s1");
  stale["state"] = "flying/none/m/1/1/0";
  expect(anna, stale, 412);
  world.world.advance(31min);
  expect(anna, world.command("resume", "x1"), 401); // expired
}

TEST(operator_api, hold_and_return_are_open_to_every_operator) {
  api_world world;
  (void)pilot(world);
  const auto bob = world.log_in("bob", role::operator_);
  EXPECT_EQ(world.ask_as(bob, "POST", commands, {{"id", "h"}, {"command", "pause"}}).status, 200U);
  EXPECT_EQ(
      world.ask_as(bob, "POST", commands, {{"id", "r"}, {"command", "come_home"}, {"valid_until", world.utc_in(5)}})
          .status,
      200U);
  EXPECT_EQ(world.obeyed.size(), 2U);
}

// Of whom it has identified before; nothing that moves the vehicle goes this way.
TEST(operator_api, hold_and_return_of_a_known_operator_go_out_while_operator_bridge_does_not_answer) {
  api_world world;
  const auto bob = world.log_in("bob", role::operator_);
  const auto eve = world.log_in("eve", role::viewer);
  for (const auto& each : {bob, eve})
    ASSERT_EQ(world.ask_as(each, "GET", "/api/v1/session").status, 200U);
  const auto stranger = world.log_in("carol", role::operator_);
  world.a_turn_takes = 20ms;
  const auto status_of = [&](const std::string& who, const nlohmann::json& command) {
    world.world.hang("operator_bridge");
    return world.ask_as(who, "POST", commands, command).status;
  };
  EXPECT_EQ(status_of(bob, {{"id", "h"}, {"command", "pause"}}), 200U);
  EXPECT_EQ(status_of(bob, {{"id", "r"}, {"command", "come_home"}, {"valid_until", world.utc_in(5)}}), 200U);
  ASSERT_EQ(world.obeyed.size(), 2U);
  EXPECT_EQ(world.obeyed[0].by, "bob");
  EXPECT_EQ(status_of(bob, {{"id", "l"}, {"command", "come_home"}, {"valid_until", world.utc_in(-1)}}), 408U);
  EXPECT_EQ(status_of(stranger, {{"id", "s"}, {"command", "pause"}}), 504U);
  EXPECT_EQ(status_of(eve, {{"id", "e"}, {"command", "pause"}}), 504U);
  EXPECT_EQ(status_of(bob, world.command("resume", "x")), 504U);
  EXPECT_EQ(world.obeyed.size(), 2U);
}

TEST(operator_api, what_is_stale_is_answered_with_the_state_as_it_is) {
  api_world world;
  auto stale = world.command("resume", "s1");
  stale["state"] = "flying/none/m/1/1/0";
  const auto answer = world.ask_as(pilot(world), "POST", commands, stale);
  EXPECT_EQ(answer.status, 412U);
  EXPECT_EQ(answer.body.at("state"), executor_stand_in::state);
}

TEST(operator_api, a_bad_body_is_answered_with_its_place) {
  api_world world;
  const auto anna = pilot(world);
  auto body = world.command("start", "a1");
  body["colour"] = 1;
  const auto answer = world.ask_as(anna, "POST", commands, body);
  EXPECT_EQ(answer.status, 400U);
  EXPECT_EQ(answer.body.at("place"), "colour");
  EXPECT_EQ(world.ask_as(anna, "POST", commands).status, 415U) << "no JSON";
  EXPECT_TRUE(world.obeyed.empty());
}

TEST(operator_api, a_link_opens_a_session_once_and_its_cookie_is_known_until_the_logout) {
  api_world world;
  (void)world.world.ask(world.bridge, 1s,
                        operator_bridge::make_link{{"desk", role::engineer, std::string(operators::local_session)},
                                                   accounts::hash_of_token("the link")});
  world.world.run_until_idle();
  const auto opened = world.ask("POST", session, {{"link", "the link"}});
  ASSERT_EQ(opened.status, 201U) << opened.body.dump();
  ASSERT_EQ(opened.cookie.size(), accounts::token_size);
  EXPECT_EQ(opened.body.at("role"), "engineer");
  EXPECT_EQ(world.ask("POST", session, {{"link", "the link"}}).status, 401U);
  EXPECT_EQ(world.ask_as(opened.cookie, "GET", session).body.at("name"), "desk");
  EXPECT_EQ(world.ask_as(opened.cookie, "DELETE", session).status, 204U);
  EXPECT_EQ(world.ask_as(opened.cookie, "GET", session).status, 401U);
}

TEST(operator_api, control_is_taken_shown_and_given) {
  api_world world;
  const auto anna = pilot(world);
  const auto bob = world.log_in("bob", role::operator_);
  EXPECT_EQ(world.ask_as(anna, "GET", control).body.at("is_yours"), true);
  EXPECT_EQ(world.ask_as(bob, "GET", control).body.at("holder"), "anna");
  const auto refused = world.ask_as(bob, "POST", control, {{"act", "take"}});
  EXPECT_EQ(refused.status, 409U);
  EXPECT_EQ(refused.body.at("holder"), "anna");
  EXPECT_EQ(world.ask_as(anna, "POST", control, {{"act", "hand_over"}, {"to", "bob"}}).status, 200U);
  EXPECT_EQ(world.ask_as(bob, "POST", control, {{"act", "give"}}).body.at("holder"), "");
}

TEST(operator_api, points_of_interest_are_shown_to_who_is_logged_in) {
  api_world world;
  const auto seen = world.ask_as(world.log_in("eve", role::viewer), "GET", points);
  EXPECT_EQ(seen.status, 200U);
  EXPECT_EQ(seen.body.at("is_looking"), true);
  EXPECT_EQ(seen.body.at("shown").at(0).at("number"), 4);
  EXPECT_EQ(seen.body.at("shown").at(0).at("has_picture"), false);
  world.pictured = {4};
  EXPECT_EQ(world.ask_as(world.log_in("anna", role::operator_), "GET", points).body.at("shown").at(0).at("has_picture"),
            true);
  EXPECT_EQ(world.ask("GET", points).status, 401U);
}

TEST(operator_api, a_decision_about_a_point_is_taken_from_who_has_control_and_each_has_one_audit_row) {
  api_world world;
  const auto anna = pilot(world);
  const auto bob = world.log_in("bob", role::operator_);
  const auto eve = world.log_in("eve", role::viewer);
  const nlohmann::json confirm{{"point", 4}, {"decision", "confirm"}};
  const auto expect = [&](const std::string& who, const nlohmann::json& body, unsigned status, std::size_t decided) {
    const auto rows = world.rows();
    const auto answer = world.ask_as(who, "POST", points, body);
    EXPECT_EQ(answer.status, status) << answer.body.dump();
    EXPECT_EQ(world.rows(), rows + 1) << answer.body.dump();
    EXPECT_EQ(world.decided.size(), decided);
  };
  expect("nobody", confirm, 401, 0);
  expect(eve, confirm, 403, 0);
  expect(bob, confirm, 423, 0);
  expect(anna, {{"point", 5}, {"decision", "decline"}}, 409, 0);
  expect(anna, confirm, 200, 1);
  EXPECT_EQ(world.decided.at(0).by, "anna");
  EXPECT_EQ(world.ask_as(anna, "POST", points, {{"point", 4}}).body.at("place"), "decision");
  EXPECT_EQ(world.ask_as(anna, "POST", points, {{"decision", "confirm"}}).body.at("place"), "point");
}

TEST(operator_api, a_rule_of_the_failsafe_is_overridden_by_an_engineer_who_has_control_and_each_try_is_one_audit_row) {
  api_world world;
  const auto anna = pilot(world);
  const auto bob = world.log_in("bob", role::engineer);
  const nlohmann::json hill{{"rule", "operator_link"}, {"seconds", 600}, {"reason", "we walk over the hill"}};
  const auto expect = [&](const std::string& who, const nlohmann::json& body, unsigned status, std::size_t overridden) {
    const auto rows = world.rows();
    const auto answer = world.ask_as(who, "POST", overrides, body);
    EXPECT_EQ(answer.status, status) << answer.body.dump();
    EXPECT_EQ(world.rows(), rows + 1) << answer.body.dump();
    EXPECT_EQ(world.overridden.size(), overridden);
  };
  expect("nobody", hill, 401, 0);
  expect(anna, hill, 403, 0);
  expect(bob, hill, 423, 0);
  EXPECT_EQ(world.ask_as(bob, "POST", control, {{"act", "take_over"}}).status, 200U);
  expect(bob, {{"rule", "battery_critical"}, {"seconds", 60}, {"reason", "it lies"}}, 409, 0);
  expect(bob, hill, 200, 1);
  EXPECT_EQ(world.overridden.at(0).scope, failsafe::rule::operator_link);
  EXPECT_EQ(world.overridden.at(0).reason, "we walk over the hill");
  const auto rows = world.ask_as(bob, "GET", "/api/v1/audit").body.at("rows");
  EXPECT_TRUE(std::ranges::any_of(rows, [](const auto& each) {
    return each.at("what") == "override operator_link for 600 s: we walk over the hill" &&
           each.at("outcome") == "taken";
  })) << rows.dump();
}

TEST(operator_api, an_override_says_which_rule_for_how_long_and_why) {
  api_world world;
  const auto bob = world.log_in("bob", role::engineer);
  const auto place = [&](const nlohmann::json& body) {
    return world.ask_as(bob, "POST", overrides, body).body.at("place");
  };
  EXPECT_EQ(place({{"seconds", 600}, {"reason", "r"}}), "rule");
  EXPECT_EQ(place({{"rule", "none"}, {"seconds", 600}, {"reason", "r"}}), "rule");
  EXPECT_EQ(place({{"rule", "fence"}, {"reason", "r"}}), "seconds");
  EXPECT_EQ(place({{"rule", "fence"}, {"seconds", 600}, {"reason", "  "}}), "reason");
  EXPECT_TRUE(world.overridden.empty());
}

TEST(operator_api, over_tls_the_cookie_is_for_tls_alone_and_at_the_logout_it_is_taken_back) {
  api_world world({.is_secure = true, .why_no_missions = {}});
  (void)world.world.ask(world.bridge, 1s,
                        operator_bridge::make_link{{"desk", role::engineer, std::string(operators::local_session)},
                                                   accounts::hash_of_token("the link")});
  world.world.run_until_idle();
  const auto opened = world.ask("POST", session, {{"link", "the link"}});
  EXPECT_NE(opened.head.find("; Secure"), std::string::npos) << opened.head;
  EXPECT_NE(opened.head.find("HttpOnly; SameSite=Strict"), std::string::npos) << opened.head;
  const auto ended = world.ask_as(opened.cookie, "DELETE", session);
  EXPECT_NE(ended.head.find("godwit_session=; Path=/; HttpOnly; SameSite=Strict; Secure; Max-Age=0"),
            std::string::npos);
  EXPECT_EQ(api_world().ask("POST", session, {{"link", "none"}}).head.find("Secure"), std::string::npos);
}

TEST(operator_api, from_another_computer_looking_needs_a_session_or_a_token) {
  api_world world;
  world.from = "192.168.7.9";
  const auto eve = world.log_in("eve", role::viewer);
  EXPECT_EQ(world.ask("GET", "/look").status, 401U);
  EXPECT_EQ(world.ask_as("nonsense", "GET", "/look").status, 401U);
  EXPECT_EQ(world.ask_as(eve, "GET", "/look").status, 200U);
  EXPECT_EQ(world.ask("GET", session).status, 401U) << "of which each looks after the session itself";
  world.world.advance(31min);
  EXPECT_EQ(world.ask_as(eve, "GET", "/look").status, 401U) << "the session is over";
}

TEST(operator_api, the_audit_has_the_address_of_who_logs_in) {
  api_world world;
  world.from = "192.168.7.9";
  EXPECT_EQ(world.ask("POST", session, {{"link", "none"}}).status, 401U);
  const auto anna = pilot(world);
  const auto rows = world.ask_as(anna, "GET", "/api/v1/audit").body.at("rows");
  EXPECT_TRUE(std::ranges::any_of(rows, [](const auto& each) {
    return each.at("what") == "log in by link from 192.168.7.9";
  })) << rows.dump();
}

TEST(operator_api, the_audit_is_for_operators) {
  api_world world;
  const auto anna = pilot(world);
  const auto list = world.ask_as(anna, "GET", "/api/v1/audit?rows=1");
  EXPECT_EQ(list.status, 200U);
  EXPECT_EQ(list.body.at("rows").size(), 1U);
  EXPECT_EQ(list.body.at("has_older"), true);
  const auto number = list.body.at("rows").at(0).at("number").get<int>();
  const auto older = world.ask_as(anna, "GET", "/api/v1/audit?before=" + std::to_string(number));
  EXPECT_EQ(older.body.at("rows").back().at("number"), number - 1);
  EXPECT_EQ(older.body.at("has_older"), false);
  EXPECT_EQ(world.ask_as(world.log_in("eve", role::viewer), "GET", "/api/v1/audit").status, 403U);
  EXPECT_EQ(world.ask("GET", "/api/v1/audit").status, 401U);
}

} // namespace operator_api_test
} // namespace godwit::operator_port::tests
