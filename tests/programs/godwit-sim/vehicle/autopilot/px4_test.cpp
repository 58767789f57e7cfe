#include "programs/godwit-sim/vehicle/autopilot/px4.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <span>

#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace px4_test {

// DO_SET_MODE: main and sub mode.
constexpr order_params loiter_mode{.p1 = 1, .p2 = 4, .p3 = 3};
constexpr order_params mission_mode{.p1 = 1, .p2 = 4, .p3 = 4};

class px4_with : public vehicle_world {
public:
  explicit px4_with(int waypoints, std::uint64_t seed = 1, double speed = 1)
      : vehicle_world(vehicle_settings{.who = personality::px4, .speed = speed, .seed = seed}) {
    const auto uploaded = waypoints > 0 ? upload(flight(waypoints)) : mav_mission_result::accepted;
    EXPECT_EQ(uploaded, mav_mission_result::accepted);
    run_for(2 * s);
    mark();
  }
  // Take-off, waypoints, landing; ground stations mark the first item.
  [[nodiscard]] plan flight(int waypoints, std::optional<int> marked = 0) const {
    auto items = flight_of(waypoints, home(), personality::px4);
    if (marked)
      items.at(static_cast<std::size_t>(*marked)).current = 1;
    return items;
  }
  std::optional<mav_result> start(float first = 0, float last = 0) {
    return command(mav_cmd::mission_start, {.p1 = first, .p2 = last});
  }
  [[nodiscard]] mavlink::mission_current current() const { return *last<mavlink::mission_current>(); }
  // In the air, on the way to item SEQUENCE.
  [[nodiscard]] bool fly_to(int sequence) {
    return start() == mav_result::accepted && run_until([&] { return picture().mission_current == sequence; }, 200 * s);
  }
  void set_current(int seq) { send(mavlink::mission_set_current{1, 1, static_cast<std::uint16_t>(seq)}); }
};

TEST(px4, arms_on_mission_start) {
  px4_with world(2);
  ASSERT_EQ(world.start(), mav_result::accepted);
  EXPECT_TRUE(world.picture().armed);
  EXPECT_EQ(world.picture().mode, "AUTO.MISSION");
  world.run_for(1 * s);
  const auto beat = *world.last<mavlink::heartbeat>();
  EXPECT_EQ(beat.base_mode, 157);
  EXPECT_EQ(beat.custom_mode, 0x4040000U);
  EXPECT_EQ(beat.system_status, mavlink::number(mavlink::mav_state::active));
}

