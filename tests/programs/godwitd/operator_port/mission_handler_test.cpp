// A mission from a browser: who may bring one, when, and what is said of a file that is none.
#include "programs/godwitd/operator_port/mission_api.hpp"

#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/programs/godwitd/operator_port/api_world.hpp"

namespace mission_handler_test {

using namespace godwit;
using namespace godwit::operator_port;
using operators::role;

std::string file_of(const std::string& name) {
  std::ifstream file(GODWIT_TEST_DATA "/missions/" + name);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

constexpr const char* check = "/api/v1/missions/check?format=plan";
constexpr const char* upload = "/api/v1/missions?format=plan";

class mission_upload_of : public testing::Test {
protected:
  tests::http_answer send(const std::string& target, const std::string& file, const std::string& token = {}) {
    return world.send_file(target, file, token);
  }
  void take_control(const std::string& token) {
    EXPECT_EQ(world.ask_as(token, "POST", "/api/v1/control", {{"act", "take"}}).status, 200U);
  }

  tests::api_world world;
};

TEST_F(mission_upload_of, a_file_is_looked_at_before_it_is_sent_and_nobody_hears_of_it) {
  const auto answer = send(check, file_of("simple.plan"));
  ASSERT_EQ(answer.status, 200U) << answer.body;
  EXPECT_FALSE(answer.body.at("mission").at("items").empty());
  EXPECT_TRUE(answer.body.at("losses").empty());
  EXPECT_TRUE(world.missions.empty());
}

TEST_F(mission_upload_of, what_is_wrong_with_a_file_is_said_with_its_place) {
  const auto cut = send(check, file_of("cut_off.plan"));
  EXPECT_EQ(cut.status, 422U);
  const auto wrong = send(check, file_of("wrong_types.plan"));
  EXPECT_EQ(wrong.status, 422U);
  EXPECT_NE(wrong.body.at("detail").get<std::string>().find("/"), std::string::npos) << wrong.body;
  EXPECT_EQ(send("/api/v1/missions/check", file_of("simple.plan")).body.at("place"), "format");
  EXPECT_EQ(world.ask("POST", check, {{"a", 1}}).status, 415U);
}

TEST_F(mission_upload_of, a_guarded_command_is_taken_where_the_settings_allow_it) {
  const auto with = [](int command) {
    const auto line = [](int seq, int number, double latitude) {
      return std::to_string(seq) + "\t0\t3\t" + std::to_string(number) + "\t2\t0\t0\t0\t" + std::to_string(latitude) +
             "\t8.5\t30\t1\n";
    };
    return "QGC WPL 110\n" + line(0, 16, 47) + line(1, 22, 47) + line(2, command, 0) + line(3, 16, 47.001);
  };
  const std::string target = "/api/v1/missions/check?format=waypoints";
  EXPECT_EQ(send(target, with(tests::allowed_command)).status, 200U);
  const auto other = send(target, with(207));
  EXPECT_EQ(other.status, 422U);
  EXPECT_NE(other.body.at("detail").get<std::string>().find("flight.allowed_commands"), std::string::npos)
      << other.body;
}

TEST_F(mission_upload_of, a_file_that_waits_to_be_read_keeps_no_other_request_waiting) {
  std::function<void()> waiting;
  world.run_in_background = [&](const std::function<void()>& work) {
    waiting = work;
    return true;
  };
  EXPECT_EQ(send(check, file_of("simple.plan")).status, 0U); // no answer yet
  ASSERT_TRUE(waiting);
  EXPECT_EQ(world.ask("GET", "/look").status, 200U);
}

TEST_F(mission_upload_of, where_too_many_files_wait_the_next_is_refused_at_once) {
  world.run_in_background = [](const std::function<void()>&) { return false; };
  for (const char* target : {check, upload}) {
    const auto answer = send(target, file_of("simple.plan"));
    EXPECT_EQ(answer.status, 503U);
    EXPECT_EQ(answer.body.at("detail"), "other files are being read; send it again in a few seconds");
  }
  EXPECT_TRUE(world.missions.empty());
}

TEST_F(mission_upload_of, who_has_control_hands_it_over_as_a_mission_of_its_own_with_one_row_in_the_audit) {
  const auto anna = world.log_in("anna", role::operator_);
  take_control(anna);
  const auto rows = world.rows();
  for (const std::size_t times : {1U, 2U}) {
    const auto answer = send(upload, file_of("simple.plan"), anna);
    ASSERT_EQ(answer.status, 200U) << answer.body;
    ASSERT_EQ(world.missions.size(), times);
    EXPECT_EQ(world.missions.back().mission_id, answer.body.at("mission_id"));
    EXPECT_EQ(world.rows(), rows + times);
  }
  EXPECT_NE(world.missions.front().mission_id, world.missions.back().mission_id);
}

TEST_F(mission_upload_of, without_session_role_or_control_and_in_flight_nothing_is_taken_and_one_row_says_so) {
  const auto text = file_of("simple.plan");
  const auto anna = world.log_in("anna", role::operator_);
  const auto carl = world.log_in("carl", role::viewer);
  const auto expect_refused = [&](const std::string& token, unsigned status) {
    const auto rows = world.rows();
    const auto answer = send(upload, text, token);
    EXPECT_EQ(answer.status, status) << answer.body;
    EXPECT_TRUE(world.missions.empty());
    EXPECT_EQ(world.rows(), rows + 1) << answer.body;
  };
  expect_refused({}, 401);
  expect_refused("not a token", 401);
  expect_refused(carl, 403);
  expect_refused(anna, 423); // nobody has it
  const auto bob = world.log_in("bob", role::operator_);
  take_control(bob);
  expect_refused(anna, 423);
  world.is_in_flight = true;
  expect_refused(bob, 409);
}

TEST_F(mission_upload_of, a_godwitd_whose_missions_come_another_way_says_which) {
  tests::api_world other({.why_no_missions = "missions come from the service: hand it over there"});
  const auto anna = other.log_in("anna", role::operator_);
  EXPECT_EQ(other.ask_as(anna, "POST", "/api/v1/control", {{"act", "take"}}).status, 200U);
  const auto answer = other.send_file(upload, file_of("simple.plan"), anna);
  EXPECT_EQ(answer.status, 409U);
  EXPECT_NE(answer.body.at("detail").get<std::string>().find("service"), std::string::npos);
  EXPECT_TRUE(other.missions.empty());
}

} // namespace mission_handler_test
