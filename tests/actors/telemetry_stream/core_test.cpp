#include "actors/telemetry_stream/core.hpp"
#include "tests/support/time_units.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace telemetry_stream_core_test {

using namespace godwit;
using namespace godwit::telemetry_stream;
using nlohmann::json;

using godwit::tests::ms;

TEST(telemetry_stream_core, a_position_is_in_degrees_metres_and_metres_a_second) {
  core all;
  io::mavlink::global_position_int m;
  m.lat = 473977000;
  m.lon = -85456000;
  m.alt = 500'500;
  m.relative_alt = 40'250;
  m.vx = 300;
  m.vy = -400;
  m.vz = -150;
  m.hdg = 9'000;
  const auto said = all.take(m, 1);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].what, topic::position);
  const auto data = json::parse(said[0].data);
  EXPECT_NEAR(data.at("latitude_deg").get<double>(), 47.3977, 1e-9);
  EXPECT_NEAR(data.at("longitude_deg").get<double>(), -8.5456, 1e-9);
  EXPECT_NEAR(data.at("altitude_m").get<double>(), 40.25, 1e-9);
  EXPECT_NEAR(data.at("altitude_msl_m").get<double>(), 500.5, 1e-9);
  EXPECT_NEAR(data.at("ground_speed_mps").get<double>(), 5, 1e-9);
  EXPECT_NEAR(data.at("climb_mps").get<double>(), 1.5, 1e-9);
  EXPECT_NEAR(data.at("heading_deg").get<double>(), 90, 1e-9);
}

TEST(telemetry_stream_core, what_the_vehicle_does_not_know_is_absent) {
  core all;
  io::mavlink::global_position_int position;
  position.hdg = 65535;
  EXPECT_TRUE(json::parse(all.take(position, 1)[0].data).at("heading_deg").is_null());
  io::mavlink::sys_status battery;
  battery.battery_remaining = -1;
  battery.current_battery = -1;
  battery.voltage_battery = 65535;
  const auto data = json::parse(all.take(battery, 1)[0].data);
  for (const auto* each : {"remaining_percent", "voltage_v", "current_a"})
    EXPECT_TRUE(data.at(each).is_null()) << each;
}

TEST(telemetry_stream_core, a_receiver_is_shown_with_what_it_knows_twice_a_second_and_a_home_when_it_moves) {
  core all;
  io::mavlink::gps_raw_int gps;
  gps.fix_type = 3;
  gps.satellites_visible = 12;
  gps.eph = 90;
  gps.h_acc = 1'500;
  const auto said = json::parse(all.take(gps, 1).at(0).data);
  EXPECT_EQ(said.at("fix"), 3);
  EXPECT_EQ(said.at("satellites"), 12);
  EXPECT_NEAR(said.at("hdop").get<double>(), 0.9, 1e-9);
  EXPECT_NEAR(said.at("accuracy_m").get<double>(), 1.5, 1e-9);
  EXPECT_TRUE(all.take(gps, 400 * ms).empty());
  gps.satellites_visible = 255;
  gps.eph = 65535;
  gps.h_acc = 0;
  const auto unknown = json::parse(all.take(gps, 600 * ms).at(0).data);
  for (const auto* each : {"satellites", "hdop", "accuracy_m"})
    EXPECT_TRUE(unknown.at(each).is_null()) << each;
  io::mavlink::home_position home;
  home.latitude = 473977000;
  home.altitude = 488'000;
  ASSERT_EQ(all.take(home, 1).size(), 1U);
  EXPECT_TRUE(all.take(home, 2).empty());
  home.latitude += 10;
  const auto moved = json::parse(all.take(home, 3).at(0).data);
  EXPECT_NEAR(moved.at("latitude_deg").get<double>(), 47.397701, 1e-9);
  EXPECT_NEAR(moved.at("altitude_msl_m").get<double>(), 488, 1e-9);
}