// PX4 1.17: armed at 27.73, disarmed by command 0.5 s after it before; "Takeoff detected" at 29.47.
TEST(px4, stands_for_1_8_s_after_a_start_while_its_rotors_spin_up_and_can_be_disarmed_then) {
  px4_with world(2);
  ASSERT_EQ(world.start(), mav_result::accepted);
  world.run_for(1'500 * ms);
  EXPECT_FALSE(world.picture().in_air);
  EXPECT_EQ(world.command(mav_cmd::component_arm_disarm), mav_result::accepted);
  ASSERT_EQ(world.start(), mav_result::accepted);
  world.run_for(2'500 * ms);
  EXPECT_TRUE(world.picture().in_air);
  EXPECT_EQ(world.command(mav_cmd::component_arm_disarm), mav_result::temporarily_rejected);
}

TEST(px4, denies_mission_start_with_first_5_last_2) { EXPECT_EQ(px4_with(6).start(5, 2), mav_result::denied); }

TEST(px4, denies_mission_start_without_a_mission_or_beyond_it) {
  EXPECT_EQ(px4_with(0).start(), mav_result::denied);
  EXPECT_EQ(px4_with(2).start(4), mav_result::denied);
  EXPECT_EQ(px4_with(2).start(-2), mav_result::denied);
}

TEST(px4, starts_at_the_first_item_that_mission_start_names_whatever_was_current) {
  px4_with world(2);
  world.set_current(2);
  ASSERT_EQ(world.start(), mav_result::accepted);
  EXPECT_EQ(world.picture().mission_current, 0);
}

TEST(px4, does_not_know_do_set_mission_current) {
  EXPECT_EQ(px4_with(2).command(mav_cmd::do_set_mission_current, {.p1 = 1}), mav_result::unsupported);
}

TEST(px4, repeats_a_reached_item_each_second_until_the_next_and_ten_times_at_most) {
  px4_with world(2);
  ASSERT_EQ(world.start(), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 200 * s));
  world.mark();
  world.run_for(20 * s);
  const auto repeated = world.reached();
  EXPECT_EQ(repeated.size(), 10U);
  EXPECT_EQ(std::set<int>(repeated.begin(), repeated.end()), std::set<int>{3});
}

TEST(px4, tells_the_current_item_each_second_and_on_change) {
  px4_with world(2);
  world.run_for(10 * s);
  EXPECT_EQ(world.each<mavlink::mission_current>().size(), 10U);
  world.set_current(1);
  ASSERT_TRUE(world.run_until([&] { return world.current().seq == 1; }, 100 * ms));
}

TEST(px4, says_that_there_is_no_mission_by_total_65535_and_state_1) {
  px4_with world(0);
  EXPECT_EQ(world.current().total, 65535);
  EXPECT_EQ(world.current().mission_state, mavlink::number(mavlink::mission_state::no_mission));
  EXPECT_EQ(world.current().mission_id, 0U);
}

TEST(px4, fails_to_set_the_interval_of_mission_current_and_denies_to_send_it) {
  px4_with world(2);
  EXPECT_EQ(world.command(mav_cmd::set_message_interval, {.p1 = 42, .p2 = 200'000}), mav_result::failed);
  EXPECT_EQ(world.command(mav_cmd::request_message, {.p1 = 42}), mav_result::denied);
}

TEST(px4, sends_the_message_before_the_acknowledgement) {
  px4_with world(0);
  world.mark();
  const auto from = world.all().size();
  ASSERT_EQ(world.command(mav_cmd::request_message, {.p1 = 148}), mav_result::accepted);
  ASSERT_GE(world.all().size(), from + 2);
  EXPECT_EQ(world.all()[from].id, mavlink::autopilot_version::message_id);
  EXPECT_EQ(world.all()[from + 1].id, mavlink::command_ack::message_id);
}

TEST(px4, holds_its_texts_back_until_it_has_heard_a_heartbeat) {
  vehicle_world world(vehicle_settings{.who = personality::px4});
  world.subject().reboot(world.now_ns());
  world.beat(false);
  world.run_for(5 * s);
  ASSERT_EQ(world.command(mav_cmd::component_arm_disarm, {.p1 = 1}), mav_result::accepted);
  ASSERT_EQ(world.command(mav_cmd::component_arm_disarm), mav_result::accepted);
  world.run_for(5 * s);
  EXPECT_TRUE(world.texts().empty());
  world.send(mavlink::heartbeat{.type = 6});
  EXPECT_EQ(world.texts(), (std::vector<std::string>{"Armed by external command\t", "Disarmed by external command\t"}));
}

TEST(px4, says_that_the_station_is_back_after_a_silence) {
  px4_with world(0);
  world.beat(false);
  world.run_for(12 * s);
  world.beat(true);
  world.run_for(10 * ms);
  EXPECT_TRUE(world.said("GCS connection regained\t"));
}

TEST(px4, may_tell_old_news_just_after_a_plan_was_replaced) {
  std::set<std::string> seen;
  for (std::uint64_t seed = 1; seed <= 64; ++seed) {
    px4_with world(3, seed);
    ASSERT_TRUE(world.fly_to(2));
    world.mark();
    const auto reached_before = world.reached().size();
    ASSERT_EQ(world.upload(world.flight(4, 4)), mav_mission_result::accepted);
    world.run_for(30 * ms);
    const auto id = world.picture().mission_id;
    for (const auto& each : world.each<mavlink::mission_current>()) {
      if (each.mission_id != id)
        continue;
      if (each.seq == 2)
        seen.insert("the new id with the old sequence");
      if (each.seq == 65535)
        seen.insert("the new id with sequence 65535");
    }
    if (world.reached().size() > reached_before)
      seen.insert("an item of the old plan");
    if (world.each<mavlink::mission_current>().size() == 1 && world.reached().size() == reached_before)
      seen.insert("nothing old");
    EXPECT_EQ(world.current().seq, 4) << "in the end it is true; seed " << seed;
  }
  EXPECT_EQ(seen, (std::set<std::string>{"the new id with the old sequence", "the new id with sequence 65535",
                                         "an item of the old plan", "nothing old"}));
}

TEST(px4, forgets_the_last_reached_item_when_a_count_arrives) {
  px4_with world(3);
  ASSERT_TRUE(world.fly_to(2));
  world.mark();
  world.send(mavlink::mission_count{.target_system = 1, .target_component = 1, .count = 5});
  world.run_for(2'500 * ms);
  EXPECT_TRUE(world.reached().empty());
}

TEST(px4, goes_on_at_the_old_index_with_a_plan_that_marks_none) {
  px4_with world(3);
  ASSERT_TRUE(world.fly_to(2));
  ASSERT_EQ(world.upload(world.flight(5, std::nullopt)), mav_mission_result::accepted);
  EXPECT_EQ(world.picture().mission_current, 2);
  EXPECT_EQ(world.picture().mission_state, "running");
}

TEST(px4, goes_to_the_marked_item_of_a_new_plan) {
  px4_with world(3);
  ASSERT_TRUE(world.fly_to(2));
  ASSERT_EQ(world.upload(world.flight(5, 1)), mav_mission_result::accepted);
  EXPECT_EQ(world.picture().mission_current, 1);
  EXPECT_EQ(world.picture().mission_state, "running");
}

TEST(px4, does_not_activate_a_plan_that_it_holds_already) {
  px4_with world(3);
  ASSERT_TRUE(world.fly_to(2));
  const auto id = world.picture().mission_id;
  ASSERT_EQ(world.upload(world.flight(3, 1)), mav_mission_result::accepted);
  EXPECT_EQ(world.picture().mission_id, id);
  EXPECT_EQ(world.picture().mission_current, 2);
  world.set_current(1);
  EXPECT_EQ(world.picture().mission_current, 1);
}

TEST(px4, marks_the_current_item_in_what_it_gives_back) {
  px4_with world(3);
  world.set_current(2);
  const auto back = world.download();
  ASSERT_TRUE(back);
  for (const auto& each : *back)
    EXPECT_EQ(each.current, each.seq == 2 ? 1 : 0);
}

TEST(px4, ends_its_mission_at_the_last_item_landed_and_disarmed) {
  px4_with world(2);
  ASSERT_EQ(world.start(), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 200 * s));
  world.run_for(1 * s);
  EXPECT_EQ(world.current().seq, 3);
  EXPECT_EQ(world.current().mission_state, mavlink::number(mavlink::mission_state::complete));
  EXPECT_EQ(world.current().mission_mode, mavlink::number(mavlink::mission_mode::active));
  EXPECT_EQ(world.texts(),
            (std::vector<std::string>{"Armed by mission start\t", "Executing Mission\t",
                                      "Climb to 10.0 meters above home\t", "Takeoff detected\t", "Landing detected\t",
                                      "Mission finished, landed\t", "Disarmed by landing\t"}));
  EXPECT_EQ(world.last<mavlink::heartbeat>()->base_mode, 29);
}

TEST(px4, loiters_after_a_mission_that_ends_in_the_air) {
  px4_with world(0);
  auto items = flight_of(1, world.home(), personality::px4);
  items.pop_back();
  ASSERT_EQ(world.upload(items), mav_mission_result::accepted);
  ASSERT_EQ(world.start(), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_state == "completed"; }, 100 * s));
  EXPECT_EQ(world.picture().mode, "AUTO.LOITER");
  EXPECT_TRUE(world.picture().in_air);
  EXPECT_EQ(world.command(mav_cmd::component_arm_disarm), mav_result::temporarily_rejected);
}

TEST(px4, asks_everybody_of_its_system_to_stop_triggering_a_camera_at_the_end_of_a_mission) {
  px4_with world(1);
  ASSERT_EQ(world.start(), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 200 * s));
  world.run_for(2 * s);
  const auto asked = world.each<mavlink::command_long>();
  ASSERT_EQ(asked.size(), 2U);
  EXPECT_EQ(asked[0].command, 2003);
  EXPECT_EQ(asked[0].target_component, 0);
  EXPECT_EQ(asked[1].confirmation, 1);
}

TEST(px4, accepts_a_mode_that_does_not_exist_and_says_so_twice) {
  px4_with world(0);
  world.mark();
  const auto mode = world.picture().mode;
  EXPECT_EQ(world.command(mav_cmd::do_set_mode, {.p1 = 1, .p2 = 99}), mav_result::accepted);
  EXPECT_EQ(world.each<mavlink::command_ack>().size(), 2U);
  EXPECT_EQ(world.picture().mode, mode);
}

// PX4 1.17: at each DO_SET_MODE ACCEPTED at once, and what its commander makes of it 1 to 8 ms later. In flight without
// sticks: ACK 0 to POSCTL, "Switching to Position is currently not available", and it stays in HOLD.
TEST(px4, accepts_a_mode_before_it_refuses_it_as_one_that_needs_sticks_and_there_are_none) {
  vehicle_world world(vehicle_settings{.who = personality::px4, .has_sticks = false});
  ASSERT_EQ(world.upload(flight_of(2, world.home(), personality::px4)), mav_mission_result::accepted);
  ASSERT_EQ(world.command(mav_cmd::mission_start), mav_result::accepted);
  world.run_for(5 * s);
  const auto answers_to = [&](const order_params& mode) {
    world.mark();
    static_cast<void>(world.command(mav_cmd::do_set_mode, mode));
    std::vector<int> results;
    for (const auto& each : world.each<mavlink::command_ack>())
      results.push_back(each.result);
    return results;
  };
  EXPECT_EQ(answers_to(loiter_mode), (std::vector{0, 0}));
  EXPECT_EQ(answers_to({.p1 = 1, .p2 = 3}), (std::vector{0, 1}));
  EXPECT_EQ(world.picture().mode, "AUTO.LOITER");
}

TEST(px4, pauses_in_loiter_and_goes_on_in_mission) {
  px4_with world(3);
  ASSERT_TRUE(world.fly_to(2));
  ASSERT_EQ(world.command(mav_cmd::do_set_mode, loiter_mode), mav_result::accepted);
  world.run_for(5 * s);
  EXPECT_EQ(world.current().mission_state, mavlink::number(mavlink::mission_state::paused));
  EXPECT_EQ(world.current().mission_mode, mavlink::number(mavlink::mission_mode::suspended));
  EXPECT_EQ(world.current().seq, 2);
  ASSERT_EQ(world.command(mav_cmd::do_set_mode, mission_mode), mav_result::accepted);
  EXPECT_TRUE(world.run_until([&] { return !world.picture().armed; }, 200 * s));
}

TEST(px4, begins_its_mission_when_it_is_armed_in_mission_mode) {
  px4_with world(2);
  ASSERT_EQ(world.command(mav_cmd::do_set_mode, mission_mode), mav_result::accepted);
  EXPECT_EQ(world.picture().mission_state, "idle");
  ASSERT_TRUE(world.make_ready());
  EXPECT_EQ(world.picture().mission_state, "running");
}

TEST(px4, flies_its_mission_again_after_it_has_landed) {
  px4_with world(1);
  for (int flight = 0; flight < 2; ++flight) {
    ASSERT_EQ(world.start(), mav_result::accepted);
    ASSERT_TRUE(world.run_until([&] { return world.picture().in_air; }, 20 * s));
    ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 200 * s));
  }
}

