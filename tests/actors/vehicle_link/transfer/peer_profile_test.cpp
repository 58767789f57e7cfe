#include "actors/vehicle_link/transfer/peer_profile.hpp"

#include <gtest/gtest.h>

#include "actors/ground_port/mission_server/server_profile.hpp"

namespace godwit::vehicle_link::transfer {
namespace peer_profile_test {

using mavlink::mav_autopilot;
namespace mission_server = ground_port::mission_server;

TEST(peer_profile, only_px4_and_ardupilot_are_sent_items_ahead) {
  EXPECT_GT(profile_for(mav_autopilot::px4).max_window, 1);
  EXPECT_GT(profile_for(mav_autopilot::ardupilotmega).max_window, 1);
  for (const auto other : {mav_autopilot::generic, mav_autopilot::invalid, static_cast<mav_autopilot>(99)}) {
    const auto unknown = profile_for(other);
    EXPECT_EQ(unknown.first_window, 1);
    EXPECT_EQ(unknown.max_window, 1);
    EXPECT_EQ(unknown.max_requests_ahead, 1);
    EXPECT_FALSE(unknown.items_follow_count);
    EXPECT_FALSE(unknown.is_atomic) << "nothing is taken for granted";
  }
}

TEST(peer_profile, patience_is_longer_than_that_of_the_vehicle) {
  EXPECT_GT(profile_for(mav_autopilot::px4).patience_ns, mission_server::px4_profile().gives_up_ns);
  EXPECT_GT(profile_for(mav_autopilot::ardupilotmega).patience_ns,
            mission_server::ardupilot_rover_profile().gives_up_ns);
}

TEST(peer_profile, agrees_with_the_habits_of_the_vehicle) {
  const auto px4 = profile_for(mav_autopilot::px4);
  EXPECT_EQ(px4.is_atomic, mission_server::px4_profile().is_atomic);
  EXPECT_EQ(px4.obeys_cancel, mission_server::px4_profile().obeys_cancel);
  EXPECT_EQ(px4.keeps_plan_ids, mission_server::px4_profile().has_plan_ids);
  const auto copter = profile_for(mav_autopilot::ardupilotmega);
  EXPECT_EQ(copter.is_atomic, mission_server::ardupilot_copter_profile().is_atomic);
  EXPECT_EQ(copter.obeys_cancel, mission_server::ardupilot_copter_profile().obeys_cancel);
  EXPECT_EQ(copter.first_item_is_home, mission_server::ardupilot_copter_profile().home.has_value());
}

} // namespace peer_profile_test
} // namespace godwit::vehicle_link::transfer
