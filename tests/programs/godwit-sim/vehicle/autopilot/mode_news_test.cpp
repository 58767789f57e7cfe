// How a change of mode is told, besides the HEARTBEAT of each second.
#include <algorithm>
#include <array>
#include <cstring>

#include <gtest/gtest.h>

#include "programs/godwit-sim/vehicle/autopilot/mode_table.hpp"
#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace {

constexpr std::uint32_t current_mode = 436;

struct told_modes {
  std::uint32_t actual = 0;
  std::uint32_t intended = 0;
  bool operator==(const told_modes&) const = default;
};

std::vector<told_modes> modes_told(const vehicle_world& world) {
  std::vector<told_modes> result;
  for (const auto& each : world.all()) {
    if (each.id != current_mode)
      continue;
    std::array<std::byte, 9> payload{}; // cut behind its last byte that is not 0
    constexpr std::size_t header = 10;
    const auto size = std::to_integer<std::size_t>(each.bytes[1]);
    std::copy_n(each.bytes.begin() + header, std::min(size, payload.size()), payload.begin());
    told_modes told;
    std::memcpy(&told.actual, payload.data(), sizeof told.actual);
    std::memcpy(&told.intended, payload.data() + sizeof told.actual, sizeof told.intended);
    result.push_back(told);
  }
  return result;
}

TEST(mode_news, a_copter_and_a_plane_send_a_heartbeat_at_once_at_each_change_and_others_do_not) {
  for (const auto who : {personality::ardupilot, personality::plane, personality::px4, personality::rover}) {
    vehicle_world world(who);
    const bool beats = who == personality::ardupilot || who == personality::plane;
    world.run_for(500 * ms);
    world.mark();
    static_cast<void>(world.command(mav_cmd::nav_return_to_launch));
    const auto heard = world.each<mavlink::heartbeat>();
    ASSERT_EQ(heard.size(), beats ? 1U : 0U) << io::name_of(who);
    if (beats) {
      EXPECT_EQ(heard.front().custom_mode, who == personality::plane ? 11U : 6U);
    }
  }
}

TEST(mode_news, a_px4_tells_the_mode_that_it_is_in_and_the_intended_one) {
  vehicle_world world(personality::px4);
  world.run_for(3 * s);
  ASSERT_FALSE(modes_told(world).empty());
  constexpr auto loiter = px4_mode(4, 3);
  constexpr auto rtl = px4_mode(4, 5);
  EXPECT_EQ(modes_told(world).back(), (told_modes{loiter, loiter}));
  ASSERT_EQ(world.command(mav_cmd::nav_return_to_launch), mav_result::accepted);
  EXPECT_EQ(modes_told(world).back(), (told_modes{rtl, rtl})) << "at once";
}

TEST(mode_news, what_a_px4_does_by_itself_for_safety_changes_the_actual_mode_alone) {
  vehicle_world world(personality::px4);
  ASSERT_EQ(world.upload(flight_of(3, world.home(), personality::px4)), mav_mission_result::accepted);
  ASSERT_EQ(world.command(mav_cmd::mission_start), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_current == 2; }, 60 * s));
  world.subject().lose_position(true, world.now_ns());
  EXPECT_EQ(modes_told(world).back(), (told_modes{px4_mode(4, 6), px4_mode(4, 4)}));
}

} // namespace
} // namespace godwit::sim::test