TEST(px4, disarms_itself_when_it_does_not_take_off) {
  for (const double speed : {1.0, 10.0}) { // who is to tell it to take off is not faster in a faster world
    px4_with world(0, 1, speed);
    ASSERT_TRUE(world.make_ready());
    world.run_for(9 * s);
    EXPECT_TRUE(world.picture().armed);
    world.run_for(2 * s);
    EXPECT_FALSE(world.picture().armed);
    EXPECT_TRUE(world.said("Disarmed by auto preflight disarming\t"));
  }
}

TEST(px4, takes_off_goes_comes_back_and_lands_by_command) {
  px4_with world(0);
  ASSERT_TRUE(world.make_ready());
  const auto height = [&] { return world.picture().where.altitude_m - world.home().altitude_m; };
  ASSERT_EQ(world.command(mav_cmd::nav_takeoff, {.p7 = static_cast<float>(world.home().altitude_m) + 12}),
            mav_result::accepted);
  EXPECT_EQ(world.picture().mode, "AUTO.TAKEOFF");
  ASSERT_TRUE(world.run_until([&] { return world.picture().mode == "AUTO.LOITER"; }, 30 * s));
  EXPECT_NEAR(height(), 12, 0.5);
  const auto there = item_at(mav_cmd::nav_waypoint, world.home(), {30, 0, 0});
  ASSERT_EQ(world.command_int(mav_cmd::do_reposition,
                              {.frame = 3, .param1 = -1, .param2 = 1, .x = there.x, .y = there.y, .z = 15}),
            mav_result::accepted);
  world.run_for(20 * s);
  EXPECT_NEAR(between(world.picture().where, world.home()).distance_m, 30, 1);
  EXPECT_NEAR(height(), 15, 0.5);
  ASSERT_EQ(world.command(mav_cmd::nav_return_to_launch), mav_result::accepted);
  EXPECT_EQ(world.picture().mode, "AUTO.RTL");
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 100 * s));
  EXPECT_LT(between(world.picture().where, world.home()).distance_m, 2);
}

