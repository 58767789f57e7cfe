#include <vector>

#include <gtest/gtest.h>

#include "actors/failsafe/first_look.hpp"

namespace first_look_test {

using namespace godwit::failsafe;
namespace mavlink = godwit::io::mavlink;

TEST(first_look, it_asks_for_who_the_vehicle_is_first_and_for_one_message_at_a_time) {
  first_look look;
  look.begin();
  EXPECT_EQ(look.next(true), mavlink::heartbeat::message_id);
  EXPECT_FALSE(look.next(true));
  look.heard(mavlink::heartbeat::message_id);
  look.resolved();
  EXPECT_EQ(look.next(true), mavlink::extended_sys_state::message_id);
}

TEST(first_look, what_came_by_itself_is_not_asked_for) {
  first_look look;
  look.begin();
  look.heard(mavlink::heartbeat::message_id);
  look.heard(mavlink::extended_sys_state::message_id);
  look.heard(mavlink::sys_status::message_id);
  EXPECT_EQ(look.next(true), mavlink::global_position_int::message_id);
}

TEST(first_look, a_vehicle_that_does_not_answer_is_left_to_its_streams) {
  first_look look;
  look.begin();
  int asked = 0;
  while (look.next(true)) {
    ++asked;
    look.resolved();
  }
  EXPECT_EQ(asked, 5 * max_look_tries);
}

TEST(first_look, before_it_begins_and_after_all_was_heard_it_asks_for_nothing) {
  first_look look;
  EXPECT_FALSE(look.next(true));
  look.begin();
  for (const auto id : {mavlink::heartbeat::message_id, mavlink::extended_sys_state::message_id,
                        mavlink::global_position_int::message_id, mavlink::global_position_int::message_id,
                        mavlink::sys_status::message_id, mavlink::home_position::message_id})
    look.heard(id);
  EXPECT_FALSE(look.next(true));
}

TEST(first_look, one_position_proves_nothing_and_a_second_is_asked_for) {
  first_look look;
  look.begin();
  for (const auto id : {mavlink::heartbeat::message_id, mavlink::extended_sys_state::message_id,
                        mavlink::sys_status::message_id, mavlink::home_position::message_id})
    look.heard(id);
  EXPECT_EQ(look.next(true), mavlink::global_position_int::message_id);
  look.heard(mavlink::global_position_int::message_id);
  look.resolved();
  EXPECT_FALSE(look.next(false)); // it would say the same again
  EXPECT_EQ(look.next(true), mavlink::global_position_int::message_id);
  look.heard(mavlink::global_position_int::message_id);
  look.resolved();
  EXPECT_FALSE(look.next(true));
}

} // namespace first_look_test
