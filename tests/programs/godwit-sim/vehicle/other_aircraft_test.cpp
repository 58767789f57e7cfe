#include "programs/godwit-sim/vehicle/other_aircraft.hpp"

#include <set>

#include <gtest/gtest.h>

#include "io/mavlink/frame_meaning.hpp"
#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace other_aircraft_test {

constexpr position home{47.397742, 8.545594, 488};

position place_of(const mavlink::adsb_vehicle& m) {
  return {m.lat / mavlink::units_a_degree, m.lon / mavlink::units_a_degree, 0};
}

TEST(other_aircraft, a_receiver_reports_each_once_a_second_by_its_own_component) {
  vehicle_world world(vehicle_settings{.who = personality::px4, .aircraft = 3});
  world.run_for(3 * s);
  const auto from_ns = world.now_ns();
  world.run_for(10 * s);
  std::multiset<std::uint32_t> heard_of;
  for (const auto& each : world.all())
    if (each.at_ns > from_ns && each.id == mavlink::adsb_vehicle::message_id) {
      EXPECT_EQ(mavlink::frame_view(each.bytes.data()).from(), (mavlink::sender{1, 156}));
      heard_of.insert(each.as<mavlink::adsb_vehicle>().icao_address);
    }
  for (const std::uint32_t icao : {0x4B0000U, 0x4B0001U, 0x4B0002U})
    EXPECT_EQ(heard_of.count(icao), 10U) << icao;
}

TEST(other_aircraft, one_flies_as_its_own_report_says_and_passes_home) {
  const auto before = other_aircraft(home, 0, 10);
  const auto after = other_aircraft(home, 0, 20);
  const auto way = between(place_of(before), place_of(after));
  EXPECT_NEAR(way.distance_m, before.hor_velocity / 100.0 * 10, 0.5);
  EXPECT_NEAR(way.bearing_deg, before.heading / 100.0, 0.5);
  EXPECT_LT(between(home, place_of(other_aircraft(home, 0, 4'000 / 30.0))).distance_m, 1);
}

TEST(other_aircraft, of_each_third_neither_altitude_nor_course_nor_speed_is_valid) {
  for (int i = 0; i < 9; ++i)
    EXPECT_EQ(other_aircraft(home, i, 0).flags, i % 3 == 2 ? 1 + 16 : 1 + 2 + 4 + 8 + 16 + 128) << i;
}

} // namespace other_aircraft_test
} // namespace godwit::sim::test
