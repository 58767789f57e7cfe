#include "programs/godwit-sim/vehicle_options.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace godwit::sim {
namespace vehicle_options_test {

vehicle_arguments usual() {
  vehicle_arguments given;
  given.personality = "px4";
  return given;
}

TEST(vehicle_options, what_is_given_reaches_the_vehicle) {
  auto given = usual();
  given.personality = "rover";
  given.links = {"tcpin://127.0.0.1:5760"};
  given.home = "-35.363262, 149.165237, 584";
  given.speed = 20;
  given.seed = 7;
  given.system = 42;
  given.battery = 55;
  given.faults = "loss=0.1";
  given.refuse = {"MISSION_START=FAILED", "400"};
  given.fault_at = {"30s=gps lost"};
  given.control = "127.0.0.1:14600";
  given.arm_on_start = true;
  given.tlog = "a.tlog";
  given.quiet = true;
  const auto settings = read(given);
  ASSERT_TRUE(settings) << settings.error();
  ASSERT_EQ(settings->vehicles.size(), 1U);
  const auto& one = settings->vehicles[0];
  EXPECT_EQ(one.vehicle.who, personality::rover);
  EXPECT_EQ(one.where.text(), "tcpin://127.0.0.1:5760");
  EXPECT_EQ(one.vehicle.home, (position{-35.363262, 149.165237, 584}));
  EXPECT_EQ(one.vehicle.speed, 20);
  EXPECT_EQ(one.vehicle.seed, 7U);
  EXPECT_EQ(one.vehicle.system, 42);
  EXPECT_EQ(one.vehicle.battery_percent, 55);
  EXPECT_TRUE(one.vehicle.arms_on_start);
  EXPECT_EQ(one.faults.in.loss, 0.1);
  EXPECT_EQ(one.refusals, (std::vector<fault::refuse>{{300, 4, -1}, {400, 2, -1}}));
  EXPECT_EQ(settings->faults.size(), 1U);
  EXPECT_EQ(settings->control->text(), "tcpin://127.0.0.1:14600");
  EXPECT_EQ(settings->tlog, "a.tlog");
  EXPECT_TRUE(settings->is_quiet);
}

TEST(vehicle_options, a_mistake_names_the_option_the_value_and_the_form) {
  const std::pair<std::function<void(vehicle_arguments&)>, const char*> mistakes[] = {
      {[](auto& given) { given.personality = "glider"; }, "--personality: \"glider\" is no personality: rover, px4, "},
      {[](auto& given) { given.links = {"udp:14550"}; }, "--link: \"udp:14550\""},
      {[](auto& given) { given.home = "here"; }, "--home: \"here\" is no place: LATITUDE,LONGITUDE,ALTITUDE"},
      {[](auto& given) { given.home = "1,2"; }, "--home: \"1,2\" is no place"},
      {[](auto& given) { given.home = "91,0,0"; }, "--home: \"91,0,0\" lies nowhere"},
      {[](auto& given) { given.home = "0,0,9999"; }, "--home: \"0,0,9999\" lies too low or too high"},
      {[](auto& given) { given.faults = "loss=5"; }, "--faults: \"loss=5\" is not a share"},
      {[](auto& given) { given.refuse = {"FLY"}; }, "--refuse: \"FLY\" is not a command"},
      {[](auto& given) { given.fault_at = {"soon=reboot"}; }, "--fault-at: \"soon=reboot\" is not a time and a fault"},
      {[](auto& given) { given.control = "0.0.0.0:1"; }, "--control: \"0.0.0.0:1\" is no place for the control port"},
      {[](auto& given) {
         given.links = {"udpin://:65535"};
         given.count = 2;
       },
       "--count: there are not so many ports from 65535 on"},
      {[](auto& given) {
         given.links = {"serial:///dev/ttyS0"};
         given.count = 2;
       },
       "--count: a serial line has room for one vehicle"},
  };
  for (const auto& [change, part] : mistakes) {
    auto given = usual();
    change(given);
    const auto settings = read(given);
    ASSERT_FALSE(settings) << part;
    EXPECT_EQ(settings.error().find(part), 0U) << settings.error();
  }
}

TEST(vehicle_options, each_further_link_is_a_line_of_its_own_and_its_port_rises_as_well) {
  auto given = usual();
  given.links = {"udpin://127.0.0.1:14580", "tcpin://127.0.0.1:5760"};
  given.count = 2;
  const auto settings = read(given);
  ASSERT_TRUE(settings) << settings.error();
  const auto& second = settings->vehicles[1];
  EXPECT_EQ(second.where.text(), "udpin://127.0.0.1:14581");
  ASSERT_EQ(second.more_lines.size(), 1U);
  EXPECT_EQ(second.more_lines.front().text(), "tcpin://127.0.0.1:5761");
  given.links.assign(max_lines + 1, "udpout://127.0.0.1:14550");
  EXPECT_EQ(read(given).error(), "--link: a vehicle has 1 to 8 lines");
}

TEST(vehicle_options, system_ids_rise_and_begin_again_after_250) {
  EXPECT_EQ(system_of(1, 0), 1);
  EXPECT_EQ(system_of(249, 1), 250);
  EXPECT_EQ(system_of(249, 2), 1);
  EXPECT_EQ(system_of(1, 999), 250);
}

TEST(vehicle_options, listening_ports_rise_and_those_that_call_call_the_same_place) {
  const auto text_of_third = [](const char* first) {
    return link_of(io::link::parse_uri(first).value(), 2).value().text();
  };
  EXPECT_EQ(text_of_third("udpin://127.0.0.1:14580"), "udpin://127.0.0.1:14582");
  EXPECT_EQ(text_of_third("tcpin://:5760"), "tcpin://:5762");
  EXPECT_EQ(text_of_third("udpin://127.0.0.1:0"), "udpin://127.0.0.1:0");
  EXPECT_EQ(text_of_third("udpout://127.0.0.1:14550"), "udpout://127.0.0.1:14550");
  EXPECT_EQ(text_of_third("tcp://127.0.0.1:5760"), "tcp://127.0.0.1:5760");
}

TEST(vehicle_options, vehicles_start_some_metres_apart) {
  auto given = usual();
  given.count = 100;
  given.links = {"udpin://127.0.0.1:0"};
  const auto settings = read(given);
  ASSERT_TRUE(settings) << settings.error();
  for (std::size_t a = 0; a < settings->vehicles.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      ASSERT_GT(between(settings->vehicles[a].vehicle.home, settings->vehicles[b].vehicle.home).distance_m, 4.9);
  EXPECT_NE(settings->vehicles[0].vehicle.seed, settings->vehicles[1].vehicle.seed);
}

TEST(connection_hints, each_kind_of_link_tells_how_stations_reach_it) {
  const auto all_of = [](const char* uri) {
    std::string all;
    for (const auto& each : connection_hints(io::link::parse_uri(uri).value()))
      all += each + "\n";
    return all;
  };
  EXPECT_NE(all_of("udpout://127.0.0.1:14550").find("QGroundControl  connects by itself"), std::string::npos);
  EXPECT_NE(all_of("udpin://0.0.0.0:14540").find("--master=udpout:127.0.0.1:14540"), std::string::npos);
  EXPECT_NE(all_of("tcpin://127.0.0.1:5760").find("tcpout://127.0.0.1:5760"), std::string::npos);
  EXPECT_NE(all_of("tcp://127.0.0.1:5760").find("tcpin:0.0.0.0:5760"), std::string::npos);
  EXPECT_NE(all_of("serial:///dev/ttyS0:57600").find("57600 baud"), std::string::npos);
}

TEST(vehicle_options, what_is_no_number_is_refused) {
  auto given = usual();
  given.speed = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(read(given));
  given = usual();
  given.battery = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(read(given));
}

} // namespace vehicle_options_test
} // namespace godwit::sim
