#include <gtest/gtest.h>

#include "actors/vehicle_link/current_setter.hpp"
#include "tests/support/time_units.hpp"

namespace current_setter_test {

using namespace godwit::vehicle_link;
using godwit::io::mavlink::mav_result;
using godwit::io::mavlink::number;

using godwit::tests::ms;

command_outcome refused(mav_result why) {
  command_outcome result;
  result.verdict = command_verdict::refused;
  result.result = number(why);
  return result;
}

TEST(current_setter, a_vehicle_that_knows_the_command_answers_it) {
  current_setter setter;
  EXPECT_EQ(setter.begin(5, {3, {}}).param1, 3.0F);
  EXPECT_TRUE(setter.is_busy());
  command_outcome accepted;
  accepted.verdict = command_verdict::accepted;
  EXPECT_EQ(setter.on_outcome(accepted, 0)->verdict, command_verdict::accepted);
  EXPECT_FALSE(setter.is_busy());
}

TEST(current_setter, a_refusal_is_not_tried_around) {
  current_setter setter;
  (void)setter.begin(5, {3, {}});
  EXPECT_EQ(setter.on_outcome(refused(mav_result::denied), 0)->verdict, command_verdict::refused);
}

TEST(current_setter, a_vehicle_that_does_not_know_it_answers_by_its_broadcast) {
  current_setter setter;
  (void)setter.begin(5, {3, {}});
  EXPECT_FALSE(setter.on_outcome(refused(mav_result::unsupported), 0));
  EXPECT_FALSE(setter.on_mission_current(2));
  EXPECT_EQ(setter.on_mission_current(3)->verdict, command_verdict::accepted);
  EXPECT_FALSE(setter.on_mission_current(3)) << "answered once";
}

TEST(current_setter, a_broadcast_of_before_is_not_the_answer_to_the_command) {
  current_setter setter;
  (void)setter.begin(5, {3, {}});
  EXPECT_FALSE(setter.on_mission_current(3));
  EXPECT_TRUE(setter.is_busy());
}

TEST(current_setter, is_announced_in_three_copies_and_then_given_up) {
  current_setter setter;
  EXPECT_EQ(setter.begin(5, {3, {}}).copies, copies_of_moving_order);
  (void)setter.on_outcome(refused(mav_result::unsupported), 0);
  for (int copy = 1; copy < copies_of_moving_order; ++copy) {
    EXPECT_EQ(setter.next_deadline_ns(), copy * copy_after_ms * ms);
    EXPECT_TRUE(setter.wants_repetition(copy * copy_after_ms * ms));
    EXPECT_FALSE(setter.wants_repetition(copy * copy_after_ms * ms));
  }
  EXPECT_FALSE(setter.wants_repetition(10 * copy_after_ms * ms)) << "never again";
  EXPECT_FALSE(setter.on_time(announce_timeout_ms * ms - 1));
  EXPECT_EQ(setter.on_time(announce_timeout_ms * ms)->verdict, command_verdict::timed_out);
}

} // namespace current_setter_test
