// Several lines to one vehicle: what goes out on which of them.
//
// Sources: ArduPilot 4.7-dev (libraries/GCS_MAVLink/GCS_Common.cpp, MissionItemProtocol.cpp), PX4 1.18
// (src/modules/mavlink), and a recording of PX4 1.18 with godwit and a person on one line.
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "io/mavlink/messages/heartbeat.hpp"
#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace lines_test {

constexpr std::array every_personality{personality::rover, personality::px4, personality::ardupilot,
                                       personality::plane};
constexpr mavlink::sender companion{1, 191};
constexpr mavlink::sender person{254, 190};

// godwit is on line 0, a person on line 1. Both have sent something.
struct two_lines : vehicle_world {
  explicit two_lines(personality who) : vehicle_world(vehicle_settings{.who = who}, false), radio(add_line()) {
    send(beat_of(mavlink::mav_type::onboard_controller), companion, 0);
    send(beat_of(mavlink::mav_type::gcs), person, radio);
    run_for(7 * s);
    mark();
  }

  static mavlink::heartbeat beat_of(mavlink::mav_type what) {
    return {.type = mavlink::number(what), .autopilot = mavlink::number(mavlink::mav_autopilot::invalid)};
  }
  void command_of(mavlink::sender who, vehicle::line_number line, mav_cmd what, float param1 = 0, float param2 = 0) {
    send(mavlink::command_long{.target_system = 1,
                               .target_component = 1,
                               .command = mavlink::number(what),
                               .param1 = param1,
                               .param2 = param2},
         who, line);
  }
  template <mavlink::message M>
  [[nodiscard]] std::size_t count_on(vehicle::line_number line) const {
    return each<M>(line).size();
  }

  vehicle::line_number radio;
};

TEST(lines, each_numbers_its_own_frames_and_has_all_streams) {
  for (const auto who : every_personality) {
    two_lines world(who);
    world.run_for(10 * s);
    for (const vehicle::line_number line : {vehicle::line_number{0}, world.radio}) {
      EXPECT_EQ(world.count_on<mavlink::heartbeat>(line), 10U);
      EXPECT_NEAR(static_cast<double>(world.count_on<mavlink::mission_current>(line)), 10, 1);
      std::optional<std::uint8_t> before;
      for (const auto& each : world.all()) {
        if (each.line != line)
          continue;
        const auto sequence = mavlink::frame_view(each.bytes.data()).sequence();
        EXPECT_EQ(sequence, before ? static_cast<std::uint8_t>(*before + 1) : sequence);
        before = sequence;
      }
    }
  }
}

// GCS_MAVLINK::handle_command_long and handle_command_int answer with mavlink_msg_command_ack_send(chan, ...).
TEST(lines, ardupilot_acknowledges_a_command_on_the_line_of_who_sent_it_alone) {
  for (const auto who : {personality::ardupilot, personality::plane}) {
    two_lines world(who);
    world.command_of(person, world.radio, mav_cmd::component_arm_disarm);
    EXPECT_EQ(world.count_on<mavlink::command_ack>(world.radio), 1U);
    EXPECT_EQ(world.count_on<mavlink::command_ack>(0), 0U);
  }
}

// Mavlink::handleAndGetCurrentCommandAck sends what the commander answers where component_was_seen(target).
TEST(lines, px4_acknowledges_a_command_on_each_line_where_who_sent_it_was_heard) {
  two_lines world(personality::px4);
  world.command_of(person, world.radio, mav_cmd::component_arm_disarm);
  EXPECT_EQ(world.count_on<mavlink::command_ack>(world.radio), 1U);
  EXPECT_EQ(world.count_on<mavlink::command_ack>(0), 0U) << "the person was never heard there";
  world.send(two_lines::beat_of(mavlink::mav_type::gcs), person, 0);
  world.mark();
  world.command_of(person, world.radio, mav_cmd::component_arm_disarm);
  EXPECT_EQ(world.count_on<mavlink::command_ack>(world.radio), 1U);
  EXPECT_EQ(world.count_on<mavlink::command_ack>(0), 1U);
}

