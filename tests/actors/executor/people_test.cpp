// What people do beside a vehicle, and what godwit must not do then. Each was once seen to go wrong on a real vehicle.
#include <algorithm>
#include <array>
#include <iostream>
#include <limits>

#include <gtest/gtest.h>

#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/flight_world.hpp"
#include "tests/support/vehicle_modes.hpp"

namespace godwit::executor {
namespace people_test {

using mission::progress_kind;
using operators::command_kind;
using sim::personality;
using tests::flight_world;
using tests::fly_to;
using tests::hold_mode;
using tests::is_told;
using tests::landing_mode;
using tests::mission_mode;
using tests::with_landing_on_the_way;

constexpr std::uint16_t set_mode = 176;
// A PX4 is started by its mission mode.
std::uint16_t start_of(sim::personality who) { return who == sim::personality::px4 ? 176 : 300; }

std::uint32_t manual(personality who) {
  constexpr std::array modes{0U, 0x00030000U, 0U, 2U}; // by personality
  return modes.at(static_cast<std::size_t>(who));
}
// Without a return: the last item is a waypoint.
mission::document open_ended(personality who) {
  auto result = tests::short_mission(who);
  if (who != personality::rover)
    result.items.pop_back();
  return result;
}

mission::assignment tail_after(const std::string& item, personality who) {
  mission::assignment result;
  result.assignment_id = "11111111-2222-4333-8444-100000000001";
  result.base_revision = 1;
  result.revision = 2;
  result.replace_after_item_id = item;
  result.items = {tests::place(who, "z", -20, 20)};
  return result;
}

bool is_complete(const flight_world& world) {
  return std::ranges::any_of(world.reports(), [](const auto& each) { return each.kind == progress_kind::complete; });
}

class people : public testing::TestWithParam<personality> {};
class people_in_the_air : public people {};
class people_at_a_copter : public people {};
class people_at_a_px4 : public people {};

// -- on the last leg ----------------------------------------------------------------------------------

TEST_P(people, on_the_way_to_the_last_item_a_pilot_is_seen_and_nothing_is_sent) {
  for (const bool returns : {false, true})
    for (const auto mode : {hold_mode(GetParam()), manual(GetParam())}) {
      flight_world world({.who = GetParam(), .speed = 2});
      const auto mission = returns ? tests::short_mission(GetParam()) : open_ended(GetParam());
      const bool goes_home = returns && GetParam() != personality::rover; // PX4 changes its mode for that
      ASSERT_TRUE(fly_to(world, mission, goes_home ? progress_kind::reached : progress_kind::started, "w3"));
      world.run_for(2);
      world.switch_mode(mode);
      ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::taken_over; }, 6))
          << world.story();
      const auto orders = world.orders();
      world.assign(tail_after("w2", GetParam()));
      world.vehicle().set_battery(3, world.now_ns());
      world.run_for(20);
      EXPECT_EQ(world.orders(), orders) << world.story();
      EXPECT_TRUE(world.reactions().empty()) << "a low battery under a pilot is a warning\n" << world.story();
      EXPECT_FALSE(is_complete(world)) << world.story();
    }
}

// The mission is finished as its return begins: in its mission mode a PX4 would hold.
TEST_P(people_at_a_px4, a_resume_in_the_return_of_the_mission_returns_and_the_mission_is_complete) {
  for (const auto mode : {manual(GetParam()), hold_mode(GetParam())}) {
    flight_world world({.who = GetParam(), .speed = 2});
    ASSERT_TRUE(fly_to(world, tests::short_mission(GetParam()), progress_kind::reached, "w3"));
    world.run_for(3);
    world.switch_mode(mode);
    ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::taken_over; }, 6))
        << world.story();
    world.run_for(5);
    ASSERT_TRUE(world.say(command_kind::hand_back).is_taken) << world.story();
    ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::asked; }, 5))
        << world.story();
    ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
    ASSERT_TRUE(world.run_until_phase(phase::done, 300)) << world.sentence() << world.story();
    EXPECT_TRUE(is_complete(world)) << world.story();
    EXPECT_EQ(world.arms(), 1) << world.story();
  }
}

