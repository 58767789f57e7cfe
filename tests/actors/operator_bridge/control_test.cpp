// Who has control.
#include "actors/operator_bridge/control.hpp"

#include <gtest/gtest.h>

#include "tests/actors/operator_bridge/bridge_world.hpp"

namespace godwit::operator_bridge::tests {
namespace control_test {

using operators::command_kind;
using operators::role;

TEST(operator_control, one_has_it_and_the_others_are_told_who) {
  bridge_world world;
  (void)world.pilot();
  const auto answer = world.control(world.log_in("bob"), control_act::take);
  EXPECT_FALSE(answer.is_done);
  EXPECT_EQ(answer.holder, "anna");
}

TEST(operator_control, of_who_is_silent_for_10_s_is_free) {
  bridge_world world;
  const auto anna = world.pilot();
  const auto bob = world.log_in("bob");
  world.pass(control::silent_ns);
  EXPECT_FALSE(world.control(bob, control_act::take).is_done);
  (void)world.decides().on_identify({"hash of anna"}, world.now);
  world.pass(control::silent_ns);
  EXPECT_FALSE(world.control(bob, control_act::take).is_done);
  world.pass(1);
  EXPECT_FALSE(world.durable.control) << "without anybody asking";
  EXPECT_TRUE(world.control(bob, control_act::take).is_done);
  EXPECT_EQ(world.say_all_the_way(world.command(anna, command_kind::resume)), verdict::no_control);
}

TEST(operator_control, who_had_it_has_10_s_after_a_restart) {
  bridge_world world;
  const auto anna = world.pilot();
  world.pass(9 * s);
  world.crash();
  world.pass(control::silent_ns);
  EXPECT_EQ(world.say_all_the_way(world.command(anna, command_kind::resume)), verdict::taken);
  world.crash();
  world.pass(control::silent_ns + 1);
  EXPECT_FALSE(world.durable.control);
}

TEST(operator_control, others_hear_at_most_once_a_second_that_its_holder_is_there_and_of_nobody_else) {
  bridge_world world;
  (void)world.log_in("bob");
  (void)world.pilot();
  (void)world.decides().on_identify({"hash of bob"}, world.now);
  (void)world.decides().takes_holder_news(world.now);
  EXPECT_FALSE(world.decides().takes_holder_news(world.now));
  int told = 0;
  for (int i = 0; i < 50; ++i) { // a request each 100 ms
    world.pass(s / 10);
    (void)world.decides().on_identify({"hash of anna"}, world.now);
    (void)world.decides().on_identify({"hash of bob"}, world.now);
    told += world.decides().takes_holder_news(world.now) ? 1 : 0;
  }
  EXPECT_EQ(told, 5);
  world.pass(2 * s);
  (void)world.decides().on_identify({"hash of bob"}, world.now);
  EXPECT_FALSE(world.decides().takes_holder_news(world.now));
}

TEST(operator_control, nobody_commands_in_a_session_without_having_taken_it) {
  bridge_world world;
  EXPECT_EQ(world.say_all_the_way(world.command(world.log_in("anna"), command_kind::start)), verdict::no_control);
}

TEST(operator_control, is_taken_from_others_by_an_engineer_alone) {
  bridge_world world;
  (void)world.pilot();
  EXPECT_FALSE(world.control(world.log_in("bob"), control_act::take_over).is_done);
  EXPECT_TRUE(world.control(local(), control_act::take_over).is_done);
  EXPECT_EQ(world.durable.control->who.name, "desk");
}

TEST(operator_control, is_handed_over_to_an_operator_who_is_logged_in) {
  bridge_world world;
  const auto anna = world.pilot();
  (void)world.log_in("eve", role::viewer);
  EXPECT_FALSE(world.control(anna, control_act::hand_over, "bob").is_done);
  EXPECT_FALSE(world.control(anna, control_act::hand_over, "eve").is_done);
  const auto bob = world.log_in("bob");
  EXPECT_FALSE(world.control(bob, control_act::hand_over, "bob").is_done) << "it is not his";
  EXPECT_EQ(world.control(anna, control_act::hand_over, "bob").holder, "bob");
  EXPECT_EQ(world.say_all_the_way(world.command(bob, command_kind::resume)), verdict::taken);
}

TEST(operator_control, is_taken_along_into_another_session_of_the_same_person) {
  bridge_world world;
  const auto first = world.pilot();
  const auto second = world.log_in("anna");
  EXPECT_TRUE(world.control(second, control_act::take).is_done);
  EXPECT_EQ(world.say_all_the_way(world.command(first, command_kind::resume)), verdict::no_control);
}

TEST(operator_control, ends_with_the_session) {
  bridge_world world;
  const auto anna = world.pilot();
  world.execute(world.decides().on_end({anna}, world.now).first);
  EXPECT_FALSE(world.durable.control);
}

TEST(operator_control, a_viewer_can_not_have_it) {
  bridge_world world;
  EXPECT_FALSE(world.control(world.log_in("eve", role::viewer), control_act::take).is_done);
}

} // namespace control_test
} // namespace godwit::operator_bridge::tests
