// Whole hosts with real vehicles on real links over loopback.
#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "programs/godwit-sim/host/vehicle_host.hpp"
#include "tests/io/link/far_ends.hpp"
#include "tests/programs/godwit-sim/host/control_client.hpp"
#include "tests/programs/godwit-sim/host/station.hpp"

namespace godwit::sim {

namespace vehicle_host_test {

using io::link::testing::eventually;
namespace mavlink = io::mavlink;

constexpr std::uint16_t arm_disarm = 400;
constexpr std::uint16_t unheard_of = 31'999;

hosted_settings vehicle_at(const std::string& uri, std::uint8_t system = 1, const std::string& faults = "none") {
  hosted_settings result{.vehicle = {},
                         .where = io::link::parse_uri(uri).value(),
                         .more_lines = {},
                         .faults = parse_line_faults(faults).value(),
                         .refusals = {}};
  result.vehicle.system = system;
  return result;
}

mavlink::command_long to_vehicle(std::uint16_t command, std::uint8_t system = 1) {
  mavlink::command_long result;
  result.target_system = system;
  result.target_component = 1;
  result.command = command;
  return result;
}

struct vehicle_host_test : ::testing::Test {
  void open(host_settings settings) {
    auto opened = vehicle_host::open(std::move(settings), [this](std::string_view line) {
      const std::lock_guard lock(mutex);
      told.emplace_back(line);
    });
    ASSERT_TRUE(opened) << opened.error();
    host = *std::move(opened);
  }
  void open_one(const std::string& uri, const std::string& faults = "none") {
    host_settings settings;
    settings.vehicles = {vehicle_at(uri, 1, faults)};
    settings.control = parse_control_place("127.0.0.1:0").value();
    open(std::move(settings));
  }
  // The URI with which a station reaches the vehicle NUMBER that listens.
  [[nodiscard]] std::string way_to(std::size_t number = 0) const {
    const auto where = io::link::parse_uri(host->links()[number]).value();
    return (where.which == io::link::uri::kind::udp_in ? "udpout://127.0.0.1:" : "tcp://127.0.0.1:") +
           std::to_string(where.port);
  }
  [[nodiscard]] control_client control() const { return control_client(io::link::parse_uri(host->control())->port); }
  [[nodiscard]] bool was_told(const std::string& part) {
    return eventually([&] {
      const std::lock_guard lock(mutex);
      return std::any_of(told.begin(), told.end(),
                         [&](const std::string& each) { return each.find(part) != std::string::npos; });
    });
  }
  std::mutex mutex;
  std::vector<std::string> told;
  std::unique_ptr<vehicle_host> host;
};

// As an ArduPilot does it: godwit's line does not hear what a station on another one is answered.
TEST_F(vehicle_host_test, a_station_on_a_line_of_its_own_is_answered_there_alone) {
  host_settings settings;
  settings.vehicles = {vehicle_at("udpin://127.0.0.1:0")};
  settings.vehicles.front().vehicle.who = personality::ardupilot;
  settings.vehicles.front().more_lines = {io::link::parse_uri("tcpin://127.0.0.1:0").value()};
  open(std::move(settings));
  const auto more = host->more_links(0);
  ASSERT_EQ(more.size(), 1U);
  station first(way_to());
  station second("tcp://127.0.0.1:" + std::to_string(io::link::parse_uri(more.front()).value().port));
  EXPECT_TRUE(first.wait_for<mavlink::heartbeat>());
  EXPECT_TRUE(second.wait_for<mavlink::heartbeat>());
  EXPECT_EQ(second.command(to_vehicle(unheard_of)), static_cast<int>(mavlink::mav_result::unsupported));
  EXPECT_FALSE(first.has_heard<mavlink::command_ack>());
}

TEST_F(vehicle_host_test, a_station_over_udp_hears_the_vehicle_and_is_answered) {
  open_one("udpin://127.0.0.1:0");
  station gcs(way_to());
  EXPECT_TRUE(gcs.wait_for<mavlink::heartbeat>());
  EXPECT_EQ(gcs.command(to_vehicle(unheard_of)), static_cast<int>(mavlink::mav_result::unsupported));
  EXPECT_TRUE(was_told("hears 255/190"));
}

TEST_F(vehicle_host_test, several_stations_over_tcp_are_served_at_once) {
  open_one("tcpin://127.0.0.1:0");
  station first(way_to());
  station second(way_to());
  EXPECT_EQ(first.command(to_vehicle(unheard_of)), static_cast<int>(mavlink::mav_result::unsupported));
  EXPECT_EQ(second.command(to_vehicle(unheard_of)), static_cast<int>(mavlink::mav_result::unsupported));
  EXPECT_TRUE(first.wait_for<mavlink::heartbeat>());
}

TEST_F(vehicle_host_test, frames_that_tcp_has_torn_are_put_together) {
  open_one("tcpin://127.0.0.1:0");
  station gcs(way_to());
  ASSERT_TRUE(gcs.wait_for<mavlink::heartbeat>());
  const auto frame = mavlink::encode(to_vehicle(unheard_of), station::identity, 0);
  const auto bytes = frame.span();
  for (std::size_t n = 0; n < bytes.size(); ++n)
    gcs.send_bytes(bytes.subspan(n, 1));
  EXPECT_TRUE(gcs.wait_for<mavlink::command_ack>());
}

TEST_F(vehicle_host_test, a_vehicle_calls_a_station_that_listens) {
  for (const char* kind : {"udp", "tcp"}) {
    station gcs(std::string(kind) + "in://127.0.0.1:0");
    ASSERT_TRUE(eventually([&] { return io::link::testing::port_of(gcs.line()) != 0; }));
    const auto out = std::string(kind) == "udp" ? "udpout://127.0.0.1:" : "tcp://127.0.0.1:";
    host_settings settings;
    settings.vehicles = {vehicle_at(out + std::to_string(io::link::testing::port_of(gcs.line())))};
    open(std::move(settings));
    EXPECT_TRUE(gcs.wait_for<mavlink::heartbeat>()) << kind;
    EXPECT_TRUE(gcs.command(to_vehicle(unheard_of))) << kind;
    host.reset();
  }
}

TEST_F(vehicle_host_test, each_vehicle_has_its_own_link_and_identity) {
  host_settings settings;
  for (std::uint8_t system = 1; system <= 3; ++system)
    settings.vehicles.push_back(vehicle_at("udpin://127.0.0.1:0", system));
  open(std::move(settings));
  for (std::size_t number = 0; number < 3; ++number) {
    station gcs(way_to(number));
    ASSERT_TRUE(gcs.wait_for<mavlink::heartbeat>());
    EXPECT_EQ(gcs.system(), number + 1);
  }
}

TEST_F(vehicle_host_test, an_old_stations_heartbeat_of_mavlink_1_does_no_harm) {
  open_one("udpin://127.0.0.1:0");
  station gcs(way_to());
  const unsigned char old[] = {0xfe, 9, 0, 255, 190, 0, 0, 0, 0, 0, 6, 8, 0, 0, 3, 0xd4, 0x90};
  for (int n = 0; n < 10; ++n)
    gcs.send_bytes(std::as_bytes(std::span(old)));
  EXPECT_TRUE(gcs.wait_for<mavlink::heartbeat>());
  EXPECT_TRUE(gcs.command(to_vehicle(unheard_of)));
}

TEST_F(vehicle_host_test, a_port_that_is_taken_is_told_at_the_start) {
  const io::link::testing::tcp_end taken;
  for (const bool is_control : {false, true}) {
    host_settings settings;
    settings.vehicles = {
        vehicle_at(is_control ? "udpin://127.0.0.1:0" : "tcpin://127.0.0.1:" + std::to_string(taken.port()))};
    if (is_control)
      settings.control = parse_control_place("127.0.0.1:" + std::to_string(taken.port())).value();
    const auto opened = vehicle_host::open(std::move(settings), [](std::string_view) {});
    ASSERT_FALSE(opened);
    EXPECT_NE(opened.error().find("another program listens on this port"), std::string::npos) << opened.error();
  }
}

TEST_F(vehicle_host_test, a_line_that_loses_everything_is_silent_both_ways) {
  open_one("udpin://127.0.0.1:0", "loss=1");
  station gcs(way_to());
  gcs.send(mavlink::heartbeat{});
  auto steering = control();
  EXPECT_TRUE(eventually([&] {
    gcs.send(mavlink::heartbeat{});
    const auto line = steering.ask({{"do", "status"}})["vehicles"][0]["line"];
    return line["out"]["lost"] > 0 && line["in"]["lost"] > 0;
  }));
  EXPECT_EQ(gcs.frames(), 0U);
}

TEST_F(vehicle_host_test, damaged_frames_are_sent_and_not_taken) {
  open_one("udpin://127.0.0.1:0", "biterrors=0.2");
  station gcs(way_to());
  auto steering = control();
  EXPECT_TRUE(eventually([&] {
    gcs.send(to_vehicle(unheard_of));
    const auto now = steering.ask({{"do", "status"}})["vehicles"][0];
    return now["line"]["out"]["damaged"] > 3 && now["line"]["in"]["damaged"] > 3 && now["link"]["tx_bytes"] > 0;
  }));
  EXPECT_EQ(gcs.frames(), 0U);
}

TEST_F(vehicle_host_test, a_doubled_frame_is_heard_twice) {
  open_one("udpin://127.0.0.1:0", "out.dup=1");
  station gcs(way_to());
  EXPECT_TRUE(gcs.command(to_vehicle(unheard_of)));
  EXPECT_TRUE(gcs.wait_for<mavlink::command_ack>()) << "the second of the pair";
}

TEST_F(vehicle_host_test, a_delayed_answer_comes_later) {
  open_one("udpin://127.0.0.1:0", "delay=100ms");
  station gcs(way_to());
  const auto began = std::chrono::steady_clock::now();
  EXPECT_TRUE(gcs.command(to_vehicle(unheard_of)));
  EXPECT_GE(std::chrono::steady_clock::now() - began, std::chrono::milliseconds(200));
}

TEST_F(vehicle_host_test, the_control_port_cuts_the_line_and_restores_it) {
  open_one("udpin://127.0.0.1:0");
  station gcs(way_to());
  ASSERT_TRUE(gcs.wait_for<mavlink::heartbeat>());
  auto steering = control();
  EXPECT_EQ(steering.ask({{"do", "cut"}})["done"], "the line is cut");
  const auto frames = gcs.frames();
  EXPECT_TRUE(eventually([&] { return steering.ask({{"do", "status"}})["vehicles"][0]["line"]["out"]["cut"] >= 3; }));
  EXPECT_LE(gcs.frames(), frames + 3) << "what was in the sockets when it was cut may still come";
  EXPECT_EQ(steering.ask({{"do", "restore"}, {"vehicle", 1}})["ok"], true);
  static_cast<void>(gcs.wait_for<mavlink::heartbeat>()); // may be one from before
  EXPECT_TRUE(gcs.wait_for<mavlink::heartbeat>());
  EXPECT_TRUE(was_told("the line is restored"));
}

TEST_F(vehicle_host_test, the_control_port_drops_the_battery_takes_the_gps_and_refuses_commands) {
  open_one("udpin://127.0.0.1:0");
  auto steering = control();
  const auto now = [&] { return steering.ask({{"do", "status"}, {"vehicle", 1}})["vehicles"][0]; };
  EXPECT_EQ(steering.ask({{"do", "battery 20"}})["ok"], true);
  EXPECT_NEAR(now()["battery_percent"].get<double>(), 20, 1);
  EXPECT_EQ(steering.ask({{"do", "gps lost"}})["ok"], true);
  EXPECT_EQ(now()["has_position"], false);
  EXPECT_EQ(steering.ask({{"do", "gps back"}})["ok"], true);
  EXPECT_TRUE(eventually([&] { return now()["has_position"] == true; }));
  station gcs(way_to());
  EXPECT_EQ(steering.ask({{"do", "refuse COMPONENT_ARM_DISARM=77"}})["ok"], true);
  EXPECT_EQ(gcs.command(to_vehicle(arm_disarm)), 77);
  EXPECT_EQ(steering.ask({{"do", "accept COMPONENT_ARM_DISARM"}})["ok"], true);
  EXPECT_NE(gcs.command(to_vehicle(arm_disarm)), 77);
}

TEST_F(vehicle_host_test, the_control_port_reboots_the_autopilot) {
  open_one("udpin://127.0.0.1:0");
  auto steering = control();
  const auto world_ms = [&] { return steering.ask({{"do", "status"}})["vehicles"][0]["world_ms"].get<std::int64_t>(); };
  ASSERT_TRUE(eventually([&] { return world_ms() > 500; }));
  EXPECT_EQ(steering.ask({{"do", "reboot"}})["ok"], true);
  EXPECT_TRUE(eventually([&] { return world_ms() < 500; }));
}

TEST_F(vehicle_host_test, the_control_port_names_mistakes) {
  open_one("udpin://127.0.0.1:0");
  auto steering = control();
  const std::pair<nlohmann::json, const char*> mistakes[] = {
      {nlohmann::json::object(), "\"do\" is missing"},
      {{{"do", 5}}, "\"do\" is missing"},
      {{{"do", "explode"}}, "\"explode\" is not a fault; one of: faults"},
      {{{"do", "status"}, {"vehicle", 2}}, "\"vehicle\" is the number of a vehicle, from 1 to 1"},
      {{{"do", "status"}, {"vehicle", "1"}}, "\"vehicle\" is the number"},
      {{{"do", "status"}, {"first", 0}}, "\"first\" is the number"},
      {{{"do", "cut"}, {"secs", 5}}, "\"secs\" is no part of a request"},
  };
  for (const auto& [request, part] : mistakes) {
    const auto answer = steering.ask(request);
    EXPECT_EQ(answer["ok"], false) << request;
    EXPECT_NE(answer["error"].get<std::string>().find(part), std::string::npos) << answer;
  }
}

TEST_F(vehicle_host_test, the_control_port_speaks_of_one_vehicle_or_of_a_page_of_them) {
  host_settings settings;
  for (int n = 0; n < 120; ++n)
    settings.vehicles.push_back(vehicle_at("udpin://127.0.0.1:0"));
  settings.control = parse_control_place("127.0.0.1:0").value();
  settings.is_quiet = true;
  open(std::move(settings));
  auto steering = control();
  const auto first = steering.ask({{"do", "status"}});
  EXPECT_EQ(first["count"], 120);
  EXPECT_EQ(first["vehicles"].size(), 100U);
  const auto rest = steering.ask({{"do", "status"}, {"first", 101}});
  EXPECT_EQ(rest["vehicles"].size(), 20U);
  EXPECT_EQ(rest["vehicles"][0]["vehicle"], 101);
  EXPECT_EQ(steering.ask({{"do", "battery 30"}, {"vehicle", 7}})["ok"], true);
  EXPECT_NEAR(steering.ask({{"do", "status"}, {"vehicle", 7}})["vehicles"][0]["battery_percent"].get<double>(), 30, 1);
  EXPECT_NEAR(steering.ask({{"do", "status"}, {"vehicle", 8}})["vehicles"][0]["battery_percent"].get<double>(), 100, 1);
}

TEST_F(vehicle_host_test, quit_on_the_control_port_ends_the_waiting) {
  open_one("udpin://127.0.0.1:0");
  auto steering = control();
  EXPECT_EQ(steering.ask({{"do", "quit"}})["ok"], true);
  host->wait();
}

TEST_F(vehicle_host_test, a_fault_comes_by_itself_at_its_time) {
  host_settings settings;
  settings.vehicles = {vehicle_at("udpin://127.0.0.1:0")};
  settings.faults = {parse_timed_fault("300ms=battery 40").value(), parse_timed_fault("100ms=gps lost").value()};
  open(std::move(settings));
  EXPECT_TRUE(was_told("the battery is set to 40 %"));
  const std::lock_guard lock(mutex);
  const auto at = [&](const char* part) {
    return std::find_if(told.begin(), told.end(),
                        [&](const std::string& each) { return each.find(part) != std::string::npos; });
  };
  EXPECT_LT(at("the GPS is lost"), at("the battery is set"));
}

TEST_F(vehicle_host_test, what_goes_over_the_links_is_recorded) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "vehicle_host_test.tlog";
  std::filesystem::remove(file);
  host_settings settings;
  settings.vehicles = {vehicle_at("udpin://127.0.0.1:0")};
  settings.tlog = file;
  open(std::move(settings));
  station gcs(way_to());
  EXPECT_TRUE(gcs.command(to_vehicle(unheard_of)));
  host.reset();
  EXPECT_GT(std::filesystem::file_size(file), 100U);
  std::filesystem::remove(file);
}

TEST_F(vehicle_host_test, a_host_that_is_quiet_tells_nothing) {
  host_settings settings;
  settings.vehicles = {vehicle_at("udpin://127.0.0.1:0")};
  settings.is_quiet = true;
  open(std::move(settings));
  station gcs(way_to());
  EXPECT_TRUE(gcs.wait_for<mavlink::heartbeat>());
  const std::lock_guard lock(mutex);
  EXPECT_TRUE(told.empty());
}

TEST_F(vehicle_host_test, hosts_come_and_go_while_stations_talk) {
  for (int n = 0; n < 10; ++n) {
    open_one(n % 2 == 0 ? "udpin://127.0.0.1:0" : "tcpin://127.0.0.1:0");
    station gcs(way_to());
    for (int sent = 0; sent < 50; ++sent)
      gcs.send(to_vehicle(unheard_of));
    host.reset();
  }
}

} // namespace vehicle_host_test