// The recording px4_118_pilot_lands: COMMAND_ACK 176 to 255/190 on the line that godwit is on.
TEST(lines, who_shares_a_line_hears_what_others_are_answered) {
  for (const auto who : every_personality) {
    two_lines world(who);
    world.command_of(person, 0, mav_cmd::component_arm_disarm);
    const auto acks = world.each<mavlink::command_ack>(0);
    ASSERT_EQ(acks.size(), 1U);
    EXPECT_EQ(acks.front().target_system, person.system);
    EXPECT_EQ(acks.front().target_component, person.component);
  }
}

// MissionItemProtocol answers on the link of the upload (link->send_message, _link.send_text); each
// MavlinkMissionManager of PX4 belongs to one line.
TEST(lines, an_upload_is_seen_on_the_line_of_who_uploads_alone) {
  for (const auto who : every_personality) {
    two_lines world(who);
    const auto plan = flight_of(2, world.home(), who);
    const auto give_what_is_asked_for = [&] {
      for (std::size_t i = 0; i < world.all().size(); ++i) {
        const auto each = world.all()[i];
        const bool asks =
            each.id == mavlink::mission_request::message_id || each.id == mavlink::mission_request_int::message_id;
        if (!asks)
          continue;
        EXPECT_EQ(each.line, world.radio);
        auto item =
            plan.at(each.id == mavlink::mission_request::message_id ? each.as<mavlink::mission_request>().seq
                                                                    : each.as<mavlink::mission_request_int>().seq);
        item.target_system = item.target_component = 1;
        world.send(item, person, world.radio);
        world.run_for(25 * ms); // the main loop of a plane
      }
    };
    world.send(mavlink::mission_count{.target_system = 1,
                                      .target_component = 1,
                                      .count = static_cast<std::uint16_t>(plan.size())},
               person, world.radio);
    world.run_for(25 * ms);
    give_what_is_asked_for();
    EXPECT_EQ(world.count_on<mavlink::mission_ack>(world.radio), 1U) << io::name_of(who);
    EXPECT_EQ(world.count_on<mavlink::mission_ack>(0), 0U);
    EXPECT_FALSE(world.said("Flight plan received", 0));
    if (who == personality::ardupilot || who == personality::plane) {
      EXPECT_TRUE(world.said("Flight plan received", world.radio));
    }
  }
}

// MavlinkStreamStatustext sends while Mavlink::is_gcs_connected: a heartbeat of type GCS was heard on this line.
TEST(lines, px4_sends_texts_on_lines_where_a_ground_station_was_heard_alone) {
  two_lines world(personality::px4);
  world.command_of(person, world.radio, mav_cmd::component_arm_disarm, 1);
  world.command_of(person, world.radio, mav_cmd::component_arm_disarm, 0);
  EXPECT_TRUE(world.said("Disarmed by external command\t", world.radio));
  EXPECT_TRUE(world.texts(0).empty()) << "an onboard computer is no ground station";
}

// GCS_SEND_TEXT goes to all.
TEST(lines, ardupilot_sends_texts_on_each_line) {
  two_lines world(personality::plane);
  world.command_of(person, world.radio, mav_cmd::component_arm_disarm, 1);
  EXPECT_TRUE(world.said("Throttle armed", world.radio));
  EXPECT_TRUE(world.said("Throttle armed", 0));
}

// send_arm_disarm_statustext stands in #if CONFIG_HAL_BOARD == HAL_BOARD_SITL in AP_Arming_Copter.cpp.
TEST(lines, a_copter_says_nothing_when_it_is_armed_or_disarmed) {
  two_lines world(personality::ardupilot);
  world.command_of(person, world.radio, mav_cmd::component_arm_disarm, 1);
  EXPECT_TRUE(world.picture().armed);
  world.command_of(person, world.radio, mav_cmd::component_arm_disarm, 0);
  EXPECT_FALSE(world.picture().armed);
  EXPECT_TRUE(world.texts().empty());
}

// In neither source does arming or disarming send a heartbeat.
TEST(lines, arming_and_disarming_are_shown_by_the_next_heartbeat_of_a_line_and_not_before) {
  for (const auto who : every_personality) {
    two_lines world(who);
    world.run_for(1 * ms);
    world.mark();
    world.command_of(person, world.radio, mav_cmd::component_arm_disarm, 1);
    ASSERT_TRUE(world.picture().armed) << io::name_of(who);
    EXPECT_EQ(world.count_on<mavlink::heartbeat>(0), 0U);
    world.run_for(1 * s);
    const auto beats = world.each<mavlink::heartbeat>(0);
    ASSERT_EQ(beats.size(), 1U);
    EXPECT_NE(beats.front().base_mode & 128U, 0U);
  }
}