// A PX4 does not begin a plan anew that it has finished, when it is brought once more.
TEST_P(people_at_a_px4, an_assignment_in_the_return_that_has_the_same_places_is_flown) {
  flight_world world({.who = GetParam(), .speed = 2});
  ASSERT_TRUE(fly_to(world, tests::short_mission(GetParam()), progress_kind::reached, "w3"));
  for (int revision = 2; revision <= 4; ++revision) {
    world.run_for(3);
    auto again = tail_after("w2", GetParam());
    again.assignment_id.back() = static_cast<char>('0' + revision);
    again.base_revision = revision - 1;
    again.revision = revision;
    again.items.push_back(tests::way_home(GetParam(), "home" + std::to_string(revision)));
    world.assign(again);
    const auto answers = static_cast<std::size_t>(revision - 1);
    ASSERT_TRUE(world.run_until([&] { return world.answers().size() == answers; }, 30)) << world.story();
    ASSERT_TRUE(
        world.run_until([&] { return is_told(world, progress_kind::started, "home" + std::to_string(revision)); }, 120))
        << world.sentence() << world.story();
  }
  ASSERT_TRUE(world.run_until_phase(phase::done, 300)) << world.sentence() << world.story();
  EXPECT_TRUE(is_complete(world)) << world.story();
}

TEST_P(people_at_a_px4, a_return_of_the_mission_that_was_paused_goes_on_also_after_a_kill) {
  for (const bool is_killed : {false, true}) {
    flight_world world({.who = GetParam(), .speed = 2});
    ASSERT_TRUE(fly_to(world, tests::short_mission(GetParam()), progress_kind::reached, "w3"));
    world.run_for(3);
    ASSERT_TRUE(world.say(command_kind::pause).is_taken) << world.story();
    ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::asked; }, 6))
        << world.story();
    ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
    if (is_killed) {
      world.crash_all();
      ASSERT_TRUE(world.run_until_phase(phase::paused, 20)) << world.sentence() << world.story();
      world.run_for(2);
      ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.sentence() << world.story();
    }
    ASSERT_TRUE(world.run_until_phase(phase::done, 300)) << world.sentence() << world.story();
    EXPECT_TRUE(is_complete(world)) << world.story();
  }
}

// -- between two heartbeats -----------------------------------------------------------------------------

TEST_P(people_at_a_px4, who_takes_it_is_seen_without_a_heartbeat_and_nothing_is_sent) {
  for (const auto mode : {manual(GetParam()), landing_mode(GetParam())}) {
    flight_world world({.who = GetParam()});
    ASSERT_TRUE(fly_to(world, tests::short_mission(GetParam()), progress_kind::started, "w2"));
    world.run_for(2);
    world.lose_message(io::mavlink::heartbeat::message_id);
    world.switch_mode(mode);
    ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::taken_over; }, 1.1))
        << world.story();
    const auto orders = world.orders();
    (void)world.say(command_kind::resume);
    world.run_for(2);
    EXPECT_EQ(world.orders(), orders) << world.story();
  }
}

TEST_P(people_at_a_px4, a_landing_of_its_own_failsafe_is_called_so_without_a_heartbeat) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly_to(world, tests::short_mission(GetParam()), progress_kind::started, "w2"));
  world.run_for(2);
  world.lose_message(io::mavlink::heartbeat::message_id);
  world.vehicle().lose_position(true, world.now_ns());
  ASSERT_TRUE(world.run_until([&] { return needs_hand_back(world.durable().status.cause); }, 1.1)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::autopilot_failsafe) << world.story();
}

// -- armed by godwit --------------------------------------------------------------------------------------

TEST_P(people, who_takes_it_in_a_start_in_which_godwit_has_armed_it_is_told_that_and_it_is_not_disarmed) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command, .speed = 1});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.lose_command(start_of(GetParam()), 100);
  ASSERT_TRUE(world.say(command_kind::start).is_taken) << world.sentence();
  ASSERT_TRUE(world.run_until([&] { return world.vehicle().describe().armed; }, 20)) << world.story();
  world.run_for(1.2);
  world.switch_mode(manual(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::taken_over; }, 6))
      << world.story();
  EXPECT_NE(world.sentence().find("stands armed"), std::string::npos) << world.sentence();
  const auto orders = world.orders();
  world.run_for(8);
  EXPECT_EQ(world.orders(), orders) << world.story();
  EXPECT_TRUE(world.vehicle().describe().armed) << world.story();
}