// captures/px4_118_return.tlog: reached and complete come as the return begins.
TEST(px4, has_reached_its_return_and_completed_its_mission_as_that_begins) {
  px4_with world(0);
  ASSERT_EQ(world.upload(with_return(flight_of(1, world.home(), personality::px4))), mav_mission_result::accepted);
  ASSERT_EQ(world.start(), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mode == "AUTO.RTL"; }, 100 * s));
  EXPECT_EQ(world.current().seq, 2);
  EXPECT_EQ(world.current().mission_state, mavlink::number(mavlink::mission_state::complete));
  EXPECT_EQ(world.last<mavlink::mission_item_reached>()->seq, 2);
  EXPECT_TRUE(world.picture().in_air);
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 100 * s));
  EXPECT_LT(between(world.picture().where, world.home()).distance_m, 2);
  EXPECT_EQ(world.picture().mode, "AUTO.LOITER");
}

TEST(px4, holds_when_it_is_sent_back_into_a_mission_that_is_finished) {
  px4_with world(0);
  ASSERT_EQ(world.upload(with_return(flight_of(1, world.home(), personality::px4))), mav_mission_result::accepted);
  ASSERT_EQ(world.start(), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mode == "AUTO.RTL"; }, 100 * s));
  ASSERT_EQ(world.command(mav_cmd::do_set_mode, mission_mode), mav_result::accepted);
  EXPECT_EQ(world.picture().mode, "AUTO.MISSION");
  world.run_for(s / 2);
  EXPECT_EQ(world.picture().mode, "AUTO.LOITER");
  world.set_current(1);
  ASSERT_EQ(world.command(mav_cmd::do_set_mode, mission_mode), mav_result::accepted);
  world.run_for(2 * s);
  EXPECT_NE(world.picture().mode, "AUTO.LOITER") << "it was told where to go on";
}

