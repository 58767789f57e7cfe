// commands of operators on the ground port: DO_REPOSITION and DO_PAUSE_CONTINUE.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <memory>

#include "tests/actors/ground_port/port_fixture.hpp"
#include "tests/actors/ground_port/results.hpp"

namespace godwit::ground_port {
namespace core_operators_test {

using namespace test;
using mavlink::mav_cmd;
using mavlink::mav_result;
using operators::answer;
using operators::command_kind;

const answer taken{true, {}};

mavlink::command_long pause_command() { return command(mav_cmd::do_pause_continue, 0); }
mavlink::command_long continue_command() { return command(mav_cmd::do_pause_continue, 1); }

mavlink::command_int go_to_command(std::int32_t latitude = 500'000'000) {
  return {.frame = mavlink::number(mavlink::mav_frame::global_relative_alt),
          .command = mavlink::number(mav_cmd::do_reposition),
          .param1 = -1,
          .param4 = std::numeric_limits<float>::quiet_NaN(),
          .x = latitude,
          .y = 364'000'000,
          .z = 30};
}

// -- the executor is asked ------------------------------------------------------------------------

TEST(ground_port_words, a_reposition_is_asked_of_the_executor_and_nothing_is_answered_before_it) {
  port_fixture port;
  port.say(go_to_command());
  ASSERT_EQ(port.words.size(), 1U);
  EXPECT_EQ(port.words[0].what.kind, command_kind::go_to);
  EXPECT_EQ(port.words[0].what.by, "station 255/190");
  EXPECT_EQ(port.words[0].what.place, (mission::position{50, 36.4, 30}));
  EXPECT_EQ(port.last_result(), -1);
}

TEST(ground_port_words, pause_and_continue_are_asked_in_either_message) {
  port_fixture port;
  port.say(pause_command());
  port.executor_says(taken);
  port.say(continue_command());
  port.executor_says(taken);
  port.say(mavlink::command_int{.command = mavlink::number(mav_cmd::do_pause_continue), .param1 = 0});
  ASSERT_EQ(port.words.size(), 3U);
  EXPECT_EQ(port.words[0].what.kind, command_kind::pause);
  EXPECT_EQ(port.words[1].what.kind, command_kind::resume);
  EXPECT_EQ(port.words[2].what.kind, command_kind::pause);
}

TEST(ground_port_words, a_word_that_is_taken_is_accepted_to_the_one_who_said_it) {
  port_fixture port;
  port.say(go_to_command(), other_station);
  port.say(mavlink::heartbeat{});
  port.executor_says(taken);
  EXPECT_EQ(port.last_result(), accepted);
  EXPECT_EQ(port.last<mavlink::command_ack>().command, 192);
  EXPECT_EQ(port.last<mavlink::command_ack>().target_system, other_station.system);
  EXPECT_EQ(port.last<mavlink::command_ack>().target_component, other_station.component);
  EXPECT_TRUE(port.texts().empty());
}

TEST(ground_port_words, a_word_that_is_not_taken_is_rejected_for_now_with_the_reason_as_a_text) {
  port_fixture port;
  port.say(go_to_command());
  port.executor_says(answer{false, "a fence is in the way"});
  EXPECT_EQ(port.last_result(), temporarily_rejected);
  EXPECT_TRUE(port.said("Go to: a fence is in the way"));
  port.say(pause_command());
  port.executor_says(answer{false, {}});
  EXPECT_EQ(port.last_result(), temporarily_rejected);
  EXPECT_TRUE(port.said("Pause: refused"));
  EXPECT_EQ(port.count_of("commands_refused"), 2U);
}

TEST(ground_port_words, without_an_executor_it_is_rejected_for_now_and_said_so) {
  port_fixture port({}, false);
  port.say(continue_command());
  EXPECT_EQ(port.last_result(), temporarily_rejected);
  EXPECT_TRUE(port.said("Continue: no executor is there"));
  EXPECT_TRUE(port.words.empty());
}

TEST(ground_port_words, without_an_answer_it_is_rejected_for_now_and_said_so) {
  port_fixture port;
  port.say(pause_command());
  port.advance(3 * s);
  port.executor_fails_to_hear("the executor does not answer");
  EXPECT_EQ(port.last_result(), temporarily_rejected);
  EXPECT_TRUE(port.said("Pause: the executor does not answer"));
  port.say(continue_command());
  EXPECT_EQ(port.words.size(), 2U) << "the next one is asked";
}

TEST(ground_port_words, what_is_no_word_is_refused_without_the_executor) {
  port_fixture port;
  port.say(command(mav_cmd::do_pause_continue, 2));
  EXPECT_EQ(port.last_result(), denied);
  port.say(command(mav_cmd::do_reposition));
  EXPECT_EQ(port.last_result(), static_cast<int>(mav_result::command_int_only));
  EXPECT_TRUE(port.words.empty());
  EXPECT_EQ(port.texts().size(), 2U);
}

TEST(ground_port_words, an_altitude_above_the_sea_waits_for_the_vehicle_to_say_where_home_is) {
  port_fixture port;
  auto order = go_to_command();
  order.frame = mavlink::number(mavlink::mav_frame::global);
  order.z = 480;
  port.say(order);
  EXPECT_EQ(port.last_result(), temporarily_rejected);
  EXPECT_TRUE(port.said("Go to: home's altitude is not known yet"));
  EXPECT_TRUE(port.words.empty());
  port.vehicle_says(mavlink::home_position{.altitude = 450'250});
  port.say(order);
  ASSERT_EQ(port.words.size(), 1U);
  EXPECT_DOUBLE_EQ(port.words[0].what.place->altitude_m, 29.75);
}

TEST(ground_port_words, a_word_changes_nothing_on_the_disk_and_sends_nothing_to_the_vehicle) {
  port_fixture port;
  const auto events = port.events;
  port.forget();
  port.say(go_to_command());
  port.executor_says(taken);
  EXPECT_EQ(port.events, events);
  for (const auto& each : port.frames)
    EXPECT_EQ(each.frame.view().from(), port_id);
}

// -- repetitions ----------------------------------------------------------------------------------

TEST(ground_port_words, a_repetition_while_the_executor_works_is_not_given_to_it_again) {
  port_fixture port;
  port.say(pause_command());
  for (std::uint8_t confirmation = 0; confirmation < 4; ++confirmation) {
    port.advance(500 * ms);
    auto again = pause_command();
    again.confirmation = confirmation;
    port.say(again);
    EXPECT_EQ(port.last_result(), in_progress);
  }
  EXPECT_EQ(port.words.size(), 1U);
  EXPECT_TRUE(port.texts().empty());
  port.executor_says(taken);
  EXPECT_EQ(port.last_result(), accepted);
}

TEST(ground_port_words, a_repetition_within_3_seconds_after_the_answer_gets_the_same_answer) {
  for (const auto& said : {taken, answer{false, "the vehicle is on the ground"}}) {
    port_fixture port;
    port.say(go_to_command());
    port.executor_says(said);
    const auto result = port.last_result();
    const auto texts = port.texts().size();
    for (int i = 0; i < 2; ++i) {
      port.advance(1'499 * ms);
      port.forget();
      port.say(go_to_command());
      EXPECT_EQ(port.last_result(), result);
    }
    EXPECT_LE(port.texts().size(), texts);
    EXPECT_EQ(port.words.size(), 1U);
    port.advance(2 * ms);
    port.say(go_to_command());
    EXPECT_EQ(port.words.size(), 2U) << "after that it is meant anew";
  }
}

TEST(ground_port_words, another_place_is_no_repetition) {
  port_fixture port;
  port.say(go_to_command());
  port.executor_says(taken);
  port.say(go_to_command(500'000'001));
  EXPECT_EQ(port.words.size(), 2U);
}

TEST(ground_port_words, a_late_or_doubled_answer_is_told_to_nobody) {
  port_fixture port;
  port.say(pause_command());
  port.executor_fails_to_hear("the executor does not answer");
  port.forget();
  port.executor_says(taken);
  EXPECT_EQ(port.last_result(), -1);
}

// -- several at a time ----------------------------------------------------------------------------

TEST(ground_port_words, one_word_of_each_station_is_under_way) {
  port_fixture port;
  port.say(go_to_command());
  port.say(pause_command());
  EXPECT_EQ(port.last_result(), temporarily_rejected);
  EXPECT_EQ(port.last<mavlink::command_ack>().command, 193);
  EXPECT_TRUE(port.said("Pause: another command is under way"));
  port.say(pause_command(), other_station);
  ASSERT_EQ(port.words.size(), 2U);
  EXPECT_EQ(port.words[1].what.by, "station 254/190");
}

TEST(ground_port_words, each_answer_goes_to_its_own_station) {
  port_fixture port;
  port.say(go_to_command());
  port.say(pause_command(), other_station);
  port.executor_says(answer{false, "no"}, 1);
  EXPECT_EQ(port.last<mavlink::command_ack>().target_system, other_station.system);
  EXPECT_EQ(port.last_result(), temporarily_rejected);
  port.executor_says(taken, 0);
  EXPECT_EQ(port.last<mavlink::command_ack>().target_system, station_id.system);
  EXPECT_EQ(port.last_result(), accepted);
}

TEST(ground_port_words, no_more_stations_are_waited_for_than_there_is_room) {
  port_fixture port;
  for (std::size_t i = 0; i < 2 * command_dedup::max_stations; ++i) {
    port.say(pause_command(), {static_cast<std::uint8_t>(100 + i), 190});
    port.advance(6 * s); // so that the table of stations makes room
  }
  EXPECT_EQ(port.words.size(), command_dedup::max_stations);
  EXPECT_EQ(port.last_result(), temporarily_rejected);
}

TEST(ground_port_words, a_crash_forgets_the_word_and_its_repetition_is_asked) {
  port_fixture port;
  port.say(pause_command());
  port.crash();
  port.say(pause_command());
  ASSERT_EQ(port.words.size(), 1U);
  port.executor_says(taken);
  EXPECT_EQ(port.last_result(), accepted);
}

// -- who may --------------------------------------------------------------------------------------

TEST(ground_port_words, a_word_for_another_system_or_component_is_not_ours) {
  port_fixture port;
  auto to_autopilot = go_to_command();
  to_autopilot.target_system = 1;
  to_autopilot.target_component = 1;
  port.say(to_autopilot);
  auto to_other = pause_command();
  to_other.target_system = 2;
  to_other.target_component = 191;
  port.say(to_other);
  EXPECT_TRUE(port.words.empty());
  EXPECT_EQ(port.last_result(), -1);
}

TEST(ground_port_words, only_stations_are_obeyed) {
  port_fixture port;
  port.say(pause_command(), autopilot_id);
  port.say(go_to_command(), {1, 100});
  EXPECT_TRUE(port.words.empty());
}

TEST(ground_port_words, in_the_autopilots_place_it_takes_what_is_for_the_autopilot) {
  settings in_its_place;
  in_its_place.as.component = 1;
  port_fixture port(in_its_place);
  port.say(go_to_command());
  port.executor_says(taken);
  EXPECT_EQ(port.last_result(), accepted);
  EXPECT_EQ(port.frames.back().frame.view().from(), autopilot_id);
}

TEST(ground_port_words, on_a_signed_port_only_who_has_the_key_is_obeyed) {
  std::array<std::byte, mavlink::secret_key_size> bytes{};
  bytes.fill(std::byte{7});
  const signing_settings signing{
      .key = std::make_shared<mavlink::secret_key>(bytes), .link = mavlink::link_id{2}, .unsigned_frames = {}};
  port_fixture port({}, true, signing);
  port.say(go_to_command());
  port.say(pause_command());
  EXPECT_TRUE(port.words.empty());
  EXPECT_EQ(port.last_result(), -1);
  mavlink::channel theirs(signing, mavlink::signing_time{});
  auto order = pause_command();
  order.target_system = port_id.system;
  order.target_component = port_id.component;
  port.bytes(io::link::only_peer, theirs.pack(order, station_id, port.now().wall_ns)->span());
  EXPECT_EQ(port.words.size(), 1U);
}

} // namespace core_operators_test
} // namespace godwit::ground_port
