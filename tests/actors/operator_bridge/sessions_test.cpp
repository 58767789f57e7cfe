// Who is logged in, and for how long.
#include "actors/operator_bridge/sessions.hpp"

#include <gtest/gtest.h>

#include "tests/actors/operator_bridge/bridge_world.hpp"

namespace godwit::operator_bridge::tests {
namespace sessions_test {

using operators::role;

identity who_is(bridge_world& world, const std::string& hash) {
  const auto [wanted, answer] = world.decides().on_identify({hash}, world.now);
  world.execute(wanted);
  return answer;
}

TEST(operator_sessions, a_token_is_known_by_its_hash_until_the_session_was_silent_for_long) {
  bridge_world world;
  const auto anna = world.log_in("anna");
  EXPECT_EQ(who_is(world, "hash of anna").who, anna);
  world.pass(world.set.session_idle_s * s - 1);
  EXPECT_TRUE(who_is(world, "hash of anna").is_known);
  world.pass(world.set.session_idle_s * s);
  EXPECT_FALSE(who_is(world, "hash of anna").is_known);
  EXPECT_FALSE(who_is(world, "").is_known);
}

TEST(operator_sessions, a_session_ends_after_its_longest_time_whatever_is_done_in_it) {
  bridge_world world;
  (void)world.log_in("anna");
  std::int64_t passed = 0;
  for (; passed < world.set.session_most_s; passed += 600) {
    ASSERT_TRUE(who_is(world, "hash of anna").is_known) << passed;
    world.pass(600 * s);
  }
  EXPECT_FALSE(who_is(world, "hash of anna").is_known);
  world.pass(sessions::swept_each_ns);
  EXPECT_TRUE(world.durable.sessions.empty());
}

TEST(operator_sessions, that_one_was_used_is_written_once_a_minute_and_survives_a_restart) {
  bridge_world world;
  (void)world.log_in("anna");
  const auto idle = world.set.session_idle_s;
  for (std::int64_t passed = 0; passed < idle; passed += 30) {
    world.pass(30 * s);
    (void)who_is(world, "hash of anna");
  }
  world.crash();
  world.pass((idle - 61) * s);
  EXPECT_TRUE(who_is(world, "hash of anna").is_known);
}

TEST(operator_sessions, a_link_logs_in_once_and_for_five_minutes) {
  bridge_world world;
  const auto make = [&](const operators::principal& by, const std::string& hash) {
    const auto [wanted, answer] = world.decides().on_link({by, hash}, world.now);
    world.execute(wanted);
    return answer.is_made;
  };
  const auto use = [&](const std::string& hash) {
    const auto [wanted, answer] = world.decides().on_open(use_link{hash, "token of " + hash, "there"}, world.now);
    world.execute(wanted);
    return answer;
  };
  EXPECT_FALSE(make(world.log_in("anna"), "x")) << "not in a session";
  ASSERT_TRUE(make(local(), "one"));
  const auto opened = use("one");
  EXPECT_TRUE(opened.is_open);
  EXPECT_EQ(opened.who.role, role::engineer);
  EXPECT_EQ(who_is(world, "token of one").who, opened.who);
  EXPECT_FALSE(use("one").is_open);
  ASSERT_TRUE(make(local(), "two"));
  world.crash();
  world.pass(sessions::link_ns);
  EXPECT_FALSE(use("two").is_open);
  EXPECT_EQ(std::ranges::count_if(world.audit, [](const auto& each) { return each.second.who.session.empty(); }), 2);
}

TEST(operator_sessions, of_an_account_that_is_gone_or_has_another_role_or_password_end) {
  bridge_world world;
  for (const auto* name : {"anna", "bob", "carol", "dora"})
    (void)world.log_in(name);
  world.execute(world.decides().on_accounts({{{"anna", role::operator_, "stamp", {}},
                                              {"bob", role::viewer, "stamp", {}},
                                              {"carol", role::operator_, "another", {}}}},
                                            world.now));
  EXPECT_TRUE(who_is(world, "hash of anna").is_known);
  for (const auto* name : {"bob", "carol", "dora"})
    EXPECT_FALSE(who_is(world, std::string("hash of ") + name).is_known) << name;
  EXPECT_EQ(world.over, (std::vector<std::string>{"s2", "s3", "s4"})) << "who shows them something has to know";
}

TEST(operator_sessions, a_program_comes_with_the_token_of_its_account) {
  bridge_world world;
  world.execute(world.decides().on_accounts({{{"planner", role::operator_, "stamp", "hash of its token"}}}, world.now));
  const auto program = who_is(world, "hash of its token").who;
  EXPECT_EQ(program.name, "planner");
  world.crash();
  EXPECT_EQ(who_is(world, "hash of its token").who, program) << "who reads the accounts tells them when they change";
  EXPECT_TRUE(world.control(program, control_act::take).is_done);
  EXPECT_EQ(world.say_all_the_way(world.command(program, operators::command_kind::start)), verdict::taken);
  world.execute(world.decides().on_accounts({}, world.now));
  EXPECT_EQ(world.over, (std::vector<std::string>{"token:planner"}));
  EXPECT_FALSE(world.durable.control);
  EXPECT_EQ(world.say_all_the_way(world.command(program, operators::command_kind::start)), verdict::no_session);
}

TEST(operator_sessions, one_too_many_ends_the_one_that_was_silent_for_longest) {
  bridge_world world;
  std::vector<operators::principal> all;
  for (std::size_t i = 0; i <= max_sessions_of_one; ++i) {
    all.push_back(world.log_in("anna"));
    world.pass(s);
  }
  EXPECT_EQ(world.durable.sessions.size(), max_sessions_of_one);
  EXPECT_EQ(world.durable.sessions.front().id, all[1].session);
  for (std::size_t i = 0; i < 2 * max_sessions; ++i)
    (void)world.log_in("n" + std::to_string(i));
  EXPECT_EQ(world.durable.sessions.size(), max_sessions);
}

} // namespace sessions_test
} // namespace godwit::operator_bridge::tests