// -- landings -----------------------------------------------------------------------------------------

TEST_P(people_in_the_air, after_a_landing_by_a_pilot_nothing_is_brought_armed_or_started_until_a_hand_back) {
  for (const auto policy : {start_policy::automatic, start_policy::on_command}) {
    flight_world world({.who = GetParam(), .start = policy, .takeoff_again = start_policy::automatic});
    world.load(with_landing_on_the_way());
    if (policy == start_policy::on_command) {
      ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
      ASSERT_TRUE(world.say(command_kind::start).is_taken);
    }
    ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::started, "w1"); }, 600)) << world.story();
    world.switch_mode(landing_mode(GetParam()));
    ASSERT_TRUE(world.run_until([&] { return !world.vehicle().describe().armed; }, 120)) << world.story();
    const auto orders = world.orders();
    world.run_for(60);
    EXPECT_EQ(world.orders(), orders) << world.story();
    EXPECT_FALSE(world.vehicle().describe().armed);
    EXPECT_TRUE(needs_hand_back(world.durable().status.cause)) << world.story();
    EXPECT_FALSE(is_told(world, progress_kind::reached, "drop")) << world.story();
    ASSERT_TRUE(world.say(command_kind::hand_back).is_taken);
    world.run_for(1);
    ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
    EXPECT_TRUE(world.run_until_phase(phase::ready, 60)) << world.story();
  }
}

TEST_P(people_in_the_air, a_landing_by_a_pilot_reaches_skips_and_completes_nothing) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly_to(world, tests::short_mission(GetParam()), progress_kind::started, "w2"));
  world.switch_mode(landing_mode(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return !world.vehicle().describe().armed; }, 120)) << world.story();
  const auto reports = world.reports().size();
  world.run_for(30);
  EXPECT_FALSE(is_complete(world)) << world.story();
  EXPECT_LE(world.reports().size(), reports + 1) << world.story();
  EXPECT_FALSE(is_told(world, progress_kind::skipped, "w3")) << world.story();
  ASSERT_TRUE(world.say(command_kind::hand_back).is_taken) << world.story();
  world.run_for(1);
  EXPECT_FALSE(is_complete(world)) << world.story();
  EXPECT_TRUE(world.say(command_kind::resume).is_taken) << "the rest can be flown\n" << world.story();
}

TEST_P(people_in_the_air, after_a_landing_on_the_way_the_take_off_needs_a_persons_word) {
  flight_world world({.who = GetParam()});
  world.load(with_landing_on_the_way());
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "drop"); }, 600)) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::ready, 60)) << world.story();
  world.run_for(30);
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
  ASSERT_TRUE(world.say(command_kind::start).is_taken) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

TEST_P(people_in_the_air, where_it_is_set_so_it_takes_off_again_by_itself) {
  flight_world world({.who = GetParam(), .takeoff_again = start_policy::automatic});
  world.load(with_landing_on_the_way());
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_TRUE(is_complete(world)) << world.story();
}

// -- starts -------------------------------------------------------------------------------------------

TEST_P(people, a_start_that_was_lost_is_not_repeated_when_a_person_has_changed_the_mode) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command, .speed = 1});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.lose_command(start_of(GetParam()), 3);
  ASSERT_TRUE(world.say(command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until([&] { return world.starts() == 1; }, 10)) << world.story();
  world.run_for(0.5);
  world.switch_mode(manual(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.heard_mode() == manual(GetParam()); }, 3));
  const auto orders = world.orders();
  world.run_for(20);
  EXPECT_EQ(world.orders(), orders) << world.story();
  EXPECT_FALSE(world.vehicle().describe().in_air) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
}

