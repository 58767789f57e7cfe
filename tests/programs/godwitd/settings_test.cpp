#include "programs/godwitd/settings.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "actors/ground_port/settings.hpp"
#include "io/mavlink/messages/gimbal.hpp"
#include "programs/godwitd/configuration.hpp"

namespace godwitd_settings_test {

using namespace godwit;
using namespace godwit::daemon;

const std::string id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";

tl::expected<daemon_settings, std::string> settings(const given_texts& options) {
  return settings_from(effective_configuration(options, {}).value());
}

given_texts usual() {
  return {{"service", "https://example.org"}, {"mission-id", id}, {"vehicle", "udpin://127.0.0.1:14550"}};
}

// What stands first in the error of the usual options with these instead.
void expect_blames(const std::string& option, const given_texts& instead) {
  auto options = usual();
  for (const auto& [name, text] : instead)
    options[name] = text;
  const auto wrong = settings(options);
  ASSERT_FALSE(wrong) << option;
  EXPECT_TRUE(wrong.error().starts_with("--" + option + " (")) << wrong.error();
}

TEST(daemon_settings, files_lie_beside_the_journal) {
  auto options = usual();
  options["journal"] = "/var/lib/godwit/flight.db";
  const auto all = settings(options);
  ASSERT_TRUE(all) << all.error();
  EXPECT_EQ(all->map.store.file.path, "/var/lib/godwit/flight.map.db");
  EXPECT_EQ(all->control_path, "/var/lib/godwit/flight.control");
}

TEST(daemon_settings, what_is_wrong_is_blamed_on_its_option) {
  expect_blames("vehicle", {{"vehicle", ""}});
  expect_blames("vehicle", {{"vehicle", "serial:ttyUSB0"}});
  expect_blames("mission-id", {{"mission-id", ""}});
  expect_blames("mission-id", {{"mission-id", "survey 7"}});
  expect_blames("service", {{"service", ""}});
  expect_blames("service", {{"service", "htps://example.org"}});
  expect_blames("mission", {{"mission", "survey.plan"}});
}

TEST(daemon_settings, without_a_mission_the_next_ones_of_a_named_vehicle_are_asked_for) {
  const auto with = [](const given_texts& more) {
    auto options = usual();
    options.erase("mission-id");
    options["vehicle-id"] = "bird-1";
    options.insert(more.begin(), more.end());
    return settings(options);
  };
  const auto all = with({});
  ASSERT_TRUE(all) << all.error();
  EXPECT_TRUE(all->flight.asks_next());
  EXPECT_EQ(all->flight.vehicle_id, "bird-1");
  EXPECT_FALSE(settings(usual())->flight.asks_next());
  EXPECT_FALSE(with({{"mission-id", id}})->flight.asks_next()) << "one mission is named";
  EXPECT_FALSE(with({{"ground-run", "true"}}));
  EXPECT_FALSE(with({{"sightings", "-"}}));
  expect_blames("vehicle-id", {{"vehicle-id", "bird 1/2"}});
}

TEST(daemon_settings, a_token_does_not_go_to_another_computer_in_clear) {
  expect_blames("service", {{"service", "http://example.org"}, {"token-file", "token"}});
}

TEST(daemon_settings, the_links_are_recorded_within_the_bound_of_the_trace_unless_switched_off) {
  auto configuration = effective_configuration(usual(), {}).value();
  const auto on = settings_from(configuration);
  ASSERT_TRUE(on && on->link_log);
  EXPECT_EQ(on->link_log->folder, on->process.trace->folder);
  EXPECT_EQ(on->process.trace->total_bytes + 2 * on->link_log->total_bytes, std::uint64_t{256} << 20U);
  configuration["trace"]["links"] = false;
  const auto off = settings_from(configuration);
  ASSERT_TRUE(off);
  EXPECT_FALSE(off->link_log);
  EXPECT_EQ(off->process.trace->total_bytes, std::uint64_t{256} << 20U);
}

TEST(daemon_settings, a_mission_from_a_file_needs_no_service) {
  const auto all = settings({{"mission", "survey.plan"}, {"vehicle", "udpin://127.0.0.1:14550"}});
  ASSERT_TRUE(all) << all.error();
  EXPECT_FALSE(all->service);
  const auto wrong = settings({{"mission", "survey.gpx"}, {"vehicle", "udpin://127.0.0.1:14550"}});
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().find(".geojson"), std::string::npos);
}

TEST(daemon_settings, a_flight_begins_on_command_and_arms_nothing_unless_it_is_told_to) {
  const auto usually = settings(usual());
  ASSERT_TRUE(usually) << usually.error();
  EXPECT_TRUE(usually->flies);
  EXPECT_EQ(usually->flight.start, executor::start_policy::on_command);
  EXPECT_FALSE(usually->flight.arm_on_start);
  EXPECT_EQ(usually->flight.checks.battery_return_percent, usually->failsafe.battery_low_percent);
  expect_blames("start", {{"start", "automatic"}});
  auto both = usual();
  both["start"] = "automatic";
  both["arm-on-start"] = "true";
  EXPECT_TRUE(settings(both));
}

