// Who has control.
#include "actors/operator_bridge/control.hpp"

#include <gtest/gtest.h>

#include "tests/actors/operator_bridge/bridge_desk.hpp"

namespace godwit::operator_bridge::tests {
namespace control_test {

using operators::command_kind;
using operators::role;

TEST(operator_control, one_has_it_and_the_others_are_told_who) {
  bridge_desk desk;
  (void)desk.pilot();
  const auto answer = desk.control(desk.log_in("bob"), control_act::take);
  EXPECT_FALSE(answer.is_done);
  EXPECT_EQ(answer.holder, "anna");
}

TEST(operator_control, of_who_is_silent_for_10_s_is_free) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  const auto bob = desk.log_in("bob");
  desk.pass(control::silent_ns);
  EXPECT_FALSE(desk.control(bob, control_act::take).is_done);
  (void)desk.decides().on_identify({"hash of anna"}, desk.now);
  desk.pass(control::silent_ns);
  EXPECT_FALSE(desk.control(bob, control_act::take).is_done);
  desk.pass(1);
  EXPECT_FALSE(desk.durable.control) << "without anybody asking";
  EXPECT_TRUE(desk.control(bob, control_act::take).is_done);
  EXPECT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::resume)), verdict::no_control);
}

TEST(operator_control, who_had_it_has_10_s_after_a_restart) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  desk.pass(9 * s);
  desk.crash();
  desk.pass(control::silent_ns);
  EXPECT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::resume)), verdict::taken);
  desk.crash();
  desk.pass(control::silent_ns + 1);
  EXPECT_FALSE(desk.durable.control);
}

TEST(operator_control, others_hear_at_most_once_a_second_that_its_holder_is_there_and_of_nobody_else) {
  bridge_desk desk;
  (void)desk.log_in("bob");
  (void)desk.pilot();
  (void)desk.decides().on_identify({"hash of bob"}, desk.now);
  (void)desk.decides().takes_holder_news(desk.now);
  EXPECT_FALSE(desk.decides().takes_holder_news(desk.now));
  int told = 0;
  for (int i = 0; i < 50; ++i) { // a request each 100 ms
    desk.pass(s / 10);
    (void)desk.decides().on_identify({"hash of anna"}, desk.now);
    (void)desk.decides().on_identify({"hash of bob"}, desk.now);
    told += desk.decides().takes_holder_news(desk.now) ? 1 : 0;
  }
  EXPECT_EQ(told, 5);
  desk.pass(2 * s);
  (void)desk.decides().on_identify({"hash of bob"}, desk.now);
  EXPECT_FALSE(desk.decides().takes_holder_news(desk.now));
}

TEST(operator_control, nobody_commands_in_a_session_without_having_taken_it) {
  bridge_desk desk;
  EXPECT_EQ(desk.say_all_the_way(desk.command(desk.log_in("anna"), command_kind::start)), verdict::no_control);
}

TEST(operator_control, is_taken_from_others_by_an_engineer_alone) {
  bridge_desk desk;
  (void)desk.pilot();
  EXPECT_FALSE(desk.control(desk.log_in("bob"), control_act::take_over).is_done);
  EXPECT_TRUE(desk.control(local(), control_act::take_over).is_done);
  EXPECT_EQ(desk.durable.control->who.name, "desk");
}

TEST(operator_control, is_handed_over_to_an_operator_who_is_logged_in) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  (void)desk.log_in("eve", role::viewer);
  EXPECT_FALSE(desk.control(anna, control_act::hand_over, "bob").is_done);
  EXPECT_FALSE(desk.control(anna, control_act::hand_over, "eve").is_done);
  const auto bob = desk.log_in("bob");
  EXPECT_FALSE(desk.control(bob, control_act::hand_over, "bob").is_done) << "it is not his";
  EXPECT_EQ(desk.control(anna, control_act::hand_over, "bob").holder, "bob");
  EXPECT_EQ(desk.say_all_the_way(desk.command(bob, command_kind::resume)), verdict::taken);
}

TEST(operator_control, is_taken_along_into_another_session_of_the_same_person) {
  bridge_desk desk;
  const auto first = desk.pilot();
  const auto second = desk.log_in("anna");
  EXPECT_TRUE(desk.control(second, control_act::take).is_done);
  EXPECT_EQ(desk.say_all_the_way(desk.command(first, command_kind::resume)), verdict::no_control);
}

TEST(operator_control, ends_with_the_session) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  desk.execute(desk.decides().on_end({anna}, desk.now).first);
  EXPECT_FALSE(desk.durable.control);
}

TEST(operator_control, a_viewer_can_not_have_it) {
  bridge_desk desk;
  EXPECT_FALSE(desk.control(desk.log_in("eve", role::viewer), control_act::take).is_done);
}

} // namespace control_test
} // namespace godwit::operator_bridge::tests
