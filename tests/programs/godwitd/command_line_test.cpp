#include "programs/godwitd/command_line.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace command_line_test {

using namespace godwit;
using namespace godwit::daemon;

tl::expected<invocation, runtime::exit_code> read(std::vector<const char*> words) {
  words.insert(words.begin(), "godwitd");
  return read_command_line(static_cast<int>(words.size()), words.data());
}

TEST(command_line, options_are_taken_by_their_names) {
  const auto asked = read({"--service", "https://example.org", "--once"});
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->what, task::run);
  EXPECT_EQ(asked->options, (given_texts{{"once", "true"}, {"service", "https://example.org"}}));
}

TEST(command_line, options_may_stand_after_a_command) {
  const auto asked = read({"ctl", "status", "--control", "socket", "--json"});
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->what, task::ask_status);
  EXPECT_EQ(asked->options.at("control"), "socket");
  EXPECT_TRUE(asked->json);
}

TEST(command_line, a_retry_is_of_all_rows_or_of_one) {
  EXPECT_EQ(read({"ctl", "outbox-retry"})->outbox_key, "");
  const auto one = read({"ctl", "outbox-retry", "key"});
  ASSERT_TRUE(one);
  EXPECT_EQ(one->what, task::retry_outbox);
  EXPECT_EQ(one->outbox_key, "key");
}

TEST(command_line, control_and_the_audit_are_asked_for) {
  const auto given = read({"ctl", "control", "hand-over", "bob"});
  ASSERT_TRUE(given);
  EXPECT_EQ(given->what, task::change_control);
  EXPECT_EQ(given->control.act, operator_bridge::control_act::hand_over);
  EXPECT_EQ(given->control.to, "bob");
  EXPECT_FALSE(read({"ctl", "control", "hand-over"}));
  EXPECT_FALSE(read({"ctl", "control"}));
  EXPECT_EQ(read({"ctl", "audit", "--rows", "7"})->rows, 7U);
  EXPECT_FALSE(read({"ctl", "audit", "--rows", "0"}));
}

TEST(command_line, an_account_has_a_name_and_a_role_and_never_a_password) {
  const auto add = read({"operator", "add", "anna", "--role", "engineer", "--accounts", "file"});
  ASSERT_TRUE(add);
  EXPECT_EQ(add->what, task::keep_accounts);
  EXPECT_EQ(add->account.act, accounts::operator_act::add);
  EXPECT_EQ(add->account.name, "anna");
  EXPECT_EQ(add->account.role, operators::role::engineer);
  EXPECT_EQ(add->options.at("accounts"), "file");
  for (const auto& words : {std::vector<const char*>{"operator", "add", "anna"},
                            {"operator", "add", "anna", "--role", "king"},
                            {"operator", "add", "--role", "viewer"},
                            {"operator", "passwd", "anna", "secret"},
                            {"operator"}})
    EXPECT_FALSE(read(words));
  EXPECT_EQ(read({"operator", "list"})->account.act, accounts::operator_act::list);
  EXPECT_EQ(read({"ctl", "login"})->what, task::make_link);
  EXPECT_EQ(read({"ctl", "sign"})->what, task::set_up_signing);
  EXPECT_FALSE(read({"ctl", "sign"})->ends_signing);
  EXPECT_TRUE(read({"ctl", "sign", "--off"})->ends_signing);
}

TEST(command_line, a_conversion_has_two_files) {
  const auto asked = read({"convert", "a.plan", "b.json", "--allow-partial"});
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->what, task::convert);
  EXPECT_EQ(asked->files.in, "a.plan");
  EXPECT_EQ(asked->files.out, "b.json");
  EXPECT_TRUE(asked->has("allow-partial"));
  EXPECT_EQ(read({"convert", "a.plan"}).error(), runtime::exit_code::usage);
}

TEST(command_line, a_word_to_the_flight_has_what_it_needs) {
  using operators::command_kind;
  EXPECT_EQ(read({"ctl", "hand-back"})->said.kind, command_kind::hand_back);
  EXPECT_EQ(read({"ctl", "end-flight"})->said.kind, command_kind::end_flight);
  EXPECT_EQ(read({"ctl", "ack", "3"})->said.report, 3U);
  EXPECT_EQ(read({"ctl", "ack"}).error(), runtime::exit_code::usage);
  const auto go = read({"ctl", "goto", "47.398,-8.5,40"});
  ASSERT_TRUE(go);
  EXPECT_EQ(go->what, task::say_word);
  EXPECT_EQ(go->said.place, (mission::position{47.398, -8.5, 40}));
  for (const auto* wrong : {"47.398,8.5", "47.398,8.5,40,1", "here"})
    EXPECT_EQ(read({"ctl", "goto", wrong}).error(), runtime::exit_code::usage) << wrong;
  EXPECT_EQ(read({"ctl", "insert", "47.398,8.5,40", "--after", "w2"})->said.after, "w2");
}

TEST(command_line, a_waypoint_is_inserted_at_a_place_or_at_a_point_with_an_altitude) {
  const auto at_point = read({"ctl", "insert", "--point", "3", "--altitude", "40"});
  ASSERT_TRUE(at_point);
  EXPECT_EQ(at_point->point, 3U);
  EXPECT_EQ(at_point->said.place->altitude_m, 40);
  using words = std::vector<const char*>;
  for (const auto& wrong :
       {words{"ctl", "insert"}, words{"ctl", "insert", "--point", "3"}, words{"ctl", "insert", "--altitude", "40"},
        words{"ctl", "insert", "47.398,8.5,40", "--point", "3", "--altitude", "40"}})
    EXPECT_EQ(read(wrong).error(), runtime::exit_code::usage) << wrong.size();
}

TEST(command_line, a_point_is_confirmed_or_declined_by_its_number) {
  EXPECT_EQ(read({"ctl", "points"})->what, task::list_points);
  const auto decided = read({"ctl", "decline", "3"});
  ASSERT_TRUE(decided);
  EXPECT_EQ(decided->what, task::decide_point);
  EXPECT_EQ(decided->decided.number, 3U);
  EXPECT_EQ(decided->decided.says, scan_controller::decision::decline);
  EXPECT_EQ(read({"ctl", "confirm"}).error(), runtime::exit_code::usage);
}

TEST(command_line, an_override_has_a_rule_a_time_and_a_reason) {
  const auto asked = read({"ctl", "override", "operator_link", "600", "we walk over the hill"});
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->what, task::override_failsafe);
  EXPECT_EQ(asked->overridden.seconds, 600);
  EXPECT_EQ(read({"ctl", "override", "operator_link"}).error(), runtime::exit_code::usage);
}

TEST(command_line, a_mistake_is_usage_and_help_is_not) {
  EXPECT_EQ(read({"--servce", "x"}).error(), runtime::exit_code::usage);
  EXPECT_EQ(read({"fly"}).error(), runtime::exit_code::usage);
  EXPECT_EQ(read({"ctl"}).error(), runtime::exit_code::usage);
  testing::internal::CaptureStdout();
  EXPECT_EQ(read({"--help"}).error(), runtime::exit_code::ok);
  const auto help = testing::internal::GetCapturedStdout();
  EXPECT_NE(help.find("--token-file"), std::string::npos);
  EXPECT_NE(help.find("Examples"), std::string::npos);
}

} // namespace command_line_test