TEST(daemon_settings, the_link_has_its_own_time_outs_and_poses_as_a_ground_station_only_when_told_to) {
  auto configuration = effective_configuration(usual(), {}).value();
  const auto plain = settings_from(configuration).value().link;
  EXPECT_EQ(plain.command_timeout_ms, 1'000);
  EXPECT_EQ(plain.watch.lost_after_ms, 5'000);
  EXPECT_EQ(plain.as.system, 0) << "the vehicle's own";
  EXPECT_EQ(plain.as.component, 191);
  auto& vehicle = configuration["vehicle"];
  vehicle["command_timeout_ms"] = 2'500;
  vehicle["lost_after_ms"] = 8'000;
  vehicle["as_ground_station"] = true;
  const auto other = settings_from(configuration).value().link;
  EXPECT_EQ(other.command_timeout_ms, 2'500);
  EXPECT_EQ(other.watch.lost_after_ms, 8'000);
  EXPECT_EQ(other.as.system, 255);
  EXPECT_EQ(other.as.component, 190);
  EXPECT_EQ(other.as.type, 6);
}

TEST(daemon_settings, only_a_line_that_does_not_leave_the_vehicle_is_secure) {
  for (const auto* const secure : {"serial:///dev/ttyAMA0:921600", "udpin://127.0.0.1:14550", "tcp://localhost:5760"}) {
    auto configuration = effective_configuration(usual(), {}).value();
    configuration["vehicle"]["uri"] = secure;
    EXPECT_FALSE(settings_from(configuration).value().vehicle_line_is_secure);
    configuration["vehicle"]["secure"] = true;
    const auto settings = settings_from(configuration);
    ASSERT_TRUE(settings) << settings.error();
    EXPECT_TRUE(settings->vehicle_line_is_secure);
  }
  for (const auto* const open : {"udpin://0.0.0.0:14550", "tcp://192.168.1.2:5760"}) {
    auto configuration = effective_configuration(usual(), {}).value();
    configuration["vehicle"]["uri"] = open;
    configuration["vehicle"]["secure"] = true;
    const auto settings = settings_from(configuration);
    ASSERT_FALSE(settings);
    EXPECT_TRUE(settings.error().starts_with("vehicle.secure: ")) << settings.error();
  }
}

TEST(daemon_settings, what_follows_when_the_service_has_deleted_the_mission_is_a_setting) {
  auto configuration = effective_configuration(usual(), {}).value();
  EXPECT_EQ(settings_from(configuration).value().flight.deleted_mission, executor::deletion_policy::go_on);
  configuration["flight"]["deleted_mission"] = "return";
  configuration["failsafe"]["following_extra_ms"] = 1'000;
  configuration["failsafe"]["moving_mps"] = 0.5;
  const auto other = settings_from(configuration).value();
  EXPECT_EQ(other.flight.deleted_mission, executor::deletion_policy::come_home);
  EXPECT_EQ(other.failsafe.following_extra_ms, 1'000);
  EXPECT_EQ(other.failsafe.moving_mps, 0.5);
}

TEST(daemon_settings, points_of_interest_are_five_a_minute_in_surveys_and_nothing_is_said_to_be_gone) {
  const auto usually = settings(usual());
  ASSERT_TRUE(usually);
  EXPECT_EQ(usually->flight.scans, executor::scan_policy::with_survey);
  EXPECT_EQ(usually->scan.shown_a_minute, 5U);
  EXPECT_EQ(usually->scan.window_ms, 60'000);
  EXPECT_TRUE(usually->scan.looks_for.empty());
}

TEST(daemon_settings, what_is_looked_for_is_named_with_spaces_between) {
  auto configuration = effective_configuration(usual(), {}).value();
  configuration["scan"]["looks_for"] = " vehicle  person ";
  EXPECT_EQ(settings_from(configuration)->scan.looks_for, (std::vector<std::string>{"vehicle", "person"}));
  configuration["scan"]["looks_for"] = std::string(65, 'x');
  EXPECT_TRUE(settings_from(configuration).error().starts_with("scan.looks_for: "));
}

TEST(daemon_settings, once_is_a_run_on_the_ground) {
  auto options = usual();
  options["once"] = "true";
  EXPECT_FALSE(settings(options)->flies);
  options.erase("once");
  options["ground-run"] = "true";
  EXPECT_FALSE(settings(options)->flies);
}

TEST(daemon_settings, where_stations_bring_missions_nobody_else_has_to) {
  const auto all = settings({{"vehicle", "udpin://127.0.0.1:14550"}, {"ground", "udpin://127.0.0.1:14555"}});
  ASSERT_TRUE(all) << all.error();
  EXPECT_FALSE(all->service);
  EXPECT_FALSE(all->flight.has_service);
  EXPECT_TRUE(all->speaks_as_autopilot);
  const auto neither = settings({{"vehicle", "udpin://127.0.0.1:14550"}});
  ASSERT_FALSE(neither);
  EXPECT_NE(neither.error().find("--ground"), std::string::npos) << neither.error();
}

TEST(daemon_settings, the_line_for_ground_stations_is_a_link) {
  auto options = usual();
  options["ground"] = "udpin://127.0.0.1:14555";
  EXPECT_TRUE(settings(options)->ground);
  expect_blames("ground", {{"ground", "udp:14555"}});
}

TEST(daemon_settings, how_long_the_plans_of_stations_may_be_is_a_setting) {
  auto configuration = effective_configuration(usual(), {}).value();
  EXPECT_EQ(settings_from(configuration)->ground_max_items, ground_port::settings().max_items);
  configuration["ground"]["max_items"] = 5'000;
  EXPECT_EQ(settings_from(configuration)->ground_max_items, ground_port::max_plan_items);
}

TEST(daemon_settings, a_camera_with_parameters_that_are_missing_or_impossible_is_refused_with_the_place) {
  auto configuration = effective_configuration(usual(), {}).value();
  EXPECT_FALSE(settings_from(configuration)->camera) << "there is none";
  EXPECT_FALSE(settings_from(configuration)->scan.watches_view);
  configuration["camera"]["uri"] = "rtsp://127.0.0.1:8554/camera";
#ifdef GODWIT_HAS_EYES
  EXPECT_TRUE(settings_from(configuration).error().starts_with("camera.width_px is 0")) << "which is not known";
  configuration["camera"]["width_px"] = 640;
  configuration["camera"]["height_px"] = 360;
  EXPECT_TRUE(settings_from(configuration).error().starts_with("camera.focal_px is 0"));
  configuration["camera"]["focal_px"] = 550;
  const auto known = settings_from(configuration);
  ASSERT_TRUE(known) << known.error();
  EXPECT_EQ(known->camera->mount_pitch_deg, -90) << "it looks down";
  EXPECT_TRUE(known->scan.watches_view);
  const auto asks_for_gimbal = [&] {
    constexpr auto gimbal = io::mavlink::gimbal_device_attitude_status::message_id;
    const auto all = settings_from(configuration)->link.streams;
    return std::ranges::any_of(all, [](const auto& each) { return each.message == gimbal; });
  };
  EXPECT_FALSE(asks_for_gimbal());
  configuration["camera"]["on_gimbal"] = true;
  EXPECT_TRUE(asks_for_gimbal());
  configuration["camera"]["uri"] = "/dev/video0";
  EXPECT_TRUE(settings_from(configuration).error().starts_with("--camera (")) << settings_from(configuration).error();
#else
  EXPECT_NE(settings_from(configuration).error().find("was built without the detector"), std::string::npos);
#endif
}

TEST(daemon_settings, a_broker_needs_tls_or_this_computer_and_a_name_for_the_vehicle) {
  auto configuration = effective_configuration(usual(), {}).value();
  EXPECT_FALSE(settings_from(configuration)->fleet) << "there is none";
  auto& telemetry = configuration["telemetry"];
  telemetry["broker"] = "mqtts://fleet.example.org";
  EXPECT_TRUE(settings_from(configuration).error().starts_with("telemetry.vehicle is missing"));
  telemetry["vehicle"] = "rover/7";
  EXPECT_TRUE(settings_from(configuration).error().starts_with("telemetry.vehicle is \"rover/7\""));
  telemetry["vehicle"] = "rover-7";
  const auto known = settings_from(configuration);
  ASSERT_TRUE(known) << known.error();
  EXPECT_EQ(known->fleet->broker.port, 8883);
  telemetry["password_file"] = "/etc/godwit/password";
  EXPECT_TRUE(settings_from(configuration).error().starts_with("telemetry.password_file needs telemetry.username"));
  telemetry["username"] = "rover-7";
  telemetry["key_file"] = "/etc/godwit/key.pem";
  EXPECT_TRUE(settings_from(configuration).error().starts_with("telemetry.certificate_file and telemetry.key_file"));
  telemetry["key_file"] = "";
  telemetry["broker"] = "mqtt://fleet.example.org:1883";
  const auto in_clear = settings_from(configuration);
  ASSERT_FALSE(in_clear);
  EXPECT_TRUE(in_clear.error().starts_with("--broker (GODWIT_BROKER, telemetry.broker): ")) << in_clear.error();
  EXPECT_NE(in_clear.error().find("Name it mqtts://fleet.example.org:8883"), std::string::npos) << in_clear.error();
  telemetry["broker"] = "mqtt://127.0.0.1:1883";
  EXPECT_TRUE(settings_from(configuration)) << settings_from(configuration).error();
  configuration["flight"]["ground_run"] = true;
  EXPECT_FALSE(settings_from(configuration)) << "nothing is flown";
}

} // namespace godwitd_settings_test
