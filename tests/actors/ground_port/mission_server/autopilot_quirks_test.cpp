#include "actors/ground_port/mission_server/autopilot_quirks.hpp"

#include <gtest/gtest.h>

#include "actors/ground_port/mission_server/inbox.hpp"

namespace godwit::ground_port::mission_server {
namespace autopilot_quirks_test {

TEST(autopilot_quirks, the_three_ardupilots_differ_in_their_turns_only) {
  auto copter = ardupilot_copter_quirks();
  EXPECT_EQ(copter.turn_ns, 2'500'000);
  EXPECT_EQ(ardupilot_rover_quirks().turn_ns, 20 * ns_per_ms);
  EXPECT_EQ(ardupilot_plane_quirks().turn_ns, 20 * ns_per_ms);
  EXPECT_EQ(copter.asks_with, ardupilot_rover_quirks().asks_with);
}

TEST(autopilot_quirks, what_is_ours_goes_by_the_text) {
  const auto plain = plain_quirks();
  EXPECT_TRUE(plain.is_atomic);
  EXPECT_TRUE(plain.has_plan_ids);
  EXPECT_TRUE(plain.obeys_cancel);
  EXPECT_EQ(plain.turn_ns, 0);
  EXPECT_EQ(plain.asks_with, request_kind::mission_request_int);
}

TEST(autopilot_quirks, what_can_wait_and_the_patience_behind_it_are_over_in_10_s) {
  for (const auto& vehicle :
       {plain_quirks(), px4_quirks(), ardupilot_copter_quirks(), ardupilot_plane_quirks(), ardupilot_rover_quirks()}) {
    const auto turns = static_cast<std::int64_t>(max_waiting_messages) + 1; // the first one may just have begun
    EXPECT_LE(turns * vehicle.turn_ns + vehicle.gives_up_ns, 10'000 * ns_per_ms);
  }
}

} // namespace autopilot_quirks_test
} // namespace godwit::ground_port::mission_server