TEST_P(people, who_disarms_it_during_its_start_has_it) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command, .speed = 1});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.lose_command(start_of(GetParam()), 5);
  ASSERT_TRUE(world.say(command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until([&] { return world.vehicle().describe().armed; }, 10)) << world.story();
  ASSERT_TRUE(world.run_until([&] { return world.starts() == 1; }, 10)) << world.story();
  world.disarm_by_hand();
  world.run_for(1.5);
  const auto orders = world.orders();
  world.run_for(20);
  EXPECT_EQ(world.orders(), orders) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
}

// -- on the ground ------------------------------------------------------------------------------------

TEST_P(people_in_the_air, resume_right_after_a_disarm_commands_nothing) {
  flight_world world({.who = GetParam(), .speed = 1});
  ASSERT_TRUE(fly_to(world, tests::short_mission(GetParam()), progress_kind::started, "w1"));
  ASSERT_TRUE(world.say(command_kind::pause).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  world.disarm_by_hand();
  ASSERT_TRUE(world.run_until([&] { return !world.vehicle().describe().in_air; }, 60)) << world.story();
  world.run_for(1.5);
  const auto orders = world.orders();
  EXPECT_FALSE(world.say(command_kind::resume).is_taken) << world.story();
  world.run_for(20);
  EXPECT_EQ(world.orders(), orders) << world.story();
}

// Whoever arms it would be run over.
TEST_P(people_in_the_air, on_the_ground_it_is_not_left_in_its_mission_mode) {
  auto mission = tests::short_mission(GetParam());
  mission.items.resize(2);
  mission.items.emplace_back(mission::land{"down", std::get<mission::waypoint>(mission.items[1]).at});
  flight_world world({.who = GetParam()});
  world.load(mission);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  world.run_for(6);
  EXPECT_NE(world.heard_mode(), mission_mode(GetParam())) << world.story();
  const auto stand_bys = world.stand_bys();
  world.arm_by_hand();
  world.run_for(10);
  EXPECT_FALSE(world.vehicle().describe().in_air) << world.story();
  EXPECT_LE(stand_bys, 3);
  EXPECT_EQ(world.stand_bys(), stand_bys) << "never while it is armed";
}

TEST_P(people_in_the_air, a_plan_that_somebody_else_flies_is_not_replaced) {
  for (const auto policy : {start_policy::on_command, start_policy::automatic}) {
    flight_world world({.who = GetParam(), .start = policy});
    world.run_for(10);
    world.fly_by_hand(hold_mode(GetParam()));
    world.load(tests::short_mission(GetParam()));
    world.run_for(20);
    EXPECT_EQ(world.orders(), 0) << world.story();
    EXPECT_EQ(world.vehicle().describe().mission_count, 0) << world.story();
    EXPECT_EQ(world.durable().status.now, phase::preflight) << world.story();
  }
}

// -- words that stop it -------------------------------------------------------------------------------

TEST_P(people_at_a_copter, a_pilot_who_takes_loiter_after_a_hold_of_ours_that_was_lost_has_it) {
  flight_world world(
      {.who = GetParam(), .speed = 4}); // a heartbeat each quarter of a second: a Copter tells each change
  ASSERT_TRUE(fly_to(world, tests::short_mission(GetParam()), progress_kind::started, "w2"));
  world.lose_command(set_mode, 3);
  ASSERT_TRUE(world.say(command_kind::pause).is_taken);
  world.run_for(0.5);
  world.switch_mode(hold_mode(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.heard_mode() == hold_mode(GetParam()); }, 3)) << world.story();
  const auto orders = world.orders();
  world.run_for(10);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  EXPECT_EQ(world.orders(), orders) << world.story();
}

TEST_P(people, a_pause_that_was_lost_is_said_again_each_second_and_shown_as_pausing) {
  flight_world world({.who = GetParam(), .speed = 1});
  ASSERT_TRUE(fly_to(world, tests::short_mission(GetParam()), progress_kind::started, "w2"));
  world.lose_command(set_mode, 6);
  ASSERT_TRUE(world.say(command_kind::pause).is_taken);
  world.run_for(0.5);
  EXPECT_EQ(world.durable().status.now, phase::pausing) << world.story();
  EXPECT_EQ(world.durable().status.reason, "the vehicle was commanded to hold");
  EXPECT_TRUE(world.run_until_phase(phase::paused, 4)) << world.story();
}