TEST(px4, takes_a_plan_that_leads_beyond_its_limit_and_refuses_to_fly_it) {
  px4_with world(0);
  world.subject().limit_distance(1);
  ASSERT_EQ(world.upload(flight_of(3, world.home(), personality::px4)), mav_mission_result::accepted);
  world.run_for(2 * s);
  EXPECT_EQ(world.current().mission_state, mavlink::number(mavlink::mission_state::no_mission));
  EXPECT_NE(world.current().mission_id, 0U);
  EXPECT_EQ(world.current().total, 5);
  EXPECT_EQ(world.start(), mav_result::denied);
  world.subject().limit_distance(0);
  ASSERT_EQ(world.upload(flight_of(3, world.home(), personality::px4)), mav_mission_result::accepted);
  world.run_for(2 * s);
  EXPECT_EQ(world.current().mission_state, mavlink::number(mavlink::mission_state::no_mission))
      << "the same plan is not checked anew";
}

TEST(px4, flies_no_mission_with_an_empty_battery_or_without_a_position) {
  for (const bool is_battery : {true, false}) {
    vehicle_world world(personality::px4);
    ASSERT_EQ(world.upload(flight_of(3, world.home(), personality::px4)), mav_mission_result::accepted);
    ASSERT_EQ(world.command(mav_cmd::mission_start), mav_result::accepted);
    ASSERT_TRUE(world.run_until([&] { return world.picture().in_air; }, 30 * s));
    world.run_for(5 * s); // high enough that the landing takes longer than the test
    if (is_battery)
      world.subject().set_battery(0, world.now_ns());
    else
      world.subject().lose_position(true, world.now_ns());
    world.run_for(1 * s);
    static_cast<void>(world.command(mav_cmd::mission_start));
    static_cast<void>(world.command(mav_cmd::do_reposition));
    world.run_for(1 * s);
    EXPECT_EQ(world.picture().mode, "AUTO.LAND");
  }
}

