// What of a station's messages goes on to the vehicle, and what first. The lists: passing/table.hpp.
#include <cstring>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "actors/ground_port/passing/table.hpp"
#include "io/mavlink/messages/request_data_stream.hpp"
#include "tests/actors/ground_port/port_fixture.hpp"

namespace godwit::ground_port {
namespace core_passing_test {

using namespace test;
using executor::act_kind;
using executor::act_verdict;
using mavlink::mav_cmd;
using mavlink::mav_result;

settings passing_settings() {
  settings result;
  result.as.component = 1;
  result.passes = true;
  return result;
}

mavlink::heartbeat copter_beat(std::uint32_t custom_mode = 0, bool is_armed = false) {
  mavlink::heartbeat result;
  result.type = mavlink::number(mavlink::mav_type::quadrotor);
  result.autopilot = mavlink::number(mavlink::mav_autopilot::ardupilotmega);
  result.base_mode = is_armed ? 0x81 : 0x01;
  result.custom_mode = custom_mode;
  return result;
}

class ground_port_passing : public testing::Test {
protected:
  ground_port_passing() { port.vehicle_says(copter_beat()); }

  void say_frame(std::uint32_t id, std::vector<std::uint8_t> payload, mavlink::sender from = station_id) {
    const mavlink::frame_buffer frame(id, mavlink::find_message(id)->crc_extra, std::as_bytes(std::span(payload)), from,
                                      0, false);
    port.bytes(io::link::only_peer, frame.span());
  }
  void say_command(std::uint16_t number, float param1 = 0, float param2 = 0) {
    mavlink::command_long m;
    m.command = number;
    m.param1 = param1;
    m.param2 = param2;
    port.say(m);
  }
  void set_mode(std::uint32_t custom_mode) {
    port.say(command(mav_cmd::do_set_mode, 1, static_cast<float>(custom_mode)));
  }
  [[nodiscard]] std::vector<std::uint32_t> passed() const {
    std::vector<std::uint32_t> result;
    for (const auto& each : port.passed_on)
      result.push_back(each.message);
    return result;
  }
  // One more of this kind is passed on, from whom it came and as it came.
  void expect_passes(std::uint32_t id, const std::vector<std::uint8_t>& payload) {
    const auto before = port.passed_on.size();
    say_frame(id, payload);
    ASSERT_EQ(port.passed_on.size(), before + 1) << id;
    EXPECT_EQ(port.passed_on.back(), (vehicle_link::relayed_frame{id, 255, 190, payload})) << id;
  }