TEST_P(people, whoever_chooses_an_item_while_a_pause_is_not_obeyed_yet_has_not_said_that_it_goes_on) {
  flight_world world({.who = GetParam(), .speed = 1});
  ASSERT_TRUE(fly_to(world, tests::short_mission(GetParam()), progress_kind::started, "w2"));
  world.lose_command(set_mode, 3);
  ASSERT_TRUE(world.say(command_kind::pause).is_taken);
  world.run_for(0.5);
  ASSERT_EQ(world.durable().status.now, phase::pausing) << world.story();
  world.station_chooses({.index = 1, .plan_id = 0, .asked_by = {255, 190}}, 7);
  ASSERT_EQ(world.start_answers().size(), 1U) << world.story();
  EXPECT_EQ(world.start_answers().front().verdict, start_verdict::not_ready);
  world.run_for(20);
  EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
}

TEST_P(people, a_pause_that_is_never_obeyed_is_said_so_and_not_shown_as_paused) {
  flight_world world({.who = GetParam(), .speed = 1});
  ASSERT_TRUE(fly_to(world, tests::short_mission(GetParam()), progress_kind::started, "w1"));
  world.lose_command(set_mode, 100);
  ASSERT_TRUE(world.say(command_kind::pause).is_taken);
  world.run_for(7);
  EXPECT_EQ(world.durable().status.now, phase::flying) << world.story();
  EXPECT_NE(world.story().find("not execute"), std::string::npos) << world.story();
}

// The pause may have come through late, or a pilot holds it: nobody can tell, so nothing is sent.
TEST_P(people, who_holds_it_right_after_a_pause_that_was_not_obeyed_has_it) {
  flight_world world({.who = GetParam(), .speed = 1});
  ASSERT_TRUE(fly_to(world, tests::short_mission(GetParam()), progress_kind::started, "w1"));
  world.lose_command(set_mode, 100);
  ASSERT_TRUE(world.say(command_kind::pause).is_taken);
  ASSERT_TRUE(world.run_until([&] { return world.story().find("not execute") != std::string::npos; }, 7));
  world.switch_mode(hold_mode(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.heard_mode() == hold_mode(GetParam()); }, 3)) << world.story();
  world.lose_command(set_mode, 0);
  const auto orders = world.orders();
  world.assign(tail_after("w2", GetParam()));
  world.run_for(10);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  EXPECT_EQ(world.orders(), orders) << world.story();
}

// Of 200 pauses 198 within 2.5 s.
TEST_P(people, at_20_percent_loss_a_pause_is_obeyed_within_2_5_s) {
  constexpr int flights = 1'000; // eight of them lose three commands in a row
  const auto holds = [](flight_world& world) {
    const auto mode = world.vehicle().describe().mode;
    return mode == "AUTO.LOITER" || mode == "BRAKE" || mode == "HOLD" || mode == "LOITER";
  };
  std::vector<double> took_s;
  for (int seed = 1; seed <= flights; ++seed) {
    flight_world world({.who = GetParam(), .speed = 1, .seed = static_cast<std::uint64_t>(seed)});
    ASSERT_TRUE(fly_to(world, tests::short_mission(GetParam()), progress_kind::started, "w1"));
    world.set_loss(0.2);
    world.run_for(0.05 * (seed % 40));
    const auto orders = world.orders();
    const auto said_ns = world.now_ns();
    ASSERT_TRUE(world.say(command_kind::pause).is_taken);
    EXPECT_GT(world.orders(), orders) << "it is commanded in the turn in which it is said";
    (void)world.run_until([&] { return holds(world); }, 20); // where all five sends were lost: 20 s
    took_s.push_back(static_cast<double>(world.now_ns() - said_ns) * 1e-9);
  }
  std::ranges::sort(took_s);
  std::cout << "p50 " << took_s[flights / 2] << " s, p99 " << took_s[flights * 99 / 100 - 1] << " s\n";
  EXPECT_LE(took_s[flights * 99 / 100 - 1], 2.5);
}