// As seen of PX4 1.18 with a station that streamed neutral sticks until its mission began (stick_loss).
TEST(px4, holds_and_then_returns_when_it_misses_sticks_that_it_has_heard) {
  constexpr std::array<std::uint8_t, 11> neutral{0, 0, 0, 0, 0xF4, 1, 0, 0, 0, 0, 1};
  const mavlink::frame_buffer sticks(69, 243, std::as_bytes(std::span(neutral)), station_id, 0, false);
  px4_with world(6);
  ASSERT_TRUE(world.fly_to(2));
  world.run_for(20 * s);
  EXPECT_EQ(world.picture().mode, "AUTO.MISSION") << "it has heard none";
  world.send_frame(sticks.view());
  world.run_for(900 * ms);
  EXPECT_EQ(world.picture().mode, "AUTO.MISSION");
  world.run_for(200 * ms);
  EXPECT_EQ(world.picture().mode, "AUTO.LOITER");
  EXPECT_TRUE(world.said("Failsafe activated: entering Hold for 5 seconds\t"));
  world.send_frame(sticks.view());
  world.run_for(5 * s);
  EXPECT_EQ(world.picture().mode, "AUTO.RTL") << "also when they are back";
}

TEST(px4, lands_where_it_is_when_its_battery_is_empty_or_its_position_lost) {
  for (const bool is_battery : {true, false}) {
    px4_with world(3);
    ASSERT_TRUE(world.fly_to(2));
    if (is_battery)
      world.subject().set_battery(0, world.now_ns());
    else
      world.subject().lose_position(true, world.now_ns());
    EXPECT_EQ(world.picture().mode, "AUTO.LAND");
    EXPECT_TRUE(world.run_until([&] { return !world.picture().armed && !world.picture().in_air; }, 60 * s));
    EXPECT_EQ(world.start(), mav_result::temporarily_rejected);
  }
}

TEST(px4, clears_its_mission_in_flight_and_stays_where_it_is) {
  px4_with world(3);
  ASSERT_TRUE(world.fly_to(2));
  EXPECT_EQ(world.clear(), mav_mission_result::accepted);
  EXPECT_EQ(world.picture().mode, "AUTO.LOITER");
  EXPECT_TRUE(world.picture().in_air);
}

TEST(px4, ignores_set_current_during_a_transfer_and_beyond_the_mission) {
  px4_with world(2);
  world.set_current(9);
  EXPECT_TRUE(world.said("WPM: WP CURR CMD: Not in list\t"));
  world.send(mavlink::mission_count{.target_system = 1, .target_component = 1, .count = 3});
  world.set_current(1);
  EXPECT_TRUE(world.said("WPM: IGN WP CURR CMD: Busy\t"));
  EXPECT_EQ(world.picture().mission_current, 0);
}

TEST(px4, starts_again_by_command_on_the_ground_alone) {
  px4_with world(1);
  ASSERT_EQ(world.start(), mav_result::accepted);
  EXPECT_EQ(world.command(246, {.p1 = 1}), mav_result::denied);
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 200 * s));
  const auto id = world.picture().mission_id;
  EXPECT_EQ(world.command(246, {.p1 = 1}), mav_result::accepted);
  const auto asked_ns = world.now_ns();
  world.run_for(2'900 * ms);
  EXPECT_LE(world.all().back().at_ns, asked_ns);
  world.run_for(2 * s);
  EXPECT_GT(world.last_ns<mavlink::heartbeat>(), asked_ns);
  EXPECT_EQ(world.current().mission_id, id) << "plans and ids survive";
  EXPECT_EQ(world.current().mission_state, mavlink::number(mavlink::mission_state::no_mission)) << "not checked yet";
  world.run_for(3 * s);
  EXPECT_EQ(world.current().mission_state, mavlink::number(mavlink::mission_state::not_started));
}

} // namespace px4_test
} // namespace godwit::sim::test
