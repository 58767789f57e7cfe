// MISSION_WRITE_PARTIAL_LIST: ArduPilot replaces the items, PX4 does not hear it, our server says that it can not.
#include "actors/ground_port/mission_server/server.hpp"

#include <gtest/gtest.h>

#include "tests/actors/ground_port/mission_server/server_fixture.hpp"

namespace godwit::ground_port::mission_server::test {
namespace server_partial_list_test {

using words = dialogue::words;

mavlink::mission_write_partial_list part_of(int first, int last) {
  mavlink::mission_write_partial_list message;
  message.start_index = static_cast<std::int16_t>(first);
  message.end_index = static_cast<std::int16_t>(last);
  return message;
}

mavlink::mission_item_int moved(int seq) {
  auto result = waypoint(seq);
  result.x += 1'000;
  return result;
}

TEST(server_partial_list, ardupilot_asks_for_these_items_and_replaces_them) {
  dialogue with(ardupilot_copter_profile());
  (void)with.upload(5);
  EXPECT_EQ(with.tell(part_of(2, 3)), words{"REQUEST 2"});
  EXPECT_EQ(with.tell(moved(2)), words{"REQUEST 3"});
  EXPECT_EQ(with.tell(moved(3)), words{"ACK accepted"});
  ASSERT_EQ(with.held().items.size(), 5U);
  EXPECT_EQ(with.held().items[1].x, waypoint(1).x);
  EXPECT_EQ(with.held().items[2].x, moved(2).x);
  EXPECT_EQ(with.held().items[3].x, moved(3).x);
  EXPECT_EQ(with.held().items[4].x, waypoint(4).x);
  EXPECT_EQ(with.changes().back().kind, plan_change_kind::replaced);
  EXPECT_EQ(with.changes().back().count, 5);
}

TEST(server_partial_list, ardupilot_takes_one_after_the_last_and_none_that_is_further) {
  dialogue with(ardupilot_copter_profile());
  (void)with.upload(3);
  EXPECT_EQ(with.tell(part_of(3, 3)), words{"REQUEST 3"});
  EXPECT_EQ(with.tell(moved(3)), words{"ACK accepted"});
  EXPECT_EQ(with.held().items.size(), 4U);
  (void)with.texts();
  for (const auto& part : {part_of(3, 5), part_of(-1, 1), part_of(2, 1), part_of(9, 9)}) {
    EXPECT_EQ(with.tell(part), words{"ACK error"});
    EXPECT_EQ(with.texts(), words{"Flight plan update rejected"});
    EXPECT_TRUE(with.vehicle().is_idle());
  }
}

TEST(server_partial_list, ardupilot_gives_up_as_with_a_whole_plan) {
  dialogue with(ardupilot_copter_profile());
  (void)with.upload(3);
  (void)with.tell(part_of(1, 1));
  EXPECT_EQ(with.tell(part_of(1, 1), other_station), words{"254/190 ACK denied"});
  EXPECT_EQ(with.wait(8 * s).back(), "ACK operation_cancelled");
  EXPECT_TRUE(with.vehicle().is_idle());
}

TEST(server_partial_list, px4_does_not_hear_it_and_our_server_can_not) {
  dialogue px4(px4_profile());
  (void)px4.upload(3);
  EXPECT_EQ(px4.tell(part_of(1, 1)), words());
  EXPECT_EQ(px4.tell(moved(1)), words{"ACK error"}) << "no transfer";
  dialogue plain(plain_profile());
  (void)plain.upload(3);
  EXPECT_EQ(plain.tell(part_of(1, 1)), words{"ACK unsupported"});
  EXPECT_TRUE(plain.vehicle().is_idle());
}

} // namespace server_partial_list_test
} // namespace godwit::ground_port::mission_server::test