// A plan that comes slowly over a bad line is given up for it.
TEST_P(people, a_pause_does_not_wait_for_an_upload_that_is_under_way) {
  flight_world world({.who = GetParam(), .speed = 1, .most_delay_ms = 200});
  ASSERT_TRUE(fly_to(world, tests::short_mission(GetParam()), progress_kind::started, "w1"));
  world.assign(tail_after("w2", GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.durable().progress.upload.has_value(); }, 5)) << world.story();
  ASSERT_TRUE(world.say(command_kind::pause).is_taken);
  const auto said_ns = world.now_ns();
  ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::asked; }, 5)) << world.story();
  EXPECT_LT(world.now_ns() - said_ns, 2'500'000'000) << world.story();
  world.run_for(15);
  EXPECT_FALSE(world.durable().progress.upload) << "what was given up has an end\n" << world.story();
  EXPECT_EQ(world.answers().size(), 1U) << "and an answer\n" << world.story();
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::done, 300)) << world.story();
}

TEST_P(people, a_pause_in_a_start_ends_the_start) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command, .speed = 1});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.lose_command(start_of(GetParam()), 5);
  ASSERT_TRUE(world.say(command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until([&] { return world.starts() == 1; }, 10)) << world.story();
  ASSERT_TRUE(world.say(command_kind::pause).is_taken) << world.story();
  world.run_for(10);
  EXPECT_EQ(world.starts(), 1) << world.story();
  EXPECT_FALSE(world.vehicle().describe().in_air) << world.story();
  EXPECT_NE(world.durable().status.now, phase::starting) << world.story();
}

// The start came through before the command: what flies is held.
TEST_P(people, a_pause_right_after_a_start_holds_what_has_started) {
  for (int wait = 0; wait < 12; ++wait) {
    flight_world world({.who = GetParam(), .start = start_policy::on_command, .speed = 1});
    world.load(tests::short_mission(GetParam()));
    ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
    ASSERT_TRUE(world.say(command_kind::start).is_taken);
    ASSERT_TRUE(world.run_until([&] { return world.starts() == 1; }, 10)) << world.story();
    world.run_for(0.1 * wait);
    ASSERT_TRUE(world.say(command_kind::pause).is_taken) << world.story();
    world.run_for(8);
    EXPECT_TRUE(world.durable().status.now == phase::paused || !world.vehicle().describe().armed) << world.story();
    EXPECT_NE(world.heard_mode(), mission_mode(GetParam())) << world.story();
    EXPECT_EQ(world.starts(), 1) << world.story();
  }
}

TEST_P(people, who_has_armed_it_and_disarms_it_in_its_start_has_it) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command, .arm_on_start = false, .speed = 1});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.arm_by_hand();
  ASSERT_TRUE(world.run_until([&] { return world.vehicle().describe().armed; }, 5)) << world.story();
  world.run_for(1.5);
  world.lose_command(start_of(GetParam()), 1);
  ASSERT_TRUE(world.say(command_kind::start).is_taken) << world.story();
  world.run_for(0.3);
  world.disarm_by_hand();
  world.run_for(20);
  EXPECT_LE(world.starts(), 1) << world.story();
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
}

// -- places -------------------------------------------------------------------------------------------

TEST_P(people, nobody_sends_it_to_a_place_that_no_mission_may_have) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly_to(world, tests::short_mission(GetParam()), progress_kind::started, "w2"));
  const bool drives = GetParam() == personality::rover;
  const auto near = std::get<mission::waypoint>(tests::place(GetParam(), "", 30, 30)).at;
  constexpr double endless = std::numeric_limits<double>::infinity();
  std::vector<mission::position> places;
  for (const double up_m : {1e30, endless, -endless, std::numeric_limits<double>::quiet_NaN(), 1'001.0})
    places.push_back({near.latitude, near.longitude, up_m});
  if (!drives)
    places.push_back({near.latitude, near.longitude, -500});
  places.push_back({near.latitude + 1, near.longitude, near.altitude_m}); // 111 km
  places.push_back({91, near.longitude, near.altitude_m});
  places.push_back({near.latitude, endless, near.altitude_m});
  const auto orders = world.orders();
  for (const auto& each : places)
    for (const auto what : {command_kind::go_to, command_kind::insert}) {
      operators::command command;
      command.kind = what;
      command.place = each;
      EXPECT_FALSE(world.say(command).is_taken) << each.latitude << " " << each.altitude_m;
    }
  world.run_for(1);
  EXPECT_EQ(world.orders(), orders) << world.story();
}

// -- after the last item -----------------------------------------------------------------------------

TEST_P(people_in_the_air, after_a_last_waypoint_in_the_air_it_can_be_sent_further) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly_to(world, open_ended(GetParam()), progress_kind::reached, "w3"));
  world.run_for(3);
  ASSERT_TRUE(world.vehicle().describe().in_air) << world.story();
  world.assign(tail_after("w3", GetParam()));
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "z"); }, 120)) << world.story();
  ASSERT_EQ(world.answers().size(), 1U);
  EXPECT_EQ(world.answers().front().response.outcome, mission::assignment_outcome::accepted) << world.story();
}

