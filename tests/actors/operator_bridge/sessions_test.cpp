// Who is logged in, and for how long.
#include "actors/operator_bridge/sessions.hpp"

#include <gtest/gtest.h>

#include "tests/actors/operator_bridge/bridge_desk.hpp"

namespace godwit::operator_bridge::tests {
namespace sessions_test {

using operators::role;

identity who_is(bridge_desk& desk, const std::string& hash) {
  const auto [wanted, answer] = desk.decides().on_identify({hash}, desk.now);
  desk.execute(wanted);
  return answer;
}

TEST(operator_sessions, a_token_is_known_by_its_hash_until_the_session_was_silent_for_long) {
  bridge_desk desk;
  const auto anna = desk.log_in("anna");
  EXPECT_EQ(who_is(desk, "hash of anna").who, anna);
  desk.pass(desk.set.session_idle_s * s - 1);
  EXPECT_TRUE(who_is(desk, "hash of anna").is_known);
  desk.pass(desk.set.session_idle_s * s);
  EXPECT_FALSE(who_is(desk, "hash of anna").is_known);
  EXPECT_FALSE(who_is(desk, "").is_known);
}

TEST(operator_sessions, a_session_ends_after_its_longest_time_whatever_is_done_in_it) {
  bridge_desk desk;
  (void)desk.log_in("anna");
  std::int64_t passed = 0;
  for (; passed < desk.set.session_most_s; passed += 600) {
    ASSERT_TRUE(who_is(desk, "hash of anna").is_known) << passed;
    desk.pass(600 * s);
  }
  EXPECT_FALSE(who_is(desk, "hash of anna").is_known);
  desk.pass(sessions::swept_each_ns);
  EXPECT_TRUE(desk.durable.sessions.empty());
}

TEST(operator_sessions, that_one_was_used_is_written_once_a_minute_and_survives_a_restart) {
  bridge_desk desk;
  (void)desk.log_in("anna");
  const auto idle = desk.set.session_idle_s;
  for (std::int64_t passed = 0; passed < idle; passed += 30) {
    desk.pass(30 * s);
    (void)who_is(desk, "hash of anna");
  }
  desk.crash();
  desk.pass((idle - 61) * s);
  EXPECT_TRUE(who_is(desk, "hash of anna").is_known);
}

TEST(operator_sessions, a_link_logs_in_once_and_for_five_minutes) {
  bridge_desk desk;
  const auto make = [&](const operators::principal& by, const std::string& hash) {
    const auto [wanted, answer] = desk.decides().on_link({by, hash}, desk.now);
    desk.execute(wanted);
    return answer.is_made;
  };
  const auto use = [&](const std::string& hash) {
    const auto [wanted, answer] = desk.decides().on_open(use_link{hash, "token of " + hash, "there"}, desk.now);
    desk.execute(wanted);
    return answer;
  };
  EXPECT_FALSE(make(desk.log_in("anna"), "x")) << "not in a session";
  ASSERT_TRUE(make(local(), "one"));
  const auto opened = use("one");
  EXPECT_TRUE(opened.is_open);
  EXPECT_EQ(opened.who.role, role::engineer);
  EXPECT_EQ(who_is(desk, "token of one").who, opened.who);
  EXPECT_FALSE(use("one").is_open);
  ASSERT_TRUE(make(local(), "two"));
  desk.crash();
  desk.pass(sessions::link_ns);
  EXPECT_FALSE(use("two").is_open);
  EXPECT_EQ(std::ranges::count_if(desk.audit, [](const auto& each) { return each.second.who.session.empty(); }), 2);
}

TEST(operator_sessions, of_an_account_that_is_gone_or_has_another_role_or_password_end) {
  bridge_desk desk;
  for (const auto* name : {"anna", "bob", "carol", "dora"})
    (void)desk.log_in(name);
  desk.execute(desk.decides().on_accounts({{{"anna", role::operator_, "stamp", {}},
                                            {"bob", role::viewer, "stamp", {}},
                                            {"carol", role::operator_, "another", {}}}},
                                          desk.now));
  EXPECT_TRUE(who_is(desk, "hash of anna").is_known);
  for (const auto* name : {"bob", "carol", "dora"})
    EXPECT_FALSE(who_is(desk, std::string("hash of ") + name).is_known) << name;
  EXPECT_EQ(desk.over, (std::vector<std::string>{"s2", "s3", "s4"})) << "who shows them something has to know";
}

TEST(operator_sessions, a_program_comes_with_the_token_of_its_account) {
  bridge_desk desk;
  desk.execute(desk.decides().on_accounts({{{"planner", role::operator_, "stamp", "hash of its token"}}}, desk.now));
  const auto program = who_is(desk, "hash of its token").who;
  EXPECT_EQ(program.name, "planner");
  desk.crash();
  EXPECT_EQ(who_is(desk, "hash of its token").who, program) << "who reads the accounts tells them when they change";
  EXPECT_TRUE(desk.control(program, control_act::take).is_done);
  EXPECT_EQ(desk.say_all_the_way(desk.command(program, operators::command_kind::start)), verdict::taken);
  desk.execute(desk.decides().on_accounts({}, desk.now));
  EXPECT_EQ(desk.over, (std::vector<std::string>{"token:planner"}));
  EXPECT_FALSE(desk.durable.control);
  EXPECT_EQ(desk.say_all_the_way(desk.command(program, operators::command_kind::start)), verdict::no_session);
}

TEST(operator_sessions, one_too_many_ends_the_one_that_was_silent_for_longest) {
  bridge_desk desk;
  std::vector<operators::principal> all;
  for (std::size_t i = 0; i <= max_sessions_of_one; ++i) {
    all.push_back(desk.log_in("anna"));
    desk.pass(s);
  }
  EXPECT_EQ(desk.durable.sessions.size(), max_sessions_of_one);
  EXPECT_EQ(desk.durable.sessions.front().id, all[1].session);
  for (std::size_t i = 0; i < 2 * max_sessions; ++i)
    (void)desk.log_in("n" + std::to_string(i));
  EXPECT_EQ(desk.durable.sessions.size(), max_sessions);
}

} // namespace sessions_test
} // namespace godwit::operator_bridge::tests