  port_fixture port{passing_settings()};
};

// -- reading ----------------------------------------------------------------------------------------

TEST_F(ground_port_passing, reading_goes_on_as_it_came_with_the_ids_of_the_station) {
  expect_passes(21, {1, 1});                    // PARAM_REQUEST_LIST
  expect_passes(117, {0, 0, 255, 255, 1, 1});   // LOG_REQUEST_LIST
  expect_passes(412, {1, 0, 2, 0, 1, 1});       // REQUEST_EVENT
  expect_passes(233, {0, 3, 1, 2, 3});          // GPS_RTCM_DATA
  expect_passes(110, {0, 1, 1, 0, 0, 0, 3, 1}); // FILE_TRANSFER_PROTOCOL: list
  expect_passes(287, {0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 154}); // a gimbal
}

TEST_F(ground_port_passing, a_stations_heartbeat_goes_on_and_none_is_made) {
  port.say(mavlink::heartbeat{.type = mavlink::number(mavlink::mav_type::gcs)});
  EXPECT_EQ(passed(), (std::vector<std::uint32_t>{0}));
  port.advance(10 * s);
  EXPECT_EQ(passed().size(), 1U);
  EXPECT_TRUE(port.sent<mavlink::heartbeat>().size() <= 1U) << "the vehicle's own";
}

TEST_F(ground_port_passing, clocks_are_answered_here) {
  port.say(mavlink::timesync{.ts1 = 5});
  EXPECT_TRUE(port.passed_on.empty());
  EXPECT_EQ(port.last<mavlink::timesync>().ts1, 5);
}

TEST_F(ground_port_passing, what_is_on_no_list_is_refused_counted_and_said_once) {
  say_frame(131, {1, 2, 3}); // ENCAPSULATED_DATA
  say_command(2'800);        // PANORAMA_CREATE
  say_command(2'800);
  EXPECT_TRUE(port.passed_on.empty());
  EXPECT_EQ(port.last_result(), mavlink::number(mav_result::unsupported));
  EXPECT_EQ(port.count_of("passing_refused"), 2U);
  EXPECT_EQ(port.texts().size(), 1U);
}

TEST_F(ground_port_passing, what_another_system_is_meant_by_does_not_go_on) {
  say_frame(21, {2, 1});
  EXPECT_TRUE(port.passed_on.empty());
  EXPECT_EQ(port.count_of("not_for_us"), 1U);
}

TEST_F(ground_port_passing, who_speaks_as_the_vehicle_is_no_station) {
  say_frame(21, {1, 1}, {1, 100});
  say_command(400, 1);
  EXPECT_TRUE(port.passed_on.empty());
}

TEST_F(ground_port_passing, plans_are_godwits_and_nothing_of_them_goes_on) {
  EXPECT_EQ(port.upload(3).type, 0);
  (void)port.download();
  port.say(mavlink::mission_clear_all{});
  port.say(mavlink::mission_set_current{.seq = 1});
  say_frame(160, {0, 0, 0, 0, 0, 0, 0, 0, 1, 1}); // FENCE_POINT
  EXPECT_TRUE(port.passed_on.empty());
}

TEST_F(ground_port_passing, more_than_the_budget_is_dropped_and_counted) {
  for (int i = 0; i < 600; ++i)
    say_frame(21, {1, 1});
  EXPECT_EQ(port.passed_on.size(), 500U);
  EXPECT_EQ(port.count_of("passing_dropped"), 100U);
  port.advance(s);
  say_frame(21, {1, 1});
  EXPECT_EQ(port.passed_on.size(), 501U);
}

TEST_F(ground_port_passing, no_station_makes_slower_what_the_flight_is_judged_by) {
  mavlink::request_data_stream off;
  off.target_system = off.target_component = 1;
  off.req_stream_id = 6; // position
  off.req_message_rate = 1;
  port.say_as_it_is(off);
  const auto& passed = port.passed_on.back();
  const auto m = mavlink::decode_payload<mavlink::request_data_stream>(std::as_bytes(std::span(passed.payload)));
  EXPECT_EQ(m.req_message_rate, 4);
  EXPECT_EQ(m.start_stop, 1);
}

TEST_F(ground_port_passing, intervals_of_what_godwit_needs_are_kept_here_and_others_go_on) {
  port.say(command(mav_cmd::set_message_interval, 33, 1'000'000)); // GLOBAL_POSITION_INT
  EXPECT_TRUE(port.passed_on.empty());
  EXPECT_EQ(port.last_result(), 0);
  port.say(command(mav_cmd::set_message_interval, 36, 1'000'000)); // SERVO_OUTPUT_RAW
  EXPECT_EQ(passed(), (std::vector<std::uint32_t>{76}));
}

TEST_F(ground_port_passing, nothing_passes_where_the_setting_says_so) {
  port_fixture closed;
  closed.say(mavlink::param_request_list{.target_system = 1, .target_component = 1});
  closed.say(command(mav_cmd::component_arm_disarm, 1));
  closed.component_says({253, 1, 100, {6, 'x'}});
  EXPECT_TRUE(closed.passed_on.empty());
  EXPECT_TRUE(closed.acts.empty());
  EXPECT_TRUE(closed.sent<mavlink::statustext>().empty());
}

// Both would hear each other's frames twice.
TEST_F(ground_port_passing, nothing_passes_while_the_autopilot_itself_is_on_the_line) {
  auto as_companion = passing_settings();
  as_companion.as.component = 191;
  port_fixture shared(as_companion);
  shared.say(mavlink::heartbeat{}, autopilot_id);
  shared.say_as_it_is(mavlink::param_request_list{.target_system = 1, .target_component = 1});
  EXPECT_TRUE(shared.passed_on.empty());
}

// -- what the vehicle says --------------------------------------------------------------------------

TEST_F(ground_port_passing, what_the_vehicles_components_say_comes_to_the_stations_with_their_ids) {
  port.component_says({22, 1, 1, {0, 0, 128, 63, 5, 0, 1, 0, 'A'}}); // PARAM_VALUE
  ASSERT_FALSE(port.frames.empty());
  const auto frame = port.frames.back().frame.view();
  EXPECT_EQ(frame.id(), 22U);
  EXPECT_EQ(frame.from(), autopilot_id);
  port.component_says({0, 1, 154, {0, 0, 0, 0, 26, 8, 0, 4, 3}}); // a gimbal's heartbeat
  EXPECT_EQ(port.frames.back().frame.view().from(), (mavlink::sender{1, 154}));
  EXPECT_EQ(port.count_of("passed_to_stations"), 2U);
}

TEST_F(ground_port_passing, an_answer_goes_to_the_station_that_it_names) {
  port.say(mavlink::heartbeat{}, station_id, 3);
  port.say(mavlink::heartbeat{}, other_station, 4);
  port.component_says({77, 1, 1, {0x90, 1, 0, 0, 0, 0, 0, 0, 254, 190}}); // COMMAND_ACK
  EXPECT_EQ(port.frames.back().to, 4U);
}

// -- people -----------------------------------------------------------------------------------------

TEST_F(ground_port_passing, what_a_person_means_waits_until_the_executor_knows) {
  port.say(command(mav_cmd::component_arm_disarm, 1));
  EXPECT_TRUE(port.passed_on.empty()) << "not before the authority is that person's";
  ASSERT_EQ(port.acts.size(), 1U);
  EXPECT_EQ(port.acts[0].what.kind, act_kind::arm);
  EXPECT_EQ(port.acts[0].what.by, (executor::station{255, 190}));
  port.executor_says(act_verdict::pass);
  EXPECT_EQ(passed(), (std::vector<std::uint32_t>{76}));
  EXPECT_TRUE(port.sent<mavlink::command_ack>().empty()) << "the vehicle answers";
}

TEST_F(ground_port_passing, each_of_a_persons_messages_is_told_before_it_goes_on) {
  for (const std::uint16_t each : {20,  21,  22,  23,  24,  34,  35,    84,     85,     178,    185,
                                   186, 191, 207, 208, 218, 400, 3'000, 42'001, 43'000, 43'001, 43'002})
    say_command(each, each == 400 ? 0.0F : 1.0F);
  EXPECT_TRUE(port.passed_on.empty());
  EXPECT_EQ(port.acts.size(), 22U);
  for (const std::uint32_t each : {69, 70, 82, 84, 86, 144, 149}) {
    std::vector<std::uint8_t> payload(mavlink::find_message(each)->base_length);
    payload.back() = 1;
    payload.front() = 100; // a stick that is held
    say_frame(each, payload);
  }
  EXPECT_TRUE(port.passed_on.empty());
  EXPECT_EQ(port.acts.size(), 29U);
}

TEST_F(ground_port_passing, a_command_for_another_component_of_the_vehicle_is_no_way_around) {
  auto arm = command(mav_cmd::component_arm_disarm, 1);
  arm.target_system = 1;
  arm.target_component = 100; // an ArduPilot obeys where it knows no such component
  port.say_as_it_is(arm);
  EXPECT_TRUE(port.passed_on.empty());
  EXPECT_EQ(port.acts.size(), 1U);
}

TEST_F(ground_port_passing, a_return_and_a_disarm_are_stops_and_go_on_also_where_the_executor_is_silent) {
  say_command(20);
  ASSERT_EQ(port.acts.back().what.kind, act_kind::stop);
  port.executor_is_silent();
  EXPECT_EQ(passed(), (std::vector<std::uint32_t>{76}));
  EXPECT_EQ(port.taken_over_told, (std::vector<std::size_t>{0})) << "the failsafe is told first";
  say_command(400, 0);
  EXPECT_EQ(port.acts.back().what.kind, act_kind::stop);
}

TEST_F(ground_port_passing, what_lets_the_vehicle_move_does_not_go_on_where_the_executor_is_silent) {
  for (const std::uint16_t each : {400, 22, 178}) {
    say_command(each, 1);
    port.executor_is_silent();
    EXPECT_EQ(port.last_result(), mavlink::number(mav_result::temporarily_rejected));
  }
  set_mode(4); // guided
  port.executor_is_silent();
  EXPECT_TRUE(port.passed_on.empty());
  EXPECT_EQ(port.count_of("acts_unanswered"), 4U);
}

TEST_F(ground_port_passing, a_repetition_is_not_asked_twice_and_a_stream_is_asked_with_its_newest) {
  say_command(400, 1);
  auto again = command(mav_cmd::component_arm_disarm, 1);
  again.confirmation = 1;
  port.say(again);
  EXPECT_EQ(port.acts.size(), 1U);
  port.executor_says(act_verdict::pass);
  say_frame(69, {100, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1});
  say_frame(69, {101, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1});
  EXPECT_EQ(port.acts.size(), 2U);
  port.executor_says(act_verdict::pass);
  EXPECT_EQ(port.passed_on.back().payload[0], 101);
}

TEST_F(ground_port_passing, a_hold_that_godwit_does_is_accepted_when_the_vehicle_has_accepted_it_and_not_before) {
  set_mode(17); // brake, in which godwit holds
  EXPECT_EQ(port.acts.back().what.kind, act_kind::hold);
  port.executor_says(act_verdict::begun);
  port.advance(s);
  EXPECT_EQ(port.last_result(), -1);
  port.executor_resolves(act_verdict::done);
  EXPECT_EQ(port.last_result(), 0);
  EXPECT_TRUE(port.passed_on.empty());
  port.executor_resolves(act_verdict::done);
  EXPECT_EQ(port.sent<mavlink::command_ack>().size(), 1U) << "answered once";
}

TEST_F(ground_port_passing, a_hold_that_the_vehicle_does_not_obey_is_refused_with_the_reason) {
  set_mode(17);
  port.executor_says(act_verdict::begun);
  port.executor_resolves(act_verdict::refused, "it was not executed");
  EXPECT_EQ(port.last_result(), mavlink::number(mav_result::temporarily_rejected));
  port.advance(s);
  EXPECT_TRUE(port.said("Mode hold (17): it was not executed"));
}

TEST_F(ground_port_passing, a_hold_goes_on_after_all_where_somebody_takes_the_vehicle_before) {
  set_mode(17);
  port.executor_says(act_verdict::begun);
  port.executor_resolves(act_verdict::pass);
  EXPECT_EQ(passed(), (std::vector<std::uint32_t>{76}));
  EXPECT_EQ(port.last_result(), -1) << "the vehicle answers";
}

// The executor may have crashed after the first, and forgotten it.
TEST_F(ground_port_passing, a_hold_that_is_said_again_is_asked_again_and_answered_once) {
  set_mode(17);
  port.executor_says(act_verdict::begun);
  set_mode(17);
  ASSERT_EQ(port.acts.size(), 2U);
  port.executor_says(act_verdict::begun);
  port.executor_resolves(act_verdict::done);
  EXPECT_EQ(port.sent<mavlink::command_ack>().size(), 1U);
}

TEST_F(ground_port_passing, a_vehicle_that_holds_already_is_answered_at_once) {
  set_mode(17);
  port.executor_says(act_verdict::done);
  EXPECT_EQ(port.last_result(), 0);
  EXPECT_TRUE(port.passed_on.empty());
}

// -- sticks -----------------------------------------------------------------------------------------

// QGroundControl streams its virtual joystick as soon as it is shown. A vehicle that has heard it and misses it acts by
// itself: a PX4 returns.
TEST_F(ground_port_passing, sticks_that_are_left_alone_are_no_persons_act_and_never_missed) {
  for (int i = 0; i < 3; ++i)
    say_frame(69, {0, 0, 0, 0, 0xF4, 1, 0, 0, 0, 0, 1});
  port.advance(s);
  EXPECT_TRUE(port.acts.empty());
  EXPECT_EQ(port.passed_on.size(), 3U);
  EXPECT_TRUE(port.texts().empty());
  EXPECT_EQ(port.count_of("passing_refused"), 0U);
  say_frame(69, {0, 2, 0, 0, 0xF4, 1, 0, 0, 0, 0, 1});
  EXPECT_EQ(port.acts.back().what.kind, act_kind::stream) << "now a person holds one";
}

TEST_F(ground_port_passing, a_clock_that_a_station_gives_to_each_vehicle_is_passed_over_without_a_word) {
  say_frame(2, {1, 2, 3, 4, 5, 6, 7, 8, 1});
  port.advance(s);
  EXPECT_TRUE(port.passed_on.empty());
  EXPECT_TRUE(port.texts().empty());
}

TEST_F(ground_port_passing, calibrations_and_checks_go_to_a_vehicle_that_stands_disarmed) {
  for (const std::uint16_t each : {401, 500, 311, 42006, 42424, 42425, 42426}) {
    say_command(each, 1);
    EXPECT_EQ(port.acts.back().what.kind, act_kind::configure) << each;
    port.executor_says(act_verdict::refused, "not while the vehicle is armed");
  }
  for (const std::uint16_t each : {211, 526, 529, 2510, 2511}) {
    const auto before = port.passed_on.size();
    say_command(each, 1);
    EXPECT_EQ(port.passed_on.size(), before + 1) << each;
  }
}

// -- what the vehicle answers -----------------------------------------------------------------------

TEST_F(ground_port_passing, the_vehicles_answer_to_a_command_that_was_passed_on_is_matched_to_it_once) {
  say_command(400, 0);
  ASSERT_TRUE(port.acts.back().what.is_acknowledged);
  const auto number = port.acts.back().what.number;
  port.executor_says(act_verdict::pass);
  port.vehicle_answers(400, mav_result::failed, other_station);
  port.vehicle_answers(176, mav_result::failed);
  EXPECT_TRUE(port.acknowledged.empty()) << "to somebody else, or to something else";
  port.vehicle_answers(400, mav_result::failed);
  ASSERT_EQ(port.acknowledged.size(), 1U);
  EXPECT_EQ(port.acknowledged[0].number, number);
  EXPECT_TRUE(port.acknowledged[0].is_refused);
  EXPECT_EQ(port.last_result(), mavlink::number(mav_result::failed)) << "and the station hears it";
  port.vehicle_answers(400, mav_result::accepted);
  EXPECT_EQ(port.acknowledged.size(), 1U);
}

TEST_F(ground_port_passing, accepted_and_in_progress_are_no_refusal_and_all_else_is) {
  for (const auto result :
       {mav_result::accepted, mav_result::temporarily_rejected, mav_result::denied, mav_result::unsupported,
        mav_result::failed, mav_result::in_progress, mav_result::command_long_only, mav_result::command_int_only}) {
    say_command(185, 1);
    port.executor_says(act_verdict::pass);
    port.vehicle_answers(185, result);
    const bool is_accepted = result == mav_result::accepted || result == mav_result::in_progress;
    EXPECT_EQ(port.acknowledged.back().is_refused, !is_accepted) << io::name_of(result);
  }
}

// What the executor makes of it: station_commands.a_command_that_the_vehicle_refuses_leaves_everything_as_it_was.
TEST_F(ground_port_passing, each_command_of_a_stranger_that_the_vehicle_refuses_in_whatever_way_is_told_as_refused) {
  std::set<int> told;
  for (const auto& [result, name] : enum_names(mav_result{}))
    for (int number = 0; number <= 65'535; ++number) {
      const auto* const row = passing::find_command(static_cast<std::uint16_t>(number));
      if (result == mav_result::accepted || result == mav_result::in_progress || row == nullptr)
        continue;
      for (const auto param1 : {0.0F, 1.0F}) {
        const auto asked = port.acts.size();
        const auto before = port.acknowledged.size();
        say_command(row->command, param1);
        if (port.acts.size() == asked)
          continue; // godwit's own, or it goes nowhere
        port.executor_says(act_verdict::pass);
        port.vehicle_answers(row->command, result);
        ASSERT_EQ(port.acknowledged.size(), before + 1) << row->name << ' ' << param1 << ' ' << name;
        EXPECT_TRUE(port.acknowledged.back().is_refused) << row->name << ' ' << param1 << ' ' << name;
        EXPECT_EQ(port.acknowledged.back().number, port.acts.back().what.number);
        told.insert(number);
      }
    }
  EXPECT_TRUE(told.contains(400) && told.contains(185) && told.contains(176)) << "disarm, terminate, mode";
  EXPECT_GT(told.size(), 30U);
}

TEST_F(ground_port_passing, the_answer_of_another_component_says_nothing_of_the_vehicle) {
  say_command(400, 0);
  port.executor_says(act_verdict::pass);
  port.vehicle_answers(400, mav_result::unsupported, station_id, {1, 100});
  EXPECT_TRUE(port.acknowledged.empty()) << "a camera knows no arming";
}

// ArduPilot answers SET_MODE with its number as a command, PX4 as DO_SET_MODE.
TEST_F(ground_port_passing, SET_MODE_is_acknowledged_as_either_autopilot_does_it) {
  for (const std::uint16_t as : {11, 176}) {
    port.say(mavlink::set_mode{.target_system = 1, .base_mode = 157, .custom_mode = 6});
    port.executor_says(act_verdict::pass);
    port.acknowledged.clear();
    port.vehicle_answers(as, mav_result::denied);
    ASSERT_EQ(port.acknowledged.size(), 1U) << as;
    EXPECT_EQ(port.acknowledged[0].number, port.acts.back().what.number);
  }
}

TEST_F(ground_port_passing, modes_are_told_apart_by_what_they_come_to) {
  set_mode(6); // RTL
  EXPECT_EQ(port.acts.back().what.kind, act_kind::stop);
  set_mode(5); // loiter: the sticks fly it
  EXPECT_EQ(port.acts.back().what.kind, act_kind::stop);
  set_mode(0); // stabilize
  EXPECT_EQ(port.acts.back().what.kind, act_kind::command);
  port.say(mavlink::set_mode{.target_system = 1, .base_mode = 1, .custom_mode = 9});
  EXPECT_EQ(port.acts.back().what.kind, act_kind::stop);
  EXPECT_TRUE(port.passed_on.empty());
}

TEST_F(ground_port_passing, the_mission_mode_is_a_start_and_never_goes_on) {
  port.upload(3);
  set_mode(3);
  ASSERT_EQ(port.starts.size(), 1U);
  EXPECT_EQ(port.starts[0].asked_by, (executor::station{255, 190}));
  port.executor_answers(executor::start_verdict::started);
  EXPECT_EQ(port.last<mavlink::command_ack>().command, 176);
  EXPECT_EQ(port.last_result(), 0);
  EXPECT_TRUE(port.passed_on.empty());
}

TEST_F(ground_port_passing, the_mission_mode_of_a_flight_that_is_paused_is_accepted_when_the_vehicle_is_in_it) {
  for (const bool goes_on : {true, false}) {
    port_fixture paused(passing_settings());
    paused.upload(3);
    paused.vehicle_says(copter_beat(5, true));
    paused.executor_says(mission_progress{paused.shown().plans[0].plan_id, 1, mavlink::mission_state::paused});
    paused.say(command(mav_cmd::do_set_mode, 1, 3));
    ASSERT_EQ(paused.acts.size(), 1U);
    EXPECT_EQ(paused.acts[0].what.kind, act_kind::go_on);
    EXPECT_EQ(paused.acts[0].what.by, (executor::station{255, 190}));
    paused.executor_says(act_verdict::begun);
    EXPECT_EQ(paused.last_result(), -1) << "it is under way";
    paused.executor_resolves(goes_on ? act_verdict::done : act_verdict::refused);
    EXPECT_EQ(paused.last<mavlink::command_ack>().command, 176);
    EXPECT_EQ(paused.last_result(), mavlink::number(goes_on ? mav_result::accepted : mav_result::temporarily_rejected));
    EXPECT_TRUE(paused.passed_on.empty());
  }
}

TEST_F(ground_port_passing, the_mission_mode_that_is_repeated_while_the_flight_goes_on_is_in_progress) {
  port.upload(3);
  port.vehicle_says(copter_beat(5, true));
  port.executor_says(mission_progress{port.shown().plans[0].plan_id, 1, mavlink::mission_state::paused});
  set_mode(3);
  port.executor_says(act_verdict::begun);
  set_mode(3);
  port.executor_says(act_verdict::begun);
  EXPECT_EQ(port.last_result(), mavlink::number(mav_result::in_progress));
  port.executor_resolves(act_verdict::done);
  EXPECT_EQ(port.last_result(), mavlink::number(mav_result::accepted));
}

TEST_F(ground_port_passing, the_mission_mode_right_after_a_hold_resumes_and_is_no_repeated_start) {
  port.upload(3);
  set_mode(3);
  port.executor_answers(executor::start_verdict::started);
  port.vehicle_says(copter_beat(3, true));
  port.executor_says(mission_progress{port.shown().plans[0].plan_id, 1, mavlink::mission_state::active});
  set_mode(17);
  port.executor_says(act_verdict::begun);
  set_mode(3); // before anything shows the hold
  ASSERT_EQ(port.acts.size(), 2U);
  EXPECT_EQ(port.acts[1].what.kind, act_kind::go_on);
  EXPECT_EQ(port.starts.size(), 1U);
}

TEST_F(ground_port_passing, a_mode_of_a_vehicle_that_was_never_heard_is_refused) {
  port_fixture fresh(passing_settings());
  fresh.say(command(mav_cmd::do_set_mode, 1, 3));
  EXPECT_TRUE(fresh.passed_on.empty());
  EXPECT_EQ(fresh.last_result(), mavlink::number(mav_result::temporarily_rejected));
}

// -- go to ------------------------------------------------------------------------------------------

class ground_port_reposition : public testing::Test {
protected:
  ground_port_reposition() {
    mavlink::heartbeat beat;
    beat.type = mavlink::number(mavlink::mav_type::quadrotor);
    beat.autopilot = mavlink::number(mavlink::mav_autopilot::px4);
    beat.base_mode = 0x9d;
    beat.custom_mode = 0x04040000;
    port.vehicle_says(beat);
    port.vehicle_says(mavlink::home_position{.altitude = 488'000});
    port.vehicle_says(mavlink::global_position_int{.lat = 474'000'000, .lon = 85'000'000, .relative_alt = 25'000});
    port.upload(3);
    port.forget();
  }
  void reposition(float latitude, float longitude, float altitude_m) {
    auto m = command(mav_cmd::do_reposition, -1, 1);
    m.param4 = std::numeric_limits<float>::quiet_NaN();
    m.param5 = latitude;
    m.param6 = longitude;
    m.param7 = altitude_m;
    port.say(m);
  }
  static constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  port_fixture port{passing_settings()};
};

// Found with QGroundControl: "Unable to pause vehicle."
TEST_F(ground_port_reposition, the_pause_of_QGroundControl_is_a_hold) {
  reposition(nan, nan, nan);
  ASSERT_EQ(port.acts.size(), 1U);
  EXPECT_EQ(port.acts[0].what.kind, act_kind::hold);
  port.executor_says(act_verdict::begun);
  port.executor_resolves(act_verdict::done);
  EXPECT_EQ(port.last<mavlink::command_ack>().command, 192);
  EXPECT_EQ(port.last_result(), 0);
}

// As it came at 30.4 m above a home at 488 m: 18 ms after the ACK of the hold, which was asked for at 25 m in a climb.
TEST_F(ground_port_reposition, its_pause_with_the_slider_of_the_altitude_left_alone_stays_a_hold) {
  reposition(nan, nan, nan);
  port.executor_says(act_verdict::begun);
  port.executor_resolves(act_verdict::done);
  port.vehicle_says(mavlink::global_position_int{.lat = 474'000'000, .lon = 85'000'000, .relative_alt = 30'400});
  port.forget();
  reposition(nan, nan, 513);
  ASSERT_EQ(port.acts.size(), 2U);
  EXPECT_EQ(port.acts[1].what.kind, act_kind::hold);
  port.executor_says(act_verdict::done);
  EXPECT_EQ(port.last_result(), 0);
  EXPECT_TRUE(port.words.empty()) << "no plan is flown instead";
  port.advance(11 * ns_per_s);
  reposition(nan, nan, 513);
  ASSERT_EQ(port.acts.size(), 3U);
  EXPECT_EQ(port.acts[2].what.kind, act_kind::go_to) << "long after the hold it is another altitude";
}

TEST_F(ground_port_reposition, its_change_of_the_altitude_is_a_go_to_where_the_vehicle_is) {
  reposition(nan, nan, 508);
  ASSERT_EQ(port.acts.size(), 1U);
  port.executor_says(act_verdict::own);
  ASSERT_EQ(port.words.size(), 1U);
  EXPECT_EQ(port.words[0].what.kind, operators::command_kind::go_to);
  EXPECT_NEAR(port.words[0].what.place->altitude_m, 20, 1e-3);
  port.executor_says(operators::answer{true, {}});
  EXPECT_EQ(port.last_result(), 0);
  EXPECT_TRUE(port.passed_on.empty());
}

TEST_F(ground_port_reposition, who_has_the_vehicle_commands_it_and_the_vehicle_answers) {
  reposition(47.5F, 8.25F, 508);
  ASSERT_EQ(port.acts.size(), 1U);
  EXPECT_EQ(port.acts[0].what.kind, act_kind::go_to);
  port.executor_says(act_verdict::pass);
  EXPECT_EQ(port.passed_on.size(), 1U);
  EXPECT_TRUE(port.words.empty());
  EXPECT_EQ(port.last_result(), -1);
}

TEST_F(ground_port_reposition, where_the_executor_is_silent_a_pause_goes_on_and_a_go_to_does_not) {
  reposition(47.5F, 8.25F, 508);
  port.executor_is_silent();
  EXPECT_TRUE(port.passed_on.empty());
  EXPECT_EQ(port.last_result(), mavlink::number(mav_result::temporarily_rejected));
  reposition(nan, nan, nan);
  port.executor_is_silent();
  EXPECT_EQ(port.passed_on.size(), 1U);
}

// -- configuration ----------------------------------------------------------------------------------

TEST_F(ground_port_passing, a_parameter_that_is_not_set_is_read_back) {
  mavlink::param_set set_current;
  set_current.target_system = set_current.target_component = 1;
  std::memcpy(set_current.param_id.data(), "RTL_ALT", 7);
  port.say_as_it_is(set_current);
  ASSERT_EQ(port.acts.back().what.kind, act_kind::configure);
  port.executor_says(act_verdict::refused, "not while the vehicle is armed");
  EXPECT_EQ(passed(), (std::vector<std::uint32_t>{20})); // PARAM_REQUEST_READ
  EXPECT_EQ(port.count_of("passing_refused"), 1U);
  port.say_as_it_is(set_current);
  port.executor_says(act_verdict::pass);
  EXPECT_EQ(port.passed_on.back().message, 23U);
}

// Found by tests/fuzz/passing_router_fuzz.cpp.
TEST_F(ground_port_passing, of_a_parameter_without_a_name_nothing_is_read_back) {
  say_frame(mavlink::param_set::message_id, {});
  ASSERT_EQ(port.acts.size(), 1U);
  port.executor_says(act_verdict::refused, "not while the vehicle is armed");
  EXPECT_TRUE(port.passed_on.empty());
}

TEST_F(ground_port_passing, files_are_written_only_where_the_executor_lets_and_plans_never) {
  std::vector<std::uint8_t> open{0, 1, 1, 7, 0, 0, 11, 4, 0, 0, 0, 0, 0, 0, 0, '@', 'S', 'Y', 'S'};
  say_frame(110, open);
  ASSERT_EQ(port.acts.size(), 1U);
  port.executor_says(act_verdict::refused, "not while the vehicle is armed");
  EXPECT_TRUE(port.passed_on.empty());
  EXPECT_EQ(port.frames.back().frame.view().id() == 110U || port.frames.back().frame.view().id() == 253U, true);
  const std::string path = "@MISSION/mission.dat";
  open.resize(15);
  open.insert(open.end(), path.begin(), path.end());
  port.forget();
  say_frame(110, open);
  EXPECT_EQ(port.acts.size(), 1U) << "nobody is asked";
  ASSERT_FALSE(port.frames.empty());
  const auto answer = port.frames.front().frame.view();
  EXPECT_EQ(answer.id(), 110U);
  EXPECT_EQ(std::to_integer<int>(answer.payload()[6]), 129) << "NAK";
  EXPECT_EQ(std::to_integer<int>(answer.payload()[3]), 8) << "the next number";
}

TEST_F(ground_port_passing, what_only_the_settings_let_pass_needs_them) {
  say_frame(126, std::vector<std::uint8_t>(79, 1)); // SERIAL_CONTROL
  say_command(209, 1);                              // DO_MOTOR_TEST
  EXPECT_TRUE(port.passed_on.empty());
  EXPECT_TRUE(port.acts.empty());
  EXPECT_EQ(port.last_result(), mavlink::number(mav_result::denied));
  auto allowed = passing_settings();
  allowed.also_passes = {"DO_MOTOR_TEST"};
  port_fixture open(allowed);
  open.say(command(static_cast<mav_cmd>(209), 1));
  ASSERT_EQ(open.acts.size(), 1U);
  EXPECT_EQ(open.acts[0].what.kind, act_kind::configure) << "and then only disarmed";
}

} // namespace core_passing_test
} // namespace godwit::ground_port
