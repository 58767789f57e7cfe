// What clears a plan, MISSION_CLEAR_ALL and a count of 0, and when it is refused: as PX4 1.17 and ArduPilot 4.7 were
// seen to answer on the wire, and as our own server does where they differ.
#include "actors/ground_port/mission_server/server.hpp"

#include <utility>

#include <gtest/gtest.h>

#include "tests/actors/ground_port/mission_server/plan_types.hpp"
#include "tests/actors/ground_port/mission_server/server_fixture.hpp"

namespace godwit::ground_port::mission_server::test {
namespace server_clear_test {

using words = dialogue::words;

TEST(server_clear, a_clear_is_for_one_type_and_all_is_for_each) {
  dialogue with(px4_profile());
  for (const int type : {0, fence, rally})
    (void)with.upload(2, type);
  EXPECT_EQ(with.tell(clear_of(fence)), words{"ACK accepted type 1"});
  EXPECT_EQ(with.held(0).items.size(), 2U);
  EXPECT_EQ(with.held(fence).items.size(), 0U);
  EXPECT_EQ(with.held(fence).id, 0U);
  EXPECT_EQ(with.held(rally).items.size(), 2U);
  EXPECT_EQ(with.tell(clear_of(all)), words{"ACK accepted type 255"});
  EXPECT_EQ(with.held(0).items.size() + with.held(rally).items.size(), 0U);
  EXPECT_EQ(with.changes().size(), 3U + 1U + 3U);
}

TEST(server_clear, ardupilot_and_our_server_name_the_type_that_they_do_not_know) {
  for (const auto& vehicle : {ardupilot_copter_profile(), plain_profile()}) {
    dialogue with(vehicle);
    EXPECT_EQ(with.tell(count_of(0, 7)), words{"ACK unsupported type 7"});
    EXPECT_EQ(with.tell(clear_of(7)), words{"ACK unsupported type 7"});
  }
  dialogue px4(px4_profile());
  (void)px4.upload(2);
  EXPECT_EQ(px4.tell(count_of(0, 7)), words{"ACK accepted type 7"});
  EXPECT_EQ(px4.held().items.size(), 2U) << "said, and nothing done";
}

TEST(server_clear, while_the_mission_is_flown_only_fence_and_rally_are_cleared) {
  dialogue with(plain_profile());
  for (const int type : {0, fence, rally})
    (void)with.upload(2, type);
  with.vehicle().lock(true);
  EXPECT_EQ(with.tell(clear_of(all)), words{"ACK denied type 255"});
  EXPECT_EQ(with.tell(clear_of(fence)), words{"ACK accepted type 1"});
  EXPECT_EQ(with.tell(count_of(0, rally)), words{"ACK accepted type 2"});
  EXPECT_EQ(with.held().items.size(), 2U);
  with.vehicle().lock(false);
  EXPECT_EQ(with.tell(clear_of(0)), words{"ACK accepted"});
}

TEST(server_clear, px4_and_our_server_do_not_clear_what_is_coming_in) {
  for (const auto& [vehicle, busy] : {std::pair{px4_profile(), "ACK error"}, {plain_profile(), "ACK denied"}}) {
    dialogue with(vehicle);
    (void)with.upload(3);
    (void)with.tell(count_of(1));
    EXPECT_EQ(with.tell(clear_of(0)), words{busy});
    EXPECT_EQ(with.held().items.size(), 3U);
    EXPECT_EQ(with.tell(waypoint(0)), words{"ACK accepted"});
    EXPECT_EQ(with.held().items.size(), 1U);
  }
}

} // namespace server_clear_test
} // namespace godwit::ground_port::mission_server::test
