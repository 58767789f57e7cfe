#include "actors/vehicle_link/transfer/parties.hpp"

#include <gtest/gtest.h>

namespace godwit::vehicle_link::transfer {
namespace parties_test {

constexpr parties who{{1, 191}, {1, 1}, mavlink::mav_mission_type::fence};

mavlink::mission_ack ack_to(std::uint8_t system, std::uint8_t component, mavlink::mav_mission_type type) {
  mavlink::mission_ack ack;
  ack.target_system = system;
  ack.target_component = component;
  ack.mission_type = mavlink::number(type);
  return ack;
}

TEST(parties, address_the_peer_with_their_mission_type) {
  const auto count = who.addressed(mavlink::mission_count{});
  EXPECT_EQ(count.target_system, 1);
  EXPECT_EQ(count.target_component, 1);
  EXPECT_EQ(count.mission_type, 1);
}

TEST(parties, are_concerned_by_what_is_for_them_or_for_everybody) {
  EXPECT_TRUE(who.concerns(ack_to(1, 191, mavlink::mav_mission_type::fence)));
  EXPECT_TRUE(who.concerns(ack_to(0, 0, mavlink::mav_mission_type::fence)));
  EXPECT_TRUE(who.concerns(ack_to(1, 0, mavlink::mav_mission_type::fence)));
}

TEST(parties, are_not_concerned_by_what_is_for_others_or_for_another_plan) {
  EXPECT_FALSE(who.concerns(ack_to(255, 190, mavlink::mav_mission_type::fence)));
  EXPECT_FALSE(who.concerns(ack_to(1, 190, mavlink::mav_mission_type::fence)));
  EXPECT_FALSE(who.concerns(ack_to(1, 191, mavlink::mav_mission_type::mission)));
}

} // namespace parties_test
} // namespace godwit::vehicle_link::transfer