// Copter, Plane and Rover: gcs().send_message(MSG_HEARTBEAT) in set_mode. PX4 has nothing of the kind.
TEST(lines, a_mode_is_shown_on_each_line_at_once_by_ardupilot_and_with_the_next_heartbeat_by_others) {
  for (const auto who : every_personality) {
    two_lines world(who);
    world.run_for(1 * ms);
    world.mark();
    world.command_of(person, world.radio, mav_cmd::nav_return_to_launch);
    const bool beats = who == personality::ardupilot || who == personality::plane;
    for (const vehicle::line_number line : {vehicle::line_number{0}, world.radio})
      EXPECT_EQ(world.count_on<mavlink::heartbeat>(line), beats ? 1U : 0U) << io::name_of(who);
  }
}

// ArduPilot: MSG_HEARTBEAT stands in the map of mavlink_id_to_ap_message_id, and each GCS_MAVLINK has its intervals.
// PX4: HEARTBEAT is a stream of each Mavlink instance, and configure_stream sets its rate.
TEST(lines, a_heartbeat_comes_at_the_interval_that_was_asked_for_on_its_line_alone) {
  for (const auto who : every_personality) {
    two_lines world(who);
    world.command_of(companion, 0, mav_cmd::set_message_interval, 0, 200'000);
    EXPECT_EQ(world.each<mavlink::command_ack>(0).back().result, mavlink::number(mav_result::accepted));
    world.mark();
    world.run_for(10 * s);
    EXPECT_NEAR(static_cast<double>(world.count_on<mavlink::heartbeat>(0)), 50, 1) << io::name_of(who);
    EXPECT_EQ(world.count_on<mavlink::heartbeat>(world.radio), 10U);
    world.command_of(companion, 0, mav_cmd::set_message_interval, 0, 0);
    world.run_for(1 * s);
    world.mark();
    world.run_for(10 * s);
    EXPECT_EQ(world.count_on<mavlink::heartbeat>(0), 10U) << "and as before, when it is put back";
  }
}

// ArduPilot: handle_command_request_message queues it, the answer goes out first. PX4: handle_request_message_command
// sends it before the answer.
TEST(lines, a_heartbeat_that_is_requested_comes_on_that_line_alone) {
  for (const auto who : every_personality) {
    two_lines world(who);
    world.run_for(1 * ms);
    world.mark();
    const auto before = world.all().size();
    world.command_of(companion, 0, mav_cmd::request_message, 0);
    EXPECT_EQ(world.count_on<mavlink::heartbeat>(0), 1U) << io::name_of(who);
    EXPECT_EQ(world.count_on<mavlink::heartbeat>(world.radio), 0U);
    ASSERT_EQ(world.all().size(), before + 2);
    const auto first = who == personality::px4 ? mavlink::heartbeat::message_id : mavlink::command_ack::message_id;
    EXPECT_EQ(world.all()[before].id, first);
  }
}

TEST(lines, what_was_asked_for_is_forgotten_with_a_restart_on_each_line) {
  two_lines world(personality::ardupilot);
  world.command_of(companion, 0, mav_cmd::set_message_interval, 0, 200'000);
  world.subject().reboot(world.now_ns());
  world.run_for(10 * s);
  world.mark();
  world.run_for(10 * s);
  EXPECT_EQ(world.count_on<mavlink::heartbeat>(0), 10U);
  EXPECT_EQ(world.count_on<mavlink::heartbeat>(world.radio), 10U);
}

TEST(lines, two_vehicles_on_one_line_take_what_is_for_them) {
  vehicle_world first(vehicle_settings{.who = personality::ardupilot, .system = 1});
  vehicle_world second(vehicle_settings{.who = personality::ardupilot, .system = 2});
  const auto send_to_both = [&](const mavlink::command_long& what) {
    first.send(what);
    second.send(what);
  };
  first.run_for(7 * s);
  second.run_for(7 * s);
  send_to_both({.target_system = 2, .target_component = 1, .command = 400, .param1 = 1});
  EXPECT_FALSE(first.picture().armed);
  EXPECT_TRUE(second.picture().armed);
}

} // namespace lines_test
} // namespace godwit::sim::test