namespace deadline_heap_test {

TEST(deadline_heap, at_first_nobody_is_due) {
  const deadline_heap heap(3);
  EXPECT_EQ(heap.first_deadline(), deadline_heap::never);
}

TEST(deadline_heap, a_deadline_moves_both_ways) {
  deadline_heap heap(3);
  heap.set(0, 10);
  heap.set(1, 20);
  EXPECT_EQ(heap.first(), 0U);
  heap.set(0, 30);
  EXPECT_EQ(heap.first(), 1U);
  heap.set(2, 5);
  EXPECT_EQ(heap.first(), 2U);
  heap.set(2, deadline_heap::never);
  EXPECT_EQ(heap.first_deadline(), 20);
}

RC_GTEST_PROP(deadline_heap_property, the_first_is_always_the_least, ()) {
  const auto members = *rc::gen::inRange<std::size_t>(1, 40);
  const auto moves = *rc::gen::container<std::vector<std::pair<std::size_t, int>>>(
      rc::gen::pair(rc::gen::inRange<std::size_t>(0, members), rc::gen::inRange(0, 100)));
  deadline_heap heap(members);
  std::vector<std::int64_t> deadlines(members, deadline_heap::never);
  for (const auto& move : moves) {
    heap.set(move.first, move.second);
    deadlines[move.first] = move.second;
    RC_ASSERT(heap.first_deadline() == *std::min_element(deadlines.begin(), deadlines.end()));
    RC_ASSERT(deadlines[heap.first()] == heap.first_deadline());
  }
}

} // namespace deadline_heap_test

} // namespace godwit::sim
