#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "tests/actors/vehicle_link/vehicle_frames.hpp"

namespace core_test {

using namespace godwit::vehicle_link;
using namespace godwit::vehicle_link::test;
namespace link = godwit::io::link;

// A core with a link that is up and a vehicle that was heard.
struct connected {
  explicit connected(const settings& configured = quiet(), const signing_settings& signing = {},
                     mavlink::mav_autopilot autopilot = mavlink::mav_autopilot::px4)
      : it(configured, signing, {}) {
    (void)it.on_link(link_up(), at(0));
    hello = vehicle.beat(it, 0, autopilot);
  }
  core it;
  vehicle_voice vehicle;
  effects hello;
};

send_command command(std::uint16_t id) {
  send_command result;
  result.command = id;
  return result;
}

mavlink::command_ack ack(std::uint16_t id, mavlink::mav_result result, mavlink::sender to = {}) {
  return {
      .command = id, .result = mavlink::number(result), .target_system = to.system, .target_component = to.component};
}

// -- heartbeat and identity ------------------------------------------------------------------------------------------

TEST(vehicle_link_core, a_heartbeat_goes_out_once_a_second_as_the_vehicles_own_companion) {
  connected c;
  std::size_t beats = 0;
  for (std::int64_t now = 0; now < 60 * s; now += 50 * ms) {
    if (now % s == 0)
      (void)c.vehicle.beat(c.it, now);
    for (const auto& each : sent_of<mavlink::heartbeat>(c.it.on_time(at(now)))) {
      ++beats;
      EXPECT_EQ(each.type, mavlink::number(mavlink::mav_type::onboard_controller));
      EXPECT_EQ(each.autopilot, mavlink::number(mavlink::mav_autopilot::invalid));
    }
  }
  EXPECT_EQ(beats, 60U);
}

TEST(vehicle_link_core, speaks_with_the_system_id_of_the_vehicle_it_is_on) {
  core it(quiet(), {}, {});
  vehicle_voice vehicle;
  (void)it.on_link(link_up(), at(0));
  (void)vehicle.say(it, mavlink::heartbeat{.type = 2, .autopilot = 12}, 0, {42, 1});
  const auto done = it.on_time(at(s));
  ASSERT_EQ(done.size(), 1U);
  EXPECT_EQ(std::get<transmission>(done[0]).frame.view().from(), (mavlink::sender{42, 191}));
}

TEST(vehicle_link_core, poses_as_a_ground_station_when_it_is_told_to) {
  auto configured = quiet();
  configured.as = ground_station_identity;
  connected c(configured);
  const auto done = c.it.on_time(at(s));
  ASSERT_EQ(done.size(), 1U);
  EXPECT_EQ(std::get<transmission>(done[0]).frame.view().from(), (mavlink::sender{255, 190}));
  const auto beats = sent_of<mavlink::heartbeat>(done);
  ASSERT_EQ(beats.size(), 1U);
  EXPECT_EQ(beats[0].type, mavlink::number(mavlink::mav_type::gcs));
}

TEST(vehicle_link_core, who_asks_is_told_ages_numbers_and_errors_by_kind) {
  connected c;
  EXPECT_EQ(c.it.describe(at(700 * ms)).last_heartbeat_age_ms, 700);
  const auto before = c.it.describe(at(s));
  (void)c.vehicle.beat(c.it, s);
  (void)c.vehicle.beat(c.it, 2 * s);
  auto damaged = mavlink::encode(mavlink::heartbeat{}, {1, 1}, 9);
  std::vector<std::byte> bytes(damaged.span().begin(), damaged.span().end());
  bytes.back() ^= std::byte{0xff};
  (void)c.it.on_bytes(link::only_peer, true, bytes, at(2 * s));
  (void)c.vehicle.beat(c.it, 2 * s); // a frame after it, so that the damaged one is not waited for
  const auto beats = sent_of<mavlink::heartbeat>(c.it.on_time(at(2 * s))).size();
  const auto now = c.it.describe(at(2 * s));
  EXPECT_EQ(now.last_heartbeat_age_ms, 0);
  EXPECT_EQ(now.rx_seq, static_cast<std::uint8_t>(before.rx_seq + 3));
  EXPECT_EQ(now.tx_seq, static_cast<std::uint8_t>(before.tx_seq + beats));
  EXPECT_FALSE(now.signing_enabled);
  EXPECT_EQ(now.parse_errors_total, 1U);
  ASSERT_EQ(now.kind_errors.size(), 1U);
  EXPECT_EQ(now.kind_errors[0].count, 1U);
}

TEST(vehicle_link_core, frames_under_the_vehicles_name_from_elsewhere_are_counted_and_no_losses) {
  connected c;
  const auto before = c.it.describe(at(0)).under_its_name;
  for (std::int64_t i = 1; i <= 200; ++i) {
    (void)c.vehicle.beat(c.it, i * 100 * ms);
    const auto forged = mavlink::encode(mavlink::battery_status{}, {1, 1}, static_cast<std::uint8_t>(77 * i));
    (void)c.it.on_bytes(9, true, forged.span(), at(i * 100 * ms));
    (void)c.it.on_time(at(i * 100 * ms));
  }
  const auto seen = c.it.describe(at(20 * s));
  EXPECT_EQ(seen.under_its_name - before, 200U);
  EXPECT_EQ(seen.sequence_gaps, 0U);
  EXPECT_EQ(c.it.health(at(20 * s)).how, godwit::runtime::health_colour::green);
}

TEST(vehicle_link_core, the_first_heartbeat_goes_out_as_soon_as_the_link_is_up) {
  core it(quiet(), {}, {});
  (void)it.on_time(at(s));
  (void)it.on_link(link_up(), at(s + 100 * ms));
  EXPECT_EQ(it.next_deadline_ns(), s + 100 * ms);
  EXPECT_EQ(sent_of<mavlink::heartbeat>(it.on_time(at(s + 100 * ms))).size(), 1U);
}

TEST(vehicle_link_core, heartbeats_go_on_while_the_link_is_down_because_one_may_find_the_peer_again) {
  core it(quiet(), {}, {});
  EXPECT_EQ(sent_of<mavlink::heartbeat>(it.on_time(at(s))).size(), 1U);
  EXPECT_EQ(it.describe(at(s)).phase, connection_phase::down);
}

TEST(vehicle_link_core, the_heartbeat_is_held_back_while_an_actor_that_decides_is_silent) {
  auto configured = quiet();
  configured.deciders = {"executor", "failsafe"};
  connected c(configured);
  c.it.on_child_alive({"executor"}, at(0));
  EXPECT_TRUE(sent_of<mavlink::heartbeat>(c.it.on_time(at(s))).empty());
  EXPECT_TRUE(c.it.describe(at(s)).heartbeat_held_back);
  EXPECT_EQ(c.it.health(at(s)).how, godwit::runtime::health_colour::yellow);
  c.it.on_child_alive({"executor"}, at(s));
  c.it.on_child_alive({"failsafe"}, at(s));
  EXPECT_EQ(sent_of<mavlink::heartbeat>(c.it.on_time(at(2 * s))).size(), 1U);
  EXPECT_EQ(sent_of<mavlink::heartbeat>(c.it.on_time(at(5 * s))).size(), 0U) << "both have hung since";
}

// -- the vehicle -----------------------------------------------------------------------------------------------------

// The systems that a command or a transfer was addressed to.
std::set<int> addressed(const effects& done) {
  std::set<int> result;
  for (const auto& each : sent_of<mavlink::command_long>(done))
    result.insert(each.target_system);
  for (const auto& each : sent_of<mavlink::command_int>(done))
    result.insert(each.target_system);
  for (const auto& each : sent_of<mavlink::set_mode>(done))
    result.insert(each.target_system);
  for (const auto& each : sent_of<mavlink::mission_count>(done))
    result.insert(each.target_system);
  for (const auto& each : sent_of<mavlink::mission_request_list>(done))
    result.insert(each.target_system);
  return result;
}

mavlink::heartbeat of_px4() {
  return {.type = mavlink::number(mavlink::mav_type::quadrotor),
          .autopilot = mavlink::number(mavlink::mav_autopilot::px4)};
}

TEST(vehicle_link_core, why_there_is_no_vehicle_names_who_is_heard_in_its_place) {
  core it(quiet(), {}, {});
  vehicle_voice other;
  (void)it.on_link(link_up(), at(0));
  const mavlink::heartbeat station{.type = mavlink::number(mavlink::mav_type::gcs),
                                   .autopilot = mavlink::number(mavlink::mav_autopilot::invalid)};
  std::vector<connection_changed> said;
  for (std::int64_t now = s; now <= 20 * s; now += s) {
    for (const auto& each : announced<connection_changed>(other.say(it, station, now, {255, 190})))
      said.push_back(each);
    (void)it.on_time(at(now));
  }
  const std::string heard =
      "no heartbeat of an autopilot yet; heard and not accepted: ground station 255/190 (20 heartbeats)";
  EXPECT_EQ(it.describe(at(20 * s)).reason, heard);
  EXPECT_EQ(it.health(at(20 * s)).reason, heard);
  ASSERT_EQ(said.size(), 1U) << "once, whatever the numbers";
  EXPECT_EQ(said[0].phase, connection_phase::silent);
  EXPECT_NE(said[0].reason.find("ground station 255/190 (5 heartbeats)"), std::string::npos) << said[0].reason;
  const auto done = it.on_command(7, command(400), at(20 * s));
  EXPECT_NE(resolved(done).at(0).outcome.reason.find(heard), std::string::npos);
  (void)other.beat(it, 21 * s);
  EXPECT_EQ(it.describe(at(21 * s)).reason, "");
}

TEST(vehicle_link_core, a_lost_vehicles_reason_counts_what_is_heard_since) {
  connected c;
  (void)c.vehicle.say(c.it, mavlink::heartbeat{.type = mavlink::number(mavlink::mav_type::gcs)}, s, {255, 190});
  (void)c.it.on_time(at(5 * s));
  ASSERT_EQ(c.it.describe(at(5 * s)).phase, connection_phase::lost);
  EXPECT_EQ(c.it.describe(at(5 * s)).reason.find("255/190"), std::string::npos);
  (void)c.vehicle.say(c.it, mavlink::radio_status{}, 6 * s, {51, 68});
  EXPECT_NE(c.it.health(at(6 * s)).reason.find("; heard and not accepted: sender 51/68 (1 frame, no heartbeat)"),
            std::string::npos);
}

TEST(vehicle_link_core, while_a_flight_is_open_nothing_is_sent_to_another_vehicle) {
  core it(settings{}, {}, {}, vehicle_name{1, 1});
  vehicle_voice other;
  (void)it.on_link(link_up(), at(0));
  std::set<int> all;
  const auto see = [&](const effects& done) { all.merge(addressed(done)); };
  for (std::int64_t now = 0; now < 60 * s; now += 250 * ms) {
    if (now % s == 0)
      see(other.say(it, of_px4(), now, {2, 1}));
    see(it.on_time(at(now)));
    see(it.on_command(now / ms + 1, command(400), at(now)));
    see(it.on_set_mode({209, 4}, at(now)));
    see(it.on_upload(now / ms + 2, upload_plan{}, at(now)));
    see(it.on_download(now / ms + 3, download_plan{}, at(now)));
  }
  EXPECT_EQ(all, std::set<int>{1}) << "it is called, and nobody else";
  const auto shown = it.describe(at(60 * s));
  EXPECT_FALSE(shown.connected);
  EXPECT_EQ(shown.system, 0);
  EXPECT_EQ(shown.kept, (vehicle_name{1, 1}));
  EXPECT_NE(shown.reason.find("system 2 is heard"), std::string::npos) << shown.reason;
  const auto health = it.health(at(60 * s));
  EXPECT_EQ(health.how, godwit::runtime::health_colour::red);
  EXPECT_NE(health.reason.find("system 1"), std::string::npos) << health.reason;
}

TEST(vehicle_link_core, who_was_let_go_at_once_gets_nothing_of_what_is_sent_to_the_vehicle_in_its_place) {
  core it(quiet(), {}, {});
  vehicle_voice vehicle;
  (void)it.on_link(link_up(), at(0));
  (void)vehicle.say(it, of_px4(), 0, {2, 1});
  (void)it.on_upload(1, upload_plan{mavlink::mav_mission_type::mission, {mavlink::mission_item_int{}}, {}}, at(0));
  (void)it.on_command(2, command(400), at(0));
  (void)it.on_time(at(6 * s)); // it was heard once
  const auto done = vehicle.say(it, of_px4(), 7 * s, {1, 1});
  EXPECT_EQ(it.describe(at(7 * s)).system, 1);
  EXPECT_EQ(resolved(done).size() + resolved(it.on_time(at(7 * s))).size(), 0U) << "the command had timed out before";
  const auto over =
      std::ranges::count_if(done, [](const effect& each) { return std::holds_alternative<resolved_transfer>(each); });
  EXPECT_EQ(over, 1) << "the transfer with the other one";
  auto all = addressed(
      it.on_upload(3, upload_plan{mavlink::mav_mission_type::mission, {mavlink::mission_item_int{}}, {}}, at(7 * s)));
  all.merge(addressed(it.on_command(4, command(300), at(7 * s))));
  for (std::int64_t now = 7 * s; now < 20 * s; now += 100 * ms)
    all.merge(addressed(it.on_time(at(now))));
  EXPECT_EQ(all, std::set<int>{1});
}

TEST(vehicle_link_core, the_vehicle_of_a_flight_is_kept_from_its_beginning_until_it_is_over) {
  connected c;
  EXPECT_FALSE(c.it.on_keep_vehicle({false}, at(0)).second) << "none was kept";
  const auto begun = c.it.on_keep_vehicle({true}, at(0)).second;
  ASSERT_TRUE(begun);
  EXPECT_EQ(begun->who, (vehicle_name{1, 1}));
  EXPECT_FALSE(c.it.on_keep_vehicle({true}, at(s)).second) << "as before";
  EXPECT_EQ(c.it.on_keep_vehicle({false}, at(2 * s)).second->who, std::nullopt);
}

// A script on the companion computer that has taken the autopilot's ids (pymavlink's source_system=1).
TEST(vehicle_link_core, a_heartbeat_that_is_no_autopilots_is_never_the_vehicles_whatever_its_ids) {
  connected c;
  const mavlink::heartbeat of_script{.type = mavlink::number(mavlink::mav_type::onboard_controller),
                                     .autopilot = mavlink::number(mavlink::mav_autopilot::invalid)};
  vehicle_voice script; // with a count of its own
  for (std::int64_t now = 0; now < 30 * s; now += s) {
    EXPECT_EQ(observed<mavlink::heartbeat>(c.vehicle.beat(c.it, now)).size(), 1U) << now;
    for (int i = 0; i < 20; ++i)
      EXPECT_TRUE(observed<mavlink::attitude>(c.vehicle.say(c.it, mavlink::attitude{}, now)).size() == 1);
    EXPECT_TRUE(script.say(c.it, of_script, now + 500 * ms).empty()) << "nobody hears it";
    (void)c.it.on_time(at(now + 600 * ms));
  }
  const auto shown = c.it.describe(at(30 * s));
  EXPECT_EQ(shown.other_programs, 30U);
  EXPECT_EQ(shown.late_heartbeats, 0U);
  const auto health = c.it.health(at(30 * s));
  EXPECT_EQ(health.how, godwit::runtime::health_colour::yellow);
  EXPECT_NE(health.reason.find("another program speaks as 1/1"), std::string::npos) << health.reason;
  for (std::int64_t now = 30 * s; now < 40 * s; now += s)
    (void)script.say(c.it, of_script, now);
  EXPECT_EQ(announced<connection_changed>(c.it.on_time(at(40 * s))).at(0).phase, connection_phase::lost)
      << "it does not keep the vehicle alive";
}

TEST(vehicle_link_core, two_vehicles_under_one_name_are_named_not_called_a_bad_radio_and_not_armed) {
  connected c;
  vehicle_voice twin;
  std::vector<line_findings> told;
  for (std::int64_t now = 0; now < 12 * s; now += 200 * ms) {
    const auto boot_ms = static_cast<std::uint32_t>(now / ms);
    const auto see = [&](const effects& done) {
      for (const auto& each : announced<line_findings>(done))
        told.push_back(each);
    };
    if (now % s == 0) {
      see(c.vehicle.beat(c.it, now));
      see(twin.beat(c.it, now));
    }
    see(c.vehicle.say(c.it, mavlink::global_position_int{.time_boot_ms = 900'000 + boot_ms}, now));
    for (int i = 0; i < 3; ++i)
      see(twin.say(c.it, mavlink::global_position_int{.time_boot_ms = 50'000 + boot_ms}, now));
    (void)c.it.on_time(at(now));
  }
  ASSERT_FALSE(told.empty());
  EXPECT_NE(told.back().twin.find("850 s apart"), std::string::npos) << told.back().twin;
  EXPECT_LE(told.size(), 2U) << "told at a change";
  const auto health = c.it.health(at(12 * s));
  EXPECT_EQ(health.how, godwit::runtime::health_colour::red);
  EXPECT_NE(health.reason.find("Two vehicles speak as 1/1"), std::string::npos) << health.reason;
  auto arm = command(400);
  arm.param1 = 1;
  const auto done = c.it.on_command(1, arm, at(12 * s));
  EXPECT_TRUE(sent_of<mavlink::command_long>(done).empty());
  EXPECT_EQ(resolved(done).at(0).outcome.verdict, command_verdict::invalid);
  arm.param1 = 0;
  EXPECT_EQ(sent_of<mavlink::command_long>(c.it.on_command(2, arm, at(12 * s))).size(), 1U)
      << "disarming is not kept back";
}

TEST(vehicle_link_core, another_autopilot_on_the_line_is_told_to_listeners_and_that_it_is_gone) {
  connected c;
  const auto told = announced<line_findings>(c.vehicle.say(c.it, of_px4(), s, {2, 1}));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].vehicle, (vehicle_name{1, 1}));
  EXPECT_EQ(told[0].others, std::vector{(vehicle_name{2, 1})});
  EXPECT_FALSE(told[0].is_chosen);
  EXPECT_TRUE(announced<line_findings>(c.vehicle.say(c.it, of_px4(), 2 * s, {2, 1})).empty()) << "told once";
  (void)c.vehicle.beat(c.it, 11 * s);
  const auto gone = announced<line_findings>(c.it.on_time(at(13 * s)));
  ASSERT_EQ(gone.size(), 1U);
  EXPECT_TRUE(gone[0].others.empty());
}

TEST(vehicle_link_core, tells_of_each_change_of_the_connection_once) {
  connected c;
  EXPECT_EQ(announced<connection_changed>(c.hello).size(), 1U);
  EXPECT_TRUE(announced<connection_changed>(c.vehicle.beat(c.it, s)).empty());
  const auto lost = announced<connection_changed>(c.it.on_time(at(6 * s)));
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost[0].phase, connection_phase::lost);
  EXPECT_EQ(c.it.health(at(6 * s)).how, godwit::runtime::health_colour::red);
  EXPECT_EQ(announced<connection_changed>(c.vehicle.beat(c.it, 7 * s)).size(), 1U);
  EXPECT_EQ(c.it.health(at(7 * s)).how, godwit::runtime::health_colour::green);
}

TEST(vehicle_link_core, an_autopilot_that_restarts_while_it_is_lost_does_not_keep_the_link_busy) {
  core it({}, {}, {});
  vehicle_voice vehicle;
  (void)it.on_link(link_up(), at(0));
  (void)vehicle.beat(it, 0);
  (void)vehicle.say(it, mavlink::attitude{.time_boot_ms = 60'000}, 0);
  for (auto now = it.next_deadline_ns(); now < 10 * s; now = it.next_deadline_ns())
    (void)it.on_time(at(now));
  ASSERT_EQ(it.describe(at(10 * s)).phase, connection_phase::lost);
  // Its telemetry is back before its heartbeat, and says that it has restarted.
  (void)vehicle.say(it, mavlink::attitude{.time_boot_ms = 500}, 10 * s);
  (void)vehicle.say(it, mavlink::attitude{.time_boot_ms = 1'000}, 10 * s + s / 2);
  ASSERT_EQ(announced<vehicle_restarted>(vehicle.say(it, mavlink::attitude{.time_boot_ms = 1'500}, 11 * s)).size(), 1U);
  int wakes = 0;
  for (auto now = 11 * s; now < 21 * s && wakes < 1'000; now = it.next_deadline_ns(), ++wakes)
    (void)it.on_time(at(now));
  EXPECT_LE(wakes, 12) << "to beat once a second is all that there is to do";
}

// Its mode would be taken for somebody's.
TEST(vehicle_link_core, a_heartbeat_that_comes_late_or_twice_is_dropped_and_counted) {
  connected c;
  const mavlink::heartbeat beat{.type = mavlink::number(mavlink::mav_type::quadrotor),
                                .autopilot = mavlink::number(mavlink::mav_autopilot::px4)};
  const auto hears = [&](std::uint8_t sequence, std::int64_t now_ns) {
    const auto frame = mavlink::encode(beat, {1, 1}, sequence);
    return observed<mavlink::heartbeat>(c.it.on_bytes(godwit::io::link::only_peer, true, frame.span(), at(now_ns)))
        .size();
  };
  EXPECT_EQ(hears(100, s), 1U);
  EXPECT_EQ(hears(150, 2 * s), 1U);
  EXPECT_EQ(hears(149, 2 * s + ms), 0U) << "late";
  EXPECT_EQ(hears(150, 2 * s + 2 * ms), 0U) << "twice";
  EXPECT_EQ(hears(151, 3 * s), 1U);
  EXPECT_EQ(c.it.describe(at(3 * s)).late_heartbeats, 2U);
}

// Of the two that tell a mode the later one says where the vehicle is.
TEST(vehicle_link_core, a_current_mode_that_was_sent_before_a_heartbeat_that_has_come_is_dropped) {
  connected c;
  const mavlink::heartbeat beat{.type = mavlink::number(mavlink::mav_type::quadrotor),
                                .autopilot = mavlink::number(mavlink::mav_autopilot::px4)};
  const auto hears = [&](const auto& message, std::uint8_t sequence, std::int64_t now_ns) {
    const auto frame = mavlink::encode(message, {1, 1}, sequence);
    const auto done = c.it.on_bytes(godwit::io::link::only_peer, true, frame.span(), at(now_ns));
    return observed<std::decay_t<decltype(message)>>(done).size();
  };
  EXPECT_EQ(hears(beat, 100, s), 1U);
  EXPECT_EQ(hears(mavlink::current_mode{}, 99, s + ms), 0U);
  EXPECT_EQ(hears(mavlink::current_mode{}, 102, s + 2 * ms), 1U);
  EXPECT_EQ(hears(beat, 101, s + 3 * ms), 0U) << "and the other way round";
}

TEST(vehicle_link_core, what_is_not_on_the_list_is_counted_and_goes_no_further) {
  connected c;
  EXPECT_TRUE(c.vehicle.say(c.it, mavlink::param_value{}, 0).empty());
  EXPECT_TRUE(c.vehicle.say(c.it, mavlink::command_long{.target_system = 1, .command = 2003}, 0).empty());
  EXPECT_EQ(c.it.describe(at(0)).not_accepted, 2U);
}

TEST(vehicle_link_core, what_another_component_or_system_says_goes_no_further) {
  connected c;
  EXPECT_TRUE(c.vehicle.say(c.it, mavlink::attitude{}, 0, {1, 154}).empty());
  EXPECT_TRUE(c.vehicle.say(c.it, mavlink::attitude{}, 0, {2, 1}).empty());
  EXPECT_EQ(observed<mavlink::attitude>(c.vehicle.say(c.it, mavlink::attitude{}, 0)).size(), 1U);
}

TEST(vehicle_link_core, a_gimbal_of_the_vehicle_speaks_for_itself_and_one_of_another_system_does_not) {
  using mavlink::gimbal_device_attitude_status;
  connected c;
  EXPECT_EQ(
      observed<gimbal_device_attitude_status>(c.vehicle.say(c.it, gimbal_device_attitude_status{}, 0, {1, 154})).size(),
      1U);
  EXPECT_TRUE(c.vehicle.say(c.it, gimbal_device_attitude_status{}, 0, {2, 154}).empty());
}

TEST(vehicle_link_core, other_aircraft_are_heard_of_from_the_autopilot_and_a_receiver_of_the_vehicle_alone) {
  using mavlink::adsb_vehicle;
  connected c;
  EXPECT_EQ(observed<adsb_vehicle>(c.vehicle.say(c.it, adsb_vehicle{}, 0)).size(), 1U);
  EXPECT_EQ(observed<adsb_vehicle>(c.vehicle.say(c.it, adsb_vehicle{}, 0, {1, 156})).size(), 1U);
  EXPECT_TRUE(c.vehicle.say(c.it, adsb_vehicle{}, 0, {2, 156}).empty());
  EXPECT_EQ(observed<mavlink::collision>(c.vehicle.say(c.it, mavlink::collision{}, 0)).size(), 1U);
  EXPECT_TRUE(c.vehicle.say(c.it, mavlink::collision{}, 0, {1, 156}).empty()) << "it is the autopilot's judgement";
}

TEST(vehicle_link_core, an_ardupilot_is_asked_for_the_aircraft_that_it_hears_and_their_absence_is_no_fault) {
  const auto asks = [](mavlink::mav_autopilot who) {
    settings configured;
    std::erase_if(configured.streams,
                  [](const auto& each) { return each.message != mavlink::adsb_vehicle::message_id; });
    connected c(configured, {}, who);
    for (std::int64_t now = s; now < 30 * s; now += s) {
      (void)c.vehicle.beat(c.it, now, who);
      (void)c.vehicle.say(c.it, ack(511, mavlink::mav_result::accepted), now);
      (void)c.it.on_time(at(now));
    }
    EXPECT_TRUE(c.it.describe(at(30 * s)).missing_streams.empty());
    return !sent_of<mavlink::command_long>(c.hello).empty();
  };
  EXPECT_TRUE(asks(mavlink::mav_autopilot::ardupilotmega));
  EXPECT_FALSE(asks(mavlink::mav_autopilot::px4)) << "it sends them by itself";
}

TEST(vehicle_link_core, the_clock_of_a_gimbal_tells_of_no_start_of_the_autopilot) {
  connected c;
  (void)c.vehicle.say(c.it, mavlink::attitude{.time_boot_ms = 600'000}, 0);
  const auto said = c.vehicle.say(c.it, mavlink::gimbal_device_attitude_status{.time_boot_ms = 10}, s, {1, 154});
  EXPECT_EQ(said.size(), 1U) << "the message itself";
}

TEST(vehicle_link_core, each_message_on_the_list_is_told_as_it_came) {
  connected c;
  told_messages::for_each(
      [&]<class M>() { EXPECT_EQ(observed<M>(c.vehicle.say(c.it, M{}, 0)).size(), 1U) << godwit::io::type_name<M>(); });
}

TEST(vehicle_link_core, the_word_of_a_radio_is_taken_from_any_sender) {
  connected c;
  EXPECT_EQ(observed<mavlink::radio_status>(c.vehicle.say(c.it, mavlink::radio_status{}, 0, {51, 68})).size(), 1U);
}

TEST(vehicle_link_core, timesync_and_ping_are_answered_to_who_asked) {
  connected c;
  const auto sync = sent_of<mavlink::timesync>(c.vehicle.say(c.it, mavlink::timesync{.ts1 = 77}, 5 * ms));
  ASSERT_EQ(sync.size(), 1U);
  EXPECT_EQ(sync[0].ts1, 77);
  EXPECT_EQ(sync[0].tc1, 5 * ms);
  EXPECT_TRUE(c.vehicle.say(c.it, mavlink::timesync{.tc1 = 5, .ts1 = 77}, 0).empty()) << "an answer is not answered";
  const auto pong = sent_of<mavlink::ping>(c.vehicle.say(c.it, mavlink::ping{.time_usec = 9, .seq = 4}, 0));
  ASSERT_EQ(pong.size(), 1U);
  EXPECT_EQ(pong[0].seq, 4U);
  EXPECT_EQ(pong[0].target_system, 1);
  EXPECT_TRUE(sent_of<mavlink::ping>(c.vehicle.say(c.it, mavlink::ping{.target_system = 1, .target_component = 191}, 0))
                  .empty());
}

// Seen on ArduCopter 4.7-dev and PX4 1.17: the first frame of a restart in flight is a heartbeat of another mode, which
// was taken for a pilot's.
TEST(vehicle_link_core, a_heartbeat_of_a_boot_tells_the_restart_before_its_mode_and_once) {
  for (const auto boot : {mavlink::mav_state::boot, mavlink::mav_state::uninit}) {
    connected c;
    const auto hears = [&](mavlink::mav_state state, std::uint32_t mode, std::int64_t now_ns) {
      mavlink::heartbeat beat;
      beat.custom_mode = mode;
      beat.type = mavlink::number(mavlink::mav_type::quadrotor);
      beat.autopilot = mavlink::number(mavlink::mav_autopilot::px4);
      beat.system_status = mavlink::number(state);
      return c.vehicle.say(c.it, beat, now_ns);
    };
    EXPECT_TRUE(announced<vehicle_restarted>(hears(boot, 0, s)).empty()) << "nobody knows what was before";
    EXPECT_TRUE(announced<vehicle_restarted>(hears(mavlink::mav_state::active, 3, 2 * s)).empty());
    (void)c.vehicle.say(c.it, mavlink::attitude{.time_boot_ms = 90'000}, 2 * s);
    const auto done = hears(boot, 0, 4 * s);
    ASSERT_EQ(announced<vehicle_restarted>(done).size(), 1U);
    const auto is_mode = [](const effect& each) { return std::holds_alternative<observation>(each); };
    EXPECT_FALSE(is_mode(done.front())) << "the mode comes after it";
    EXPECT_EQ(observed<mavlink::heartbeat>(done).size(), 1U);
    int told = 0;
    for (int second = 5; second < 15; ++second) {
      told += static_cast<int>(
          announced<vehicle_restarted>(hears(second < 7 ? boot : mavlink::mav_state::standby, 0, second * s)).size());
      const auto boot_ms = static_cast<std::uint32_t>(second - 4) * 1'000;
      told += static_cast<int>(
          announced<vehicle_restarted>(c.vehicle.say(c.it, mavlink::attitude{.time_boot_ms = boot_ms}, second * s))
              .size());
    }
    EXPECT_EQ(told, 0) << "its new clock tells nothing new";
  }
}

TEST(vehicle_link_core, a_restart_of_the_autopilot_is_told_ends_commands_and_asks_for_streams_again) {
  auto configured = quiet();
  configured.streams = {{mavlink::attitude::message_id, 200}};
  connected c(configured);
  EXPECT_EQ(sent_of<mavlink::command_long>(c.hello).size(), 1U);
  (void)c.vehicle.say(c.it, ack(511, mavlink::mav_result::accepted), 0);
  (void)c.vehicle.say(c.it, mavlink::system_time{.time_boot_ms = 90'000}, 0);
  (void)c.it.on_command(9, command(400), at(0));
  (void)c.vehicle.say(c.it, mavlink::attitude{.time_boot_ms = 1'000}, 0);
  (void)c.vehicle.say(c.it, mavlink::attitude{.time_boot_ms = 1'500}, s / 2);
  const auto done = c.vehicle.say(c.it, mavlink::attitude{.time_boot_ms = 2'000}, s);
  EXPECT_EQ(announced<vehicle_restarted>(done).size(), 1U);
  ASSERT_EQ(resolved(done).size(), 1U);
  EXPECT_EQ(resolved(done)[0].outcome.verdict, command_verdict::vehicle_restarted);
  EXPECT_EQ(sent_of<mavlink::command_long>(done).size(), 1U) << "the stream";
}

// -- commands --------------------------------------------------------------------------------------------------------

TEST(vehicle_link_core, a_command_goes_to_the_autopilot_and_its_ack_to_whoever_asked) {
  connected c;
  auto what = command(400);
  what.param1 = 1;
  what.confirmation = 2;
  const auto out = sent_of<mavlink::command_long>(c.it.on_command(9, what, at(0)));
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(out[0].target_system, 1);
  EXPECT_EQ(out[0].target_component, 1);
  EXPECT_EQ(out[0].param1, 1.0F);
  EXPECT_EQ(out[0].confirmation, 2);
  const auto done = resolved(c.vehicle.say(c.it, ack(400, mavlink::mav_result::accepted, {1, 191}), 3 * ms));
  ASSERT_EQ(done.size(), 1U);
  EXPECT_EQ(done[0].asked_by.request_id, 9U);
  EXPECT_EQ(done[0].outcome.verdict, command_verdict::accepted);
}

// What a person has done since is in the newest heartbeat here, and not yet with who decided.
TEST(vehicle_link_core, a_command_that_was_decided_in_another_mode_is_not_sent) {
  connected c;
  const auto beat = [&](std::uint32_t mode, bool is_armed, std::int64_t now) {
    const auto flag = is_armed ? mavlink::number(mavlink::mav_mode_flag::safety_armed) : std::uint8_t{0};
    (void)c.vehicle.say(c.it, mavlink::heartbeat{.type = 2, .autopilot = 12, .base_mode = flag, .custom_mode = mode},
                        now);
  };
  auto decided = command(300);
  decided.only_while = seen_state{7, true};
  beat(7, true, s);
  EXPECT_EQ(sent_of<mavlink::command_long>(c.it.on_command(1, decided, at(s))).size(), 1U);
  (void)c.it.on_time(at(10 * s));
  for (const auto& [mode, is_armed] : {std::pair{8U, true}, std::pair{7U, false}}) {
    beat(mode, is_armed, 11 * s);
    const auto done = c.it.on_command(2, decided, at(11 * s));
    EXPECT_TRUE(sent_of<mavlink::command_long>(done).empty());
    ASSERT_EQ(done.size(), 1U);
    EXPECT_EQ(std::get<resolved_command>(done[0]).outcome.verdict, command_verdict::outdated);
  }
}

// In the second before a heartbeat shows what the failsafe has done.
TEST(vehicle_link_core, an_order_decided_without_knowing_of_the_failsafes_command_is_not_sent) {
  connected c;
  const auto flag = mavlink::number(mavlink::mav_mode_flag::safety_armed);
  (void)c.vehicle.say(c.it, mavlink::heartbeat{.type = 2, .autopilot = 12, .base_mode = flag, .custom_mode = 7}, s);
  auto resume = command(300);
  resume.only_while = seen_state{7, true, 2};
  auto by_failsafe = command(176);
  by_failsafe.only_while = seen_state{7, true, 3};
  EXPECT_EQ(sent_of<mavlink::command_long>(c.it.on_command(1, by_failsafe, at(s))).size(), 1U);
  const auto done = c.it.on_command(2, resume, at(s));
  EXPECT_TRUE(sent_of<mavlink::command_long>(done).empty());
  ASSERT_EQ(done.size(), 1U);
  const auto& outcome = std::get<resolved_command>(done[0]).outcome;
  EXPECT_EQ(outcome.verdict, command_verdict::outdated);
  EXPECT_EQ(outcome.reason, "the failsafe has commanded the vehicle since");
  EXPECT_TRUE(sent_of<mavlink::set_mode>(c.it.on_set_mode({1, 9, seen_state{7, true, 2}}, at(s))).empty());
  EXPECT_EQ(c.it.describe(at(s)).orders_kept_back, 2U);
  resume.only_while->failsafe_command = 3;
  EXPECT_EQ(sent_of<mavlink::command_long>(c.it.on_command(3, resume, at(s))).size(), 1U) << "it knows of it";
}

TEST(vehicle_link_core, a_count_of_the_failsafe_that_was_lost_keeps_nobody_out_for_good) {
  connected c;
  const auto flag = mavlink::number(mavlink::mav_mode_flag::safety_armed);
  (void)c.vehicle.say(c.it, mavlink::heartbeat{.type = 2, .autopilot = 12, .base_mode = flag, .custom_mode = 7}, s);
  EXPECT_EQ(sent_of<mavlink::set_mode>(c.it.on_set_mode({1, 9, seen_state{7, true, 5}}, at(s))).size(), 1U);
  EXPECT_TRUE(sent_of<mavlink::set_mode>(c.it.on_set_mode({1, 9, seen_state{7, true, 1}}, at(5 * s))).empty());
  EXPECT_EQ(sent_of<mavlink::set_mode>(c.it.on_set_mode({1, 9, seen_state{7, true, 1}}, at(6 * s))).size(), 1U);
}

TEST(vehicle_link_core, nothing_that_was_decided_in_another_mode_is_sent) {
  connected c;
  const seen_state decided{7, true};
  const auto flag = mavlink::number(mavlink::mav_mode_flag::safety_armed);
  (void)c.vehicle.say(c.it, mavlink::heartbeat{.type = 2, .autopilot = 12, .base_mode = flag, .custom_mode = 8}, s);
  EXPECT_TRUE(sent_of<mavlink::set_mode>(c.it.on_set_mode({1, 9, decided}, at(s))).empty());
  EXPECT_EQ(sent_of<mavlink::set_mode>(c.it.on_set_mode({1, 9, seen_state{8, true}}, at(s))).size(), 1U);
  const auto current = c.it.on_set_current(3, {2, decided}, at(s));
  ASSERT_EQ(current.size(), 1U);
  EXPECT_EQ(std::get<resolved_command>(current[0]).outcome.verdict, command_verdict::outdated);
  EXPECT_EQ(c.it.on_set_current(4, {2, seen_state{8, true}}, at(s)).size(), 1U) << "it is not busy";
  const auto upload = c.it.on_upload(5, {mavlink::mav_mission_type::mission, {{}}, decided}, at(s));
  ASSERT_EQ(upload.size(), 1U);
  const auto& outcome = std::get<resolved_transfer>(upload[0]).outcome;
  EXPECT_EQ(outcome.verdict, transfer::verdict::not_begun);
  EXPECT_EQ(outcome.holding, transfer::holding::unchanged);
}

TEST(vehicle_link_core, a_mode_that_current_mode_has_told_outdates_what_was_decided_before) {
  connected c;
  const auto flag = mavlink::number(mavlink::mav_mode_flag::safety_armed);
  (void)c.vehicle.say(c.it, mavlink::heartbeat{.type = 2, .autopilot = 12, .base_mode = flag, .custom_mode = 7}, s);
  (void)c.vehicle.say(c.it, mavlink::current_mode{.custom_mode = 8, .intended_custom_mode = 8}, s + 500 * ms);
  EXPECT_TRUE(sent_of<mavlink::set_mode>(c.it.on_set_mode({1, 9, seen_state{7, true}}, at(2 * s))).empty());
  EXPECT_EQ(sent_of<mavlink::set_mode>(c.it.on_set_mode({1, 9, seen_state{8, true}}, at(2 * s))).size(), 1U);
}

TEST(vehicle_link_core, current_mode_is_asked_of_a_px4_alone_and_not_missed) {
  const auto asked_for = [](mavlink::mav_autopilot autopilot) {
    core it({}, {}, {});
    vehicle_voice vehicle;
    (void)it.on_link(link_up(), at(0));
    auto done = vehicle.beat(it, 0, autopilot);
    std::vector<float> ids;
    for (std::int64_t now = ms; now < 30 * s; now += 100 * ms) {
      for (const auto& each : sent_of<mavlink::command_long>(done))
        if (each.command == 511)
          ids.push_back(each.param1);
      done = ids.empty() ? effects() : vehicle.say(it, ack(511, mavlink::mav_result::denied), now);
      for (auto& each : it.on_time(at(now)))
        done.push_back(std::move(each));
      for (auto& each : vehicle.beat(it, now, autopilot))
        done.push_back(std::move(each));
    }
    const auto missing = it.describe(at(30 * s)).missing_streams;
    EXPECT_EQ(std::ranges::count(missing, "CURRENT_MODE"), 0);
    return std::ranges::count(ids, static_cast<float>(mavlink::current_mode::message_id));
  };
  EXPECT_EQ(asked_for(mavlink::mav_autopilot::px4), stream_tries);
  EXPECT_EQ(asked_for(mavlink::mav_autopilot::ardupilotmega), 0);
}

TEST(vehicle_link_core, a_position_travels_in_integers) {
  connected c;
  auto what = command(192);
  what.form = command_form::in_integers;
  what.x = 473'977'418;
  what.y = 85'455'938;
  what.z = 30;
  what.frame = 6;
  const auto out = sent_of<mavlink::command_int>(c.it.on_command(9, what, at(0)));
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(out[0].x, 473'977'418);
  EXPECT_EQ(out[0].frame, 6);
}

TEST(vehicle_link_core, an_ack_for_another_station_is_not_ours_and_one_without_a_target_is) {
  connected c;
  (void)c.it.on_command(9, command(400), at(0));
  EXPECT_TRUE(resolved(c.vehicle.say(c.it, ack(400, mavlink::mav_result::denied, {255, 190}), 0)).empty());
  EXPECT_TRUE(resolved(c.vehicle.say(c.it, ack(400, mavlink::mav_result::denied, {1, 190}), 0)).empty());
  EXPECT_EQ(resolved(c.vehicle.say(c.it, ack(400, mavlink::mav_result::accepted), 0)).size(), 1U);
}

TEST(vehicle_link_core, without_an_answer_the_asker_hears_of_it_at_the_deadline) {
  connected c;
  (void)c.it.on_command(9, command(400), at(0));
  EXPECT_LE(c.it.next_deadline_ns(), 1 * s);
  EXPECT_TRUE(resolved(c.it.on_time(at(s - 1))).empty());
  const auto done = resolved(c.it.on_time(at(s)));
  ASSERT_EQ(done.size(), 1U);
  EXPECT_EQ(done[0].outcome.verdict, command_verdict::timed_out);
}

TEST(vehicle_link_core, a_command_that_can_not_be_sent_is_answered_at_once_with_the_reason) {
  core it(quiet(), {}, {});
  auto done = resolved(it.on_command(9, command(400), at(0)));
  ASSERT_EQ(done.size(), 1U);
  EXPECT_EQ(done[0].outcome.verdict, command_verdict::not_sent);
  (void)it.on_link(link_up(), at(0));
  done = resolved(it.on_command(9, command(400), at(0)));
  EXPECT_NE(done.at(0).outcome.reason.find("no vehicle"), std::string::npos);
}

TEST(vehicle_link_core, a_lost_link_is_still_tried) {
  connected c;
  (void)c.it.on_time(at(10 * s));
  EXPECT_EQ(sent_of<mavlink::command_long>(c.it.on_command(9, command(20), at(10 * s))).size(), 1U);
}

TEST(vehicle_link_core, nan_never_reaches_ardupilot) {
  auto what = command(300);
  what.param1 = std::numeric_limits<float>::quiet_NaN();
  connected ardupilot(quiet(), {}, mavlink::mav_autopilot::ardupilotmega);
  const auto done = ardupilot.it.on_command(9, what, at(0));
  EXPECT_TRUE(sent_of<mavlink::command_long>(done).empty());
  EXPECT_EQ(resolved(done).at(0).outcome.verdict, command_verdict::invalid);
  connected px4;
  EXPECT_EQ(sent_of<mavlink::command_long>(px4.it.on_command(9, what, at(0))).size(), 1U);
}

TEST(vehicle_link_core, set_current_falls_back_to_the_message_and_takes_the_broadcast_as_the_answer) {
  connected c;
  EXPECT_EQ(sent_of<mavlink::command_long>(c.it.on_set_current(9, {4}, at(0))).at(0).command, 224);
  EXPECT_EQ(resolved(c.it.on_set_current(10, {5}, at(0))).at(0).outcome.verdict, command_verdict::already_running);
  const auto second = c.vehicle.say(c.it, ack(224, mavlink::mav_result::unsupported), 0);
  EXPECT_EQ(sent_of<mavlink::mission_set_current>(second).at(0).seq, 4);
  const auto done = resolved(c.vehicle.say(c.it, mavlink::mission_current{.seq = 4}, 0));
  ASSERT_EQ(done.size(), 1U);
  EXPECT_EQ(done[0].asked_by.request_id, 9U);
  EXPECT_EQ(done[0].outcome.verdict, command_verdict::accepted);
}

// -- streams ---------------------------------------------------------------------------------------------------------

TEST(vehicle_link_core, asks_for_each_stream_in_turn_and_names_those_that_do_not_come) {
  settings configured;
  configured.streams = {{mavlink::attitude::message_id, 200}, {mavlink::extended_sys_state::message_id, 1'000}};
  connected c(configured);
  EXPECT_EQ(sent_of<mavlink::command_long>(c.hello).at(0).param1, 30.0F);
  const auto second = c.vehicle.say(c.it, ack(511, mavlink::mav_result::accepted), 0);
  EXPECT_EQ(sent_of<mavlink::command_long>(second).at(0).param1, 245.0F);
  (void)c.vehicle.say(c.it, ack(511, mavlink::mav_result::failed), 0);
  for (std::int64_t now = 0; now < 4 * s; now += 200 * ms) {
    (void)c.vehicle.say(c.it, mavlink::attitude{}, now);
    (void)c.it.on_time(at(now));
  }
  EXPECT_EQ(c.it.describe(at(4 * s)).missing_streams, std::vector<std::string>{"EXTENDED_SYS_STATE"});
}

// -- signatures ------------------------------------------------------------------------------------------------------

signing_settings signed_link(mavlink::link_security security = mavlink::link_security::open) {
  std::array<std::byte, mavlink::secret_key_size> bytes{};
  bytes.fill(std::byte{0x42});
  return {.key = std::make_shared<mavlink::secret_key>(bytes),
          .link = mavlink::link_id{1},
          .unsigned_frames = mavlink::unsigned_policy(),
          .security = security};
}

TEST(vehicle_link_core, a_signed_link_refuses_what_is_not_signed_and_raises_one_alert_a_second) {
  core it(quiet(), signed_link(), {});
  vehicle_voice vehicle;
  (void)it.on_link(link_up(), at(0));
  EXPECT_EQ(announced<signing_alert>(vehicle.beat(it, 0)).size(), 1U);
  EXPECT_TRUE(announced<signing_alert>(vehicle.beat(it, 10 * ms)).empty());
  const auto later = announced<signing_alert>(vehicle.beat(it, s));
  ASSERT_EQ(later.size(), 1U);
  EXPECT_EQ(later[0].rejected, 3U);
  const auto shown = it.describe(at(s));
  EXPECT_EQ(shown.system, 0) << "it was not believed";
  EXPECT_TRUE(shown.reason.starts_with(refused_for_signature)) << shown.reason;
  EXPECT_TRUE(it.health(at(s)).reason.starts_with(refused_for_signature)) << "and not: no heartbeat";
  EXPECT_TRUE(shown.signing_enabled);
  EXPECT_EQ(shown.signing_rejected, 3U);
}

TEST(vehicle_link_core, signed_frames_of_the_vehicle_are_believed_and_ours_are_signed) {
  const auto signing = signed_link();
  core it(quiet(), signing, {});
  (void)it.on_link(link_up(), at(0));
  mavlink::signer vehicle(mavlink::secret_key(signing.key->bytes()), mavlink::link_id{9}, {});
  auto beat = mavlink::encode(mavlink::heartbeat{.type = 2, .autopilot = 12}, {1, 1}, 0, mavlink::signing::on);
  ASSERT_TRUE(vehicle.sign(beat, at(0).wall_ns));
  EXPECT_EQ(observed<mavlink::heartbeat>(it.on_bytes(1, true, beat.span(), at(0))).size(), 1U);
  EXPECT_EQ(it.describe(at(0)).signed_in, 1U) << "which shows that the vehicle has the key";
  const auto ours = it.on_time(at(s));
  mavlink::replay_table replays;
  mavlink::verifier check(mavlink::secret_key(signing.key->bytes()), replays);
  ASSERT_FALSE(ours.empty());
  EXPECT_EQ(check.judge(std::get<transmission>(ours[0]).frame.view(), mavlink::signing_time_at(at(s).wall_ns)),
            mavlink::verdict::accepted_signed);
}

// ArduPilot puts its signing clock a minute on at each start, forgets whom it has heard, and takes no new stream that
// is more than a minute after.
class signing_ardupilot {
public:
  explicit signing_ardupilot(const signing_settings& link) : key_(link.key) { start(); }
  void start() {
    lead_ns_ += 60 * s;
    heard_.emplace();
    ours_.emplace(mavlink::secret_key(key_->bytes()), *heard_);
    signer_.emplace(mavlink::secret_key(key_->bytes()), mavlink::link_id{9}, mavlink::signing_time{});
  }
  effects beat(core& to, std::int64_t now_ns) {
    auto frame =
        mavlink::encode(mavlink::heartbeat{.type = 2, .autopilot = 3}, {1, 1}, sequence_++, mavlink::signing::on);
    EXPECT_TRUE(signer_->sign(frame, at(now_ns).wall_ns + lead_ns_));
    return to.on_bytes(link::only_peer, true, frame.span(), at(now_ns));
  }
  // So many of these it refuses.
  int refuses(const effects& sent, std::int64_t now_ns) {
    int result = 0;
    for (const auto& each : sent)
      if (const auto* out = std::get_if<transmission>(&each))
        result += ours_->judge(out->frame.view(), mavlink::signing_time_at(at(now_ns).wall_ns + lead_ns_)) ==
                          mavlink::verdict::accepted_signed
                      ? 0
                      : 1;
    return result;
  }

private:
  std::shared_ptr<const mavlink::secret_key> key_;
  std::int64_t lead_ns_ = 0;
  std::optional<mavlink::replay_table> heard_;
  std::optional<mavlink::verifier> ours_;
  std::optional<mavlink::signer> signer_;
  std::uint8_t sequence_ = 0;
};

TEST(vehicle_link_core, a_signing_ardupilot_that_starts_three_times_within_a_minute_is_heard_and_hears_us) {
  const auto signing = signed_link();
  core it(quiet(), signing, {});
  (void)it.on_link(link_up(), at(0));
  signing_ardupilot vehicle(signing);
  std::int64_t now = 0;
  for (int start = 0; start < 4; ++start) {
    int heard = 0;
    int refused = 0;
    for (const auto end = now + 20 * s; now < end; now += s) {
      heard += static_cast<int>(observed<mavlink::heartbeat>(vehicle.beat(it, now)).size());
      refused += vehicle.refuses(it.on_command(static_cast<std::uint64_t>(now), command(512), at(now)), now);
      refused += vehicle.refuses(it.on_time(at(now + 500 * ms)), now + 500 * ms);
      if (const auto ceiling = it.wanted_reservation(at(now)))
        it.on_reserved(*ceiling);
    }
    EXPECT_EQ(heard, 20) << "start " << start;
    EXPECT_EQ(refused, 0) << "start " << start;
    vehicle.start();
  }
  EXPECT_EQ(it.describe(at(now)).signing_rejected, 0U);
  const auto health = it.health(at(now));
  EXPECT_EQ(health.how, godwit::runtime::health_colour::yellow);
  EXPECT_NE(health.reason.find("s ahead of ours"), std::string::npos) << health.reason;
}

TEST(vehicle_link_core, what_a_signing_vehicle_has_said_is_not_believed_again_by_the_next_process) {
  const auto signing = signed_link();
  std::vector<std::byte> recorded;
  mavlink::signing_time ceiling{};
  {
    core it(quiet(), signing, {});
    (void)it.on_link(link_up(), at(0));
    mavlink::signer vehicle(mavlink::secret_key(signing.key->bytes()), mavlink::link_id{9}, {});
    const auto say = [&](std::int64_t ahead_ns) {
      auto frame = mavlink::encode(mavlink::heartbeat{.type = 2, .autopilot = 3}, {1, 1}, 0, mavlink::signing::on);
      EXPECT_TRUE(vehicle.sign(frame, at(0).wall_ns + ahead_ns));
      (void)it.on_bytes(link::only_peer, true, frame.span(), at(0));
      recorded.assign(frame.span().begin(), frame.span().end());
    };
    say(300 * s);
    const auto first = recorded;
    say(400 * s);
    recorded = first;
    ceiling = *it.wanted_reservation(at(0)); // on the disk
  }
  auto anew = signed_link();
  anew.replays = std::make_shared<mavlink::replay_table>();
  core it(quiet(), anew, ceiling);
  (void)it.on_link(link_up(), at(s));
  EXPECT_TRUE(observed<mavlink::heartbeat>(it.on_bytes(link::only_peer, true, recorded, at(s))).empty());
  EXPECT_EQ(it.describe(at(s)).signing_rejected, 1U);
}

TEST(vehicle_link_core, the_key_goes_out_only_over_a_secure_link) {
  for (const auto security : {mavlink::link_security::open, mavlink::link_security::secure}) {
    auto signing = signed_link(security);
    signing.unsigned_frames = mavlink::unsigned_policy::accept_all();
    connected c(quiet(), signing);
    const auto [wanted, answer] = c.it.on_set_up_signing({}, at(0));
    const auto sent = sent_of<mavlink::setup_signing>(wanted);
    const bool is_secure = security == mavlink::link_security::secure;
    EXPECT_EQ(answer.is_sent, is_secure) << answer.reason;
    EXPECT_EQ(sent.size(), is_secure ? 1U : 0U);
    for (const auto& each : sent)
      EXPECT_EQ(each.secret_key[31], 0x42);
  }
}

// A secure link on which the vehicle does not sign yet.
signing_settings link_without_listeners() {
  auto result = signed_link();
  mavlink::mark_secure(result);
  return result;
}

TEST(vehicle_link_core, the_key_goes_to_no_vehicle_that_is_armed_or_not_heard) {
  core nobody(quiet(), link_without_listeners(), {});
  (void)nobody.on_link(link_up(), at(0));
  const auto unheard = nobody.on_set_up_signing({}, at(0));
  EXPECT_FALSE(unheard.second.is_sent);
  EXPECT_TRUE(sent_of<mavlink::setup_signing>(unheard.first).empty());
  connected c(quiet(), link_without_listeners());
  (void)c.vehicle.say(c.it, mavlink::heartbeat{.type = 2, .autopilot = 12, .base_mode = 128}, 0);
  const auto armed = c.it.on_set_up_signing({}, at(0));
  EXPECT_FALSE(armed.second.is_sent);
  EXPECT_NE(armed.second.reason.find("armed"), std::string::npos) << armed.second.reason;
  EXPECT_TRUE(sent_of<mavlink::setup_signing>(armed.first).empty());
}

TEST(vehicle_link_core, without_a_key_there_is_none_to_give) {
  connected c;
  const auto [wanted, answer] = c.it.on_set_up_signing({}, at(0));
  EXPECT_FALSE(answer.is_sent);
  EXPECT_NE(answer.reason.find("--signing-key"), std::string::npos) << answer.reason;
  EXPECT_TRUE(sent_of<mavlink::setup_signing>(wanted).empty());
}

TEST(vehicle_link_core, signing_is_ended_by_a_key_of_zeros) {
  connected c(quiet(), link_without_listeners());
  const auto sent = sent_of<mavlink::setup_signing>(c.it.on_set_up_signing({true}, at(0)).first);
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(sent[0].secret_key, (mavlink::setup_signing{}.secret_key));
  EXPECT_EQ(sent[0].initial_timestamp, 0U);
}

TEST(vehicle_link_core, signing_beyond_what_is_reserved_on_the_disk_is_bad_health) {
  auto signing = signed_link();
  signing.unsigned_frames = mavlink::unsigned_policy::accept_all();
  connected c(quiet(), signing);
  const auto wanted = c.it.wanted_reservation(at(0));
  ASSERT_TRUE(wanted);
  c.it.on_reserved(*wanted);
  (void)c.it.on_time(at(s));
  EXPECT_EQ(c.it.health(at(s)).how, godwit::runtime::health_colour::green);
  (void)c.vehicle.beat(c.it, 7 * s);
  (void)c.it.on_time(at(8 * s)); // the journal did not answer meanwhile
  EXPECT_EQ(c.it.health(at(8 * s)).how, godwit::runtime::health_colour::red);
}

// -- bad input -------------------------------------------------------------------------------------------------------

TEST(vehicle_link_core, a_peer_that_speaks_only_mavlink_1_is_named_with_the_remedy) {
  core it(quiet(), {}, {});
  (void)it.on_link(link_up(), at(0));
  // HEARTBEAT of an ArduPilot rover in the first protocol version.
  const std::array<unsigned char, 17> v1{0xFE, 9, 0, 1, 1, 0, 0, 0, 0, 0, 10, 3, 81, 3, 3, 0, 0};
  std::array<std::byte, 17> bytes{};
  std::transform(v1.begin(), v1.end(), bytes.begin(), [](unsigned char each) { return std::byte{each}; });
  const auto crc = mavlink::frame_crc(std::span(bytes).subspan(1, 14), mavlink::heartbeat::crc_extra);
  bytes[15] = std::byte(crc & 0xFFU);
  bytes[16] = std::byte(crc >> 8U);
  (void)it.on_bytes(1, true, bytes, at(0));
  (void)it.on_bytes(1, true, bytes, at(3 * s));
  const auto health = it.health(at(3 * s));
  EXPECT_NE(health.reason.find("MAVLink 1"), std::string::npos) << health.reason;
  EXPECT_NE(health.reason.find("SERIALn_PROTOCOL"), std::string::npos);
}

TEST(vehicle_link_core, good_frames_between_garbage_arrive_and_the_counters_tell) {
  connected c;
  std::vector<std::byte> garbage(64, std::byte{0xFD});
  std::size_t heard = 0;
  for (int i = 0; i < 1'000; ++i) {
    (void)c.it.on_bytes(link::only_peer, true, garbage, at(i * ms));
    heard += observed<mavlink::attitude>(c.vehicle.say(c.it, mavlink::attitude{}, i * ms)).size();
  }
  EXPECT_EQ(heard, 1'000U);
  EXPECT_GT(c.it.describe(at(s)).parse_errors_total, 0U);
}

TEST(vehicle_link_core, half_a_frame_on_a_stream_is_let_go_after_a_silence) {
  connected c;
  const auto frame = mavlink::encode(mavlink::attitude{}, {1, 1}, 0);
  (void)c.it.on_bytes(link::only_peer, false, frame.span().first(6), at(0));
  (void)c.it.on_time(at(s));
  // The next frame is not taken for the rest of the first one.
  const auto done = c.it.on_bytes(link::only_peer, false, frame.span(), at(s));
  EXPECT_EQ(observed<mavlink::attitude>(done).size(), 1U);
}

TEST(vehicle_link_core, more_peers_than_fit_make_room_for_each_other) {
  connected c;
  const auto frame = mavlink::encode(mavlink::heartbeat{.type = 6, .autopilot = 8}, {255, 190}, 0);
  for (link::peer_id peer = 10; peer < 1'000; ++peer)
    (void)c.it.on_bytes(peer, true, frame.span(), at(static_cast<std::int64_t>(peer) * ms));
  EXPECT_EQ(observed<mavlink::attitude>(c.vehicle.say(c.it, mavlink::attitude{}, 2 * s)).size(), 1U);
}

} // namespace core_test
