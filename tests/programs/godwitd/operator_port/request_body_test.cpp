#include "programs/godwitd/operator_port/request_body.hpp"

#include <gtest/gtest.h>

namespace request_body_test {

using namespace godwit;
using namespace godwit::operator_port;
using operators::command_kind;

std::string place_of_problem(std::string_view body) {
  const auto read = read_command(body);
  return read ? "taken" : read.error().place;
}

TEST(operator_request_body, a_command_has_an_id_a_deadline_and_the_state_that_it_is_meant_for) {
  const auto read = read_command(
      R"({"id": "a1", "command": "go_to", "valid_until": "2027-01-15T08:00:00Z", "state": "paused/asked", "place": )"
      R"({"latitude": 47.5, "longitude": 8.5, "altitude_m": 40}})");
  ASSERT_TRUE(read) << read.error().sentence;
  EXPECT_EQ(read->id, "a1");
  EXPECT_EQ(read->valid_until_ns, 1'800'000'000'000'000'000);
  EXPECT_EQ(read->what.kind, command_kind::go_to);
  EXPECT_EQ(read->what.state, "paused/asked");
  EXPECT_EQ(read->what.place, (mission::position{47.5, 8.5, 40}));
}

TEST(operator_request_body, what_is_wrong_or_missing_is_named_by_its_place) {
  const std::string until = R"("valid_until": "2027-01-15T08:00:00Z")";
  EXPECT_EQ(place_of_problem("x"), "");
  EXPECT_EQ(place_of_problem("[]"), "");
  EXPECT_EQ(place_of_problem(R"({"id": "a"})"), "command");
  EXPECT_EQ(place_of_problem(R"({"id": "a", "command": "jump"})"), "command");
  EXPECT_EQ(place_of_problem(R"({"command": "start"})"), "id");
  EXPECT_EQ(place_of_problem(R"({"id": "a", "command": "start"})"), "valid_until");
  EXPECT_EQ(place_of_problem(R"({"id": "a", "command": "start", "valid_until": "soon"})"), "valid_until");
  EXPECT_EQ(place_of_problem(R"({"id": "a", "command": "start", )" + until + "}"), "state");
  EXPECT_EQ(place_of_problem(R"({"id": "a", "command": "acknowledge", "state": "x", )" + until + "}"), "report");
  EXPECT_EQ(place_of_problem(R"({"id": "a", "command": "go_to", "state": "x", )" + until + "}"), "place");
  EXPECT_EQ(place_of_problem(R"({"id": "a", "command": "go_to", "place": {"latitude": "north"}})"), "place.latitude");
  EXPECT_EQ(place_of_problem(R"({"id": "a", "command": "pause", "colour": 1})"), "colour");
  EXPECT_EQ(place_of_problem(R"({"id": 7, "command": "pause"})"), "id");
}

TEST(operator_request_body, a_hold_needs_an_id_alone_and_a_return_no_state) {
  EXPECT_EQ(place_of_problem(R"({"id": "a", "command": "pause"})"), "taken");
  EXPECT_EQ(place_of_problem(R"({"id": "a", "command": "come_home", "valid_until": "2027-01-15T08:00:00Z"})"), "taken");
}

TEST(operator_request_body, a_login_is_a_name_and_a_password_or_a_link) {
  const auto one = read_login(R"({"name": "anna", "password": "correct horse"})");
  ASSERT_TRUE(one);
  EXPECT_EQ(one->name, "anna");
  EXPECT_EQ(one->password.revealed(), "correct horse");
  EXPECT_EQ(read_login(R"({"link": "abc"})")->link.revealed(), "abc");
  for (const auto* body :
       {"", "7", R"({"name": "anna"})", R"({"password": "x"})", R"({"name": "anna", "link": "x"})",
        R"({"name": 7, "password": "x"})", R"({"name": "a", "password": "b", "role": "engineer"})", R"({"link": ""})"})
    EXPECT_FALSE(read_login(body)) << body;
}

TEST(operator_request_body, control_says_what_and_to_whom) {
  EXPECT_EQ(read_control(R"({"act": "hand_over", "to": "bob"})")->to, "bob");
  EXPECT_EQ(read_control(R"({"act": "hand_over"})").error().place, "to");
  EXPECT_EQ(read_control(R"({"act": "take_over", "to": "bob"})").error().place, "to");
  EXPECT_EQ(read_control(R"({"act": "steal"})").error().place, "act");
  EXPECT_EQ(read_control(R"({})").error().place, "act");
}

TEST(operator_request_body, a_token_is_a_bearers_or_the_cookies) {
  io::http::server_request asked;
  EXPECT_EQ(token_of(asked), "");
  asked.headers = {{"Cookie", "theme=dark; godwit_session=abc; x=y"}};
  EXPECT_EQ(token_of(asked), "abc");
  asked.headers.push_back({"Authorization", "Bearer def"});
  EXPECT_EQ(token_of(asked), "def");
  asked.headers = {{"Cookie", "xgodwit_session=abc"}};
  EXPECT_EQ(token_of(asked), "");
  asked.headers = {{"Cookie", ";;=;godwit_session="}};
  EXPECT_EQ(token_of(asked), "");
}

TEST(operator_request_body, the_audit_is_asked_for_by_1_to_200_rows_before_a_number) {
  EXPECT_EQ(read_audit_query("/api/v1/audit")->most, 50U);
  EXPECT_EQ(read_audit_query("/api/v1/audit?rows=200")->most, 200U);
  EXPECT_EQ(read_audit_query("/a?before=1200&rows=7")->before, 1'200U);
  EXPECT_EQ(read_audit_query("/a?before=1200&rows=7")->most, 7U);
  for (const auto* target :
       {"/a?rows=0", "/a?rows=201", "/a?rows=", "/a?rows=-1", "/a?rows=1x", "/a?x=1", "/a?rows=1&&", "/a?rows=1&rows=2",
        "/a?before=", "/a?before=-1", "/a?before=18446744073709551615"})
    EXPECT_FALSE(read_audit_query(target)) << target;
}

} // namespace request_body_test