TEST_P(people_in_the_air, after_a_last_waypoint_it_is_said_that_the_vehicle_waits_in_the_air) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly_to(world, open_ended(GetParam()), progress_kind::reached, "w3"));
  ASSERT_TRUE(world.run_until([&] { return is_complete(world); }, 60)) << world.story();
  world.run_for(3);
  const phase_status waits = world.durable().status;
  EXPECT_EQ(waits.now, phase::paused) << world.story();
  EXPECT_EQ(waits.cause, pause_cause::plan_ended);
  EXPECT_TRUE(waits.in_flight);
  world.crash_all();
  world.run_for(5);
  EXPECT_EQ(world.durable().status, waits) << world.story();
  EXPECT_FALSE(world.say(command_kind::resume).is_taken);
  ASSERT_TRUE(world.say(command_kind::come_home).is_taken) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_FALSE(world.vehicle().describe().in_air);
}

// -- restarts -----------------------------------------------------------------------------------------

TEST_P(people_in_the_air, who_has_landed_it_keeps_it_when_godwit_dies_while_it_makes_it_safe_to_arm) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly_to(world, with_landing_on_the_way(), progress_kind::started, "w1"));
  world.switch_mode(hold_mode(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return needs_hand_back(world.durable().status.cause); }, 10)) << world.story();
  world.switch_mode(landing_mode(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return !world.vehicle().describe().armed; }, 120)) << world.story();
  world.switch_mode(mission_mode(GetParam()));
  world.lose_command(set_mode, 3);
  ASSERT_TRUE(world.run_until([&] { return world.durable().doing.has_value(); }, 10)) << world.story();
  EXPECT_EQ(world.durable().doing->kind, task_kind::stand_by);
  world.crash_all();
  world.run_for(10);
  EXPECT_TRUE(needs_hand_back(world.durable().status.cause)) << world.story();
  EXPECT_FALSE(world.say(command_kind::resume).is_taken);
}

// Nobody prepares it once more.
TEST_P(people_in_the_air, a_done_mission_stays_done_when_godwit_dies_while_it_makes_the_vehicle_safe_to_arm) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  world.run_for(5);
  world.switch_mode(hold_mode(GetParam()));
  world.arm_by_hand();
  world.run_for(2);
  world.disarm_by_hand();
  world.switch_mode(mission_mode(GetParam()));
  world.lose_command(set_mode, 3);
  ASSERT_TRUE(world.run_until([&] { return world.durable().doing.has_value(); }, 10)) << world.story();
  world.crash_all();
  world.run_for(10);
  EXPECT_EQ(world.durable().status.now, phase::done) << world.story();
}

INSTANTIATE_TEST_SUITE_P(each, people,
                         testing::Values(personality::px4, personality::ardupilot, personality::rover,
                                         personality::plane));
INSTANTIATE_TEST_SUITE_P(each, people_in_the_air, testing::Values(personality::px4, personality::ardupilot));
INSTANTIATE_TEST_SUITE_P(each, people_at_a_copter, testing::Values(personality::ardupilot));
INSTANTIATE_TEST_SUITE_P(each, people_at_a_px4, testing::Values(personality::px4));

} // namespace people_test
} // namespace godwit::executor
