#include "programs/godwit-sim/vehicle/vehicle.hpp"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace vehicle_test {

constexpr std::array every_personality{personality::rover, personality::px4, personality::ardupilot,
                                       personality::plane};

std::map<std::uint32_t, int> counted(const vehicle_world& world, std::int64_t from_ns) {
  std::map<std::uint32_t, int> result;
  for (const auto& each : world.all())
    if (each.at_ns > from_ns)
      ++result[each.id];
  return result;
}

// -- streams and time -------------------------------------------------------------------------------

TEST(vehicle, sends_a_heartbeat_each_second_whatever_it_is) {
  for (const auto who : every_personality) {
    vehicle_world world(who);
    world.run_for(10 * s);
    EXPECT_EQ(world.each<mavlink::heartbeat>().size(), 10U);
  }
}

TEST(vehicle, px4_streams_at_the_rates_that_were_recorded) {
  vehicle_world world(personality::px4);
  world.run_for(5 * s);
  const auto from_ns = world.now_ns();
  world.run_for(20 * s);
  const auto counts = counted(world, from_ns);
  const std::map<std::uint32_t, int> expected{{mavlink::heartbeat::message_id, 20},
                                              {mavlink::sys_status::message_id, 20},
                                              {mavlink::ping::message_id, 2},
                                              {mavlink::gps_raw_int::message_id, 100},
                                              {mavlink::attitude::message_id, 1'000},
                                              {mavlink::global_position_int::message_id, 1'000},
                                              {mavlink::mission_current::message_id, 20},
                                              {mavlink::vfr_hud::message_id, 80},
                                              {mavlink::battery_status::message_id, 10},
                                              {mavlink::estimator_status::message_id, 10},
                                              {mavlink::home_position::message_id, 10},
                                              {mavlink::extended_sys_state::message_id, 20},
                                              {436, 10}};
  EXPECT_EQ(counts, expected);
}

TEST(vehicle, says_what_it_is_made_to_say) {
  vehicle_world world(personality::ardupilot);
  world.run_for(2 * s);
  const std::string text = "PreArm: <img src=x onerror=alert(1)>";
  EXPECT_EQ(std::ranges::count(world.texts(), text), 0);
  world.subject().say(text, world.now_ns());
  world.run_for(1 * s);
  EXPECT_EQ(std::ranges::count(world.texts(), text), 1);
}

TEST(vehicle, streams_faster_by_its_factor_but_for_the_heartbeat) {
  vehicle_world world(vehicle_settings{.who = personality::ardupilot, .stream_factor = 4});
  world.run_for(10 * s);
  EXPECT_NEAR(static_cast<double>(world.each<mavlink::attitude>().size()), 40, 1);
  EXPECT_EQ(world.each<mavlink::heartbeat>().size(), 10U);
}

TEST(vehicle, at_rest_is_woken_for_its_streams_alone) {
  vehicle_world world(personality::ardupilot);
  world.beat(false);
  world.run_for(2 * s);
  const auto before = world.wakes();
  world.run_for(100 * s);
  EXPECT_LE(world.wakes() - before, 220) << "once a second for its streams, and once for MISSION_CURRENT";
}

TEST(vehicle, speaks_with_its_own_system_and_numbers_its_frames) {
  vehicle_world world(vehicle_settings{.who = personality::rover, .system = 42});
  world.run_for(5 * s);
  std::uint8_t sequence = 0;
  for (const auto& each : world.all()) {
    const mavlink::frame_view frame(each.bytes.data());
    EXPECT_EQ(frame.from(), (mavlink::sender{42, 1}));
    EXPECT_EQ(frame.sequence(), sequence++);
  }
}

TEST(vehicle, runs_the_world_faster_and_the_patience_of_transfers_not) {
  vehicle_world world(vehicle_settings{.who = personality::px4, .speed = 20});
  world.run_for(1 * s);
  world.mark();
  world.send(mavlink::mission_count{.target_system = 1, .target_component = 1, .count = 3});
  world.run_for(1 * s);
  EXPECT_EQ(world.each<mavlink::mission_request_int>().size(), 4U) << "at once, and each 0.26 s";
  EXPECT_EQ(world.each<mavlink::heartbeat>().size(), 20U);
}

TEST(vehicle, drains_its_battery_in_the_air) {
  vehicle_world world(vehicle_settings{.who = personality::px4, .endurance_s = 100});
  ASSERT_EQ(world.upload(flight_of(3, world.home(), personality::px4)), mav_mission_result::accepted);
  ASSERT_EQ(world.command(mav_cmd::mission_start), mav_result::accepted);
  world.run_for(15 * s);
  EXPECT_LT(world.picture().battery_percent, 92);
  EXPECT_NEAR(world.last<mavlink::sys_status>()->battery_remaining, world.picture().battery_percent, 2);
}

// -- who is spoken to -------------------------------------------------------------------------------

TEST(vehicle, hears_commands_to_other_components_as_its_autopilot_does) {
  const auto is_answered = [](personality who, std::uint8_t system, std::uint8_t component) {
    vehicle_world world(who);
    world.send(mavlink::command_long{.target_system = system, .target_component = component, .command = 31'999});
    return !world.each<mavlink::command_ack>().empty();
  };
  for (const auto who : every_personality) {
    EXPECT_TRUE(is_answered(who, 1, 1));
    EXPECT_TRUE(is_answered(who, 1, 0));
    EXPECT_FALSE(is_answered(who, 77, 1));
  }
  EXPECT_TRUE(is_answered(personality::ardupilot, 1, 55));
  EXPECT_FALSE(is_answered(personality::px4, 1, 55));
  EXPECT_FALSE(is_answered(personality::rover, 1, 55));
}

TEST(vehicle, does_not_hear_itself) {
  vehicle_world world(personality::px4);
  world.send(mavlink::command_long{.target_system = 1, .target_component = 1, .command = 31'999}, vehicle_id);
  EXPECT_TRUE(world.each<mavlink::command_ack>().empty());
}

TEST(vehicle, answers_the_one_who_asked) {
  vehicle_world world(personality::rover);
  world.send(mavlink::command_long{.target_system = 1, .target_component = 1, .command = 31'999}, {7, 8});
  const auto ack = *world.last<mavlink::command_ack>();
  EXPECT_EQ(ack.target_system, 7);
  EXPECT_EQ(ack.target_component, 8);
}

TEST(vehicle, answers_ping_and_timesync_as_its_autopilot_does) {
  const auto asked = [](personality who) {
    auto world = std::make_unique<vehicle_world>(who);
    world->run_for(2 * s);
    world->mark();
    world->send(mavlink::ping{.time_usec = 5, .seq = 7});
    world->send(mavlink::timesync{.tc1 = 0, .ts1 = 99});
    return world;
  };
  const auto px4 = asked(personality::px4);
  ASSERT_EQ(px4->each<mavlink::ping>().size(), 1U);
  EXPECT_EQ(px4->each<mavlink::ping>().front().target_system, station_id.system);
  EXPECT_EQ(px4->each<mavlink::timesync>().front().target_component, 255);
  const auto ardupilot = asked(personality::ardupilot);
  EXPECT_TRUE(ardupilot->each<mavlink::ping>().empty());
  EXPECT_EQ(ardupilot->each<mavlink::timesync>().front().target_system, 0);
  const auto rover = asked(personality::rover);
  EXPECT_EQ(rover->each<mavlink::timesync>().front().target_component, station_id.component);
  EXPECT_EQ(rover->each<mavlink::timesync>().front().ts1, 99);
}

TEST(vehicle, gives_its_parameters_and_takes_new_values) {
  for (const auto who : every_personality) {
    vehicle_world world(who);
    world.send(mavlink::param_request_list{1, 1});
    world.run_for(1 * s);
    const auto all = world.each<mavlink::param_value>();
    ASSERT_FALSE(all.empty());
    ASSERT_EQ(all.size(), all.front().param_count);
    world.mark();
    world.send(mavlink::param_request_read{1, 1, {'N', 'O', 'N', 'E'}, -1});
    EXPECT_TRUE(world.each<mavlink::param_value>().empty()) << "an unknown one: silence";
    auto wanted = all[3];
    world.send(mavlink::param_set{1, 1, wanted.param_id, wanted.param_value, wanted.param_type});
    ASSERT_EQ(world.each<mavlink::param_value>().size(), 1U);
    EXPECT_EQ(world.last<mavlink::param_value>()->param_id, wanted.param_id);
  }
}

TEST(vehicle, has_its_own_system_id_among_its_parameters) {
  vehicle_world world(vehicle_settings{.who = personality::ardupilot, .system = 42});
  world.send(mavlink::param_request_read{42, 1, {'M', 'A', 'V', '_', 'S', 'Y', 'S', 'I', 'D'}, -1});
  ASSERT_EQ(world.each<mavlink::param_value>().size(), 1U);
  EXPECT_EQ(world.last<mavlink::param_value>()->param_value, 42);
}

TEST(vehicle, keeps_a_fence_whose_breach_does_nothing) {
  for (const auto who : every_personality) {
    vehicle_world world(who);
    plan fence;
    for (const auto& [north, east] : {std::pair(5.0, 5.0), {5.0, -5.0}, {-5.0, -5.0}, {-5.0, 5.0}}) {
      fence.push_back(item_at(mav_cmd::nav_fence_polygon_vertex_inclusion, world.home(), {north, east, 0}));
      fence.back().frame = 0;
      fence.back().param1 = 4;
    }
    ASSERT_EQ(world.upload(fence, mav_mission_type::fence), mav_mission_result::accepted);
    EXPECT_EQ(world.download(mav_mission_type::fence)->size(), 4U);
    world.run_for(1 * s);
    const bool has_id = world.last<mavlink::mission_current>()->fence_id != 0;
    EXPECT_EQ(has_id, who != personality::ardupilot && who != personality::plane);
  }
}

// -- faults -----------------------------------------------------------------------------------------

TEST(vehicle, refuses_commands_on_demand_so_many_times) {
  for (const auto who : every_personality) {
    vehicle_world world(who);
    world.subject().refuse_command(31'999, mavlink::number(mav_result::denied), 2);
    EXPECT_EQ(world.command(31'999), mav_result::denied);
    EXPECT_EQ(world.command(31'999), mav_result::denied);
    EXPECT_EQ(world.command(31'999), mav_result::unsupported);
    world.subject().refuse_command(31'999, mavlink::number(mav_result::denied), -1);
    for (int i = 0; i < 10; ++i)
      EXPECT_EQ(world.command(31'999), mav_result::denied);
    world.subject().refuse_command(31'999, 0, 0);
    EXPECT_EQ(world.command(31'999), mav_result::unsupported);
  }
}

TEST(vehicle, after_a_restart_in_flight_stands_on_the_ground_disarmed_and_its_clock_is_back) {
  for (const auto who : every_personality) {
    vehicle_world world(who);
    ASSERT_EQ(world.upload(flight_of(3, world.home(), who)), mav_mission_result::accepted);
    ASSERT_TRUE(world.make_ready());
    ASSERT_EQ(world.command(mav_cmd::mission_start), mav_result::accepted);
    world.run_for(20 * s);
    const auto before_ms = world.last<mavlink::attitude>()->time_boot_ms;
    const auto restarted_ns = world.now_ns();
    world.subject().reboot(world.now_ns());
    EXPECT_EQ(world.command(31'999), std::nullopt) << "nobody is there";
    world.run_for(2'999 * ms);
    EXPECT_TRUE(counted(world, restarted_ns).empty());
    world.run_for(6 * s);
    EXPECT_LT(world.last<mavlink::attitude>()->time_boot_ms, before_ms);
    EXPECT_FALSE(world.picture().armed);
    EXPECT_FALSE(world.picture().in_air);
    EXPECT_EQ(world.picture().mission_state, "idle");
    EXPECT_GT(world.picture().mission_count, 0);
  }
}

// ArduCopter 4.7: BOOT, STABILIZE, disarmed from its first frame on, STANDBY 2 s later; PX4 1.17: UNINIT for 3 s.
TEST(vehicle, its_first_words_after_a_restart_are_heartbeats_that_say_so) {
  for (const auto& [who, how] : {std::pair{personality::ardupilot, mavlink::mav_state::boot},
                                 std::pair{personality::px4, mavlink::mav_state::uninit}}) {
    vehicle_world world(who);
    world.run_for(20 * s);
    world.subject().reboot(world.now_ns());
    world.run_for(2'990 * ms);
    world.mark();
    world.run_for(1'500 * ms);
    const auto beats = world.each<mavlink::heartbeat>();
    ASSERT_FALSE(beats.empty());
    EXPECT_EQ(beats.front().system_status, mavlink::number(how));
    EXPECT_TRUE(world.each<mavlink::attitude>().empty());
    world.run_for(4 * s);
    EXPECT_EQ(world.last<mavlink::heartbeat>()->system_status, mavlink::number(mavlink::mav_state::standby));
    EXPECT_FALSE(world.each<mavlink::attitude>().empty());
  }
}

TEST(vehicle, forgets_asked_for_intervals_when_it_starts_again) {
  vehicle_world world(personality::ardupilot);
  ASSERT_EQ(world.command(mav_cmd::set_message_interval, {.p1 = 30, .p2 = 20'000}), mav_result::accepted);
  world.subject().reboot(world.now_ns());
  world.run_for(6 * s);
  world.mark();
  world.run_for(10 * s);
  EXPECT_EQ(world.each<mavlink::attitude>().size(), 10U);
}

TEST(vehicle, with_a_new_battery_flies_again) {
  vehicle_world world(personality::px4);
  ASSERT_EQ(world.upload(flight_of(1, world.home(), personality::px4)), mav_mission_result::accepted);
  world.subject().set_battery(0, world.now_ns());
  EXPECT_EQ(world.command(mav_cmd::mission_start), mav_result::temporarily_rejected);
  world.subject().set_battery(80, world.now_ns());
  EXPECT_EQ(world.command(mav_cmd::mission_start), mav_result::accepted);
}

} // namespace vehicle_test
} // namespace godwit::sim::test
