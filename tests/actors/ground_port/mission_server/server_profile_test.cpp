#include "actors/ground_port/mission_server/server_profile.hpp"

#include <gtest/gtest.h>

#include "actors/ground_port/mission_server/inbox.hpp"

namespace godwit::ground_port::mission_server {
namespace server_profile_test {

TEST(server_profile, the_three_ardupilots_differ_in_their_turns_only) {
  auto copter = ardupilot_copter_profile();
  EXPECT_EQ(copter.turn_ns, 2'500'000);
  EXPECT_EQ(ardupilot_rover_profile().turn_ns, 20 * ns_per_ms);
  EXPECT_EQ(ardupilot_plane_profile().turn_ns, 20 * ns_per_ms);
  EXPECT_EQ(copter.asks_with, ardupilot_rover_profile().asks_with);
}

TEST(server_profile, what_is_ours_goes_by_the_text) {
  const auto plain = plain_profile();
  EXPECT_TRUE(plain.is_atomic);
  EXPECT_TRUE(plain.has_plan_ids);
  EXPECT_TRUE(plain.obeys_cancel);
  EXPECT_EQ(plain.turn_ns, 0);
  EXPECT_EQ(plain.asks_with, request_kind::mission_request_int);
}

TEST(server_profile, what_can_wait_and_the_patience_after_it_are_over_in_10_s) {
  for (const auto& vehicle : {plain_profile(), px4_profile(), ardupilot_copter_profile(), ardupilot_plane_profile(),
                              ardupilot_rover_profile()}) {
    const auto turns = static_cast<std::int64_t>(max_waiting_messages) + 1; // the first one may just have begun
    EXPECT_LE(turns * vehicle.turn_ns + vehicle.gives_up_ns, 10'000 * ns_per_ms);
  }
}

} // namespace server_profile_test
} // namespace godwit::ground_port::mission_server