TEST(telemetry_stream_core, what_comes_many_times_a_second_is_shown_ten_times_and_the_battery_twice) {
  core all;
  int positions = 0;
  int attitudes = 0;
  int batteries = 0;
  for (std::int64_t now = 0; now < 1000 * ms; now += 10 * ms) {
    positions += static_cast<int>(all.take(io::mavlink::global_position_int{}, now).size());
    attitudes += static_cast<int>(all.take(io::mavlink::attitude{}, now).size());
    batteries += static_cast<int>(all.take(io::mavlink::sys_status{}, now).size());
  }
  EXPECT_EQ(positions, 10);
  EXPECT_EQ(attitudes, 10);
  EXPECT_EQ(batteries, 2);
}

TEST(telemetry_stream_core, a_battery_that_is_told_each_second_is_shown_each_second_however_it_comes) {
  core all;
  int shown = 0;
  for (int n = 0; n < 10; ++n)
    shown += static_cast<int>(all.take(io::mavlink::sys_status{}, n * 1000 * ms + (n % 2 == 0 ? 20 : -20) * ms).size());
  EXPECT_EQ(shown, 10);
}

TEST(telemetry_stream_core, of_a_flight_only_what_has_changed_is_shown_and_that_at_once) {
  core all;
  executor::flight_status status;
  status.phase = "flying";
  status.authority = "godwit";
  EXPECT_EQ(all.take(status, 1).size(), 3U) << "the first";
  EXPECT_TRUE(all.take(status, 2).empty());
  status.authority = "person";
  auto said = all.take(status, 3);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].what, topic::authority);
  EXPECT_EQ(json::parse(said[0].data).at("holder"), "person");
  ++status.items_done;
  said = all.take(status, 4);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].what, topic::progress);
  status.sentence = "another";
  said = all.take(status, 5);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].what, topic::flight);
}

TEST(telemetry_stream_core, missions_are_shown_when_they_have_changed) {
  core all;
  executor::known_missions known;
  known.list.emplace_back().mission_id = "m";
  const auto said = all.take(known, 1);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].what, topic::missions);
  EXPECT_EQ(json::parse(said[0].data).at("list").at(0).at("place"), "prepared");
  EXPECT_TRUE(all.take(known, 2).empty());
  known.list[0].reason = "another one is flown";
  EXPECT_EQ(all.take(known, 3).size(), 1U);
}

TEST(telemetry_stream_core, the_way_home_is_shown_twice_a_second_at_most_also_when_it_is_as_before) {
  core all;
  const executor::way_home_estimate same{
      .needs_percent = 23.4, .left_percent = 60, .reserve_percent = 25, .spare_percent = 11.6, .why_not_known = {}};
  EXPECT_EQ(json::parse(all.take(same, 1).at(0).data).at("needs_percent"), 23.4);
  EXPECT_TRUE(all.take(same, 400 * ms).empty());
  EXPECT_EQ(all.take(same, 501 * ms).size(), 1U) << "so that it does not look old";
}

TEST(telemetry_stream_core, other_aircraft_are_shown_as_they_are_told_and_what_is_not_known_of_them_is_null) {
  core all;
  executor::heard_traffic seen;
  seen.aircraft.emplace_back().name = "SWR123";
  seen.aircraft[0].distance_m = 800;
  const auto said = all.take(seen, 1);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].what, topic::traffic);
  const auto first = json::parse(said[0].data).at("aircraft").at(0);
  EXPECT_EQ(first.at("distance_m"), 800);
  EXPECT_TRUE(first.at("height_m").is_null());
}

TEST(telemetry_stream_core, a_map_is_shown_when_it_has_changed) {
  core all;
  mapobjects_store::map_status map;
  EXPECT_EQ(all.take(map, 1).size(), 1U);
  EXPECT_TRUE(all.take(map, 2).empty());
  ++map.seen_here;
  EXPECT_EQ(all.take(map, 3).size(), 1U);
}

TEST(telemetry_stream_core, beats_are_counted) {
  core all;
  (void)all.beat();
  EXPECT_EQ(json::parse(all.beat()[0].data).at("beat"), 2);
}

} // namespace telemetry_stream_core_test
