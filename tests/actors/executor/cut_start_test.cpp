// The line is cut in the moments of a start, and the vehicle obeys unheard.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"
#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace cut_start_test {

using mission::progress_kind;
using operators::command_kind;
using tests::flight_world;

class cut_start : public testing::TestWithParam<sim::personality> {
protected:
  static flight_world::options in_real_time() {
    return {.who = GetParam(), .start = start_policy::on_command, .speed = 1};
  }
  static void begin(flight_world& world) {
    world.load(tests::short_mission(GetParam()));
    ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
    ASSERT_TRUE(world.say(command_kind::start).is_taken) << world.sentence();
  }
  static void fly_on_to_w2(flight_world& world) {
    begin(world);
    ASSERT_TRUE(world.run_until([&] { return tests::is_told(world, progress_kind::started, "w2"); }, 600))
        << world.story();
  }
  // In the moment in which the first order of that kind goes out.
  static void begin_until(flight_world& world, int (flight_world::*orders)() const) {
    begin(world);
    ASSERT_TRUE(world.run_until([&] { return (world.*orders)() > 0; }, 20)) << world.story();
  }
  static mission::document longer_mission() {
    auto result = tests::short_mission(GetParam());
    result.revision = 2;
    result.items.insert(result.items.end() - 1, tests::place(GetParam(), "w9", 30, 60));
    return result;
  }
  // Modes that were ordered since COMMANDS.
  static long modes_since(const flight_world& world, std::size_t commands) {
    return std::count(world.commands().begin() + static_cast<std::ptrdiff_t>(commands), world.commands().end(),
                      io::mavlink::number(io::mavlink::mav_cmd::do_set_mode));
  }
  static long skipped(const flight_world& world) {
    return std::ranges::count(world.reports(), progress_kind::skipped, &mission::progress_report::kind);
  }
};

// Whatever was heard of it by then: nothing, the acknowledgement, or the first heartbeat.
TEST_P(cut_start, a_start_that_was_obeyed_unheard_is_followed_and_what_was_flown_is_not_skipped) {
  for (const int after_ms : {0, 2, 5, 20, 100, 300}) {
    const double speed = GetParam() == sim::personality::rover ? 0.1 : 2; // of which the way is short
    flight_world world({.who = GetParam(), .start = start_policy::on_command, .speed = speed});
    begin_until(world, &flight_world::starts);
    world.run_for(after_ms * 1e-3);
    world.cut_line(12);
    world.run_for(16);
    EXPECT_EQ(world.durable().status.now, phase::flying) << after_ms << "\n" << world.story();
    EXPECT_EQ(world.sentence().find("disarm"), std::string::npos) << world.sentence();
    ASSERT_TRUE(world.run_until_phase(phase::done, 2'000)) << after_ms << "\n" << world.story();
    EXPECT_EQ(skipped(world), 0) << after_ms << "\n" << world.story();
    EXPECT_EQ(world.arms(), 1) << world.story();
  }
}

// The next one has not seen the start.
TEST_P(cut_start, what_was_flown_in_a_silence_in_which_the_executor_died_is_not_skipped) {
  for (const int after_ms : {5, 100, 300}) {
    flight_world world(in_real_time());
    begin_until(world, &flight_world::starts);
    world.run_for(after_ms * 1e-3);
    world.cut_line(28);
    world.run_for(20);
    world.crash();
    world.run_for(40);
    EXPECT_EQ(skipped(world), 0) << after_ms << "\n" << world.story();
  }
}

// Its positions come before it is known what it does: they contradict nothing that it has flown in the silence.
TEST_P(cut_start, one_whose_place_is_heard_before_its_mode_has_flown_what_lies_before_it) {
  const double speed = GetParam() == sim::personality::rover ? 0.1 : 2;
  flight_world world({.who = GetParam(), .start = start_policy::on_command, .speed = speed});
  begin_until(world, &flight_world::starts);
  const double silence_s = GetParam() == sim::personality::rover ? 120 : 20;
  world.cut_line(silence_s);
  world.run_for(silence_s - 0.1);
  world.lose_message(io::mavlink::heartbeat::message_id);
  world.run_for(1.5);
  world.lose_message(0);
  std::string said;
  (void)world.run_until([&] { return (said += world.sentence()), world.durable().status.now == phase::flying; }, 5);
  EXPECT_EQ(said.find("stands armed"), std::string::npos) << said;
  ASSERT_TRUE(world.run_until_phase(phase::done, 2'000)) << world.story();
  EXPECT_EQ(skipped(world), 0) << world.story();
}

// From its middle until it stands disarmed, with a kill in it or without.
TEST_P(cut_start, a_mission_that_was_completed_in_a_silence_is_complete_and_nothing_of_it_is_flown_again) {
  for (const bool is_killed : {false, true}) {
    flight_world world({.who = GetParam(), .start = start_policy::on_command});
    begin(world);
    ASSERT_TRUE(world.run_until([&] { return tests::is_told(world, progress_kind::started, "w2"); }, 200))
        << world.story();
    world.cut_line(90);
    world.run_for(20);
    if (is_killed)
      world.crash_all();
    world.run_for(75);
    ASSERT_TRUE(world.run_until_phase(phase::done, 30)) << world.story();
    EXPECT_EQ(skipped(world), 0) << world.story();
    EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
    EXPECT_EQ(world.arms(), 1) << world.story();
  }
}

// Somebody else's mode after it is nobody's order.
TEST_P(cut_start, who_has_taken_the_vehicle_in_the_silence_has_it_and_is_not_told_to_disarm_it_in_flight) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command, .speed = 2});
  begin_until(world, &flight_world::starts);
  world.cut_line(12);
  world.run_for(8);
  world.switch_mode(drill::pilot_mode(GetParam()));
  const auto orders = world.orders();
  world.run_for(10);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  EXPECT_EQ(world.orders(), orders) << world.story();
  if (world.vehicle().describe().in_air) {
    EXPECT_EQ(world.sentence().find("stands armed"), std::string::npos) << world.sentence();
  }
}

// Nobody knows who has it by then: it is told, and nothing is sent. After a restart of godwit as well.
TEST_P(cut_start, a_vehicle_that_was_armed_unheard_is_told_as_armed_until_it_is_disarmed) {
  for (const bool is_killed : {false, true}) {
    flight_world world(in_real_time());
    begin_until(world, &flight_world::arms);
    if (is_killed)
      world.crash_all();
    world.cut_line(6);
    world.run_for(8);
    ASSERT_TRUE(world.vehicle().describe().armed) << world.story();
    EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
    EXPECT_NE(world.sentence().find("stands armed"), std::string::npos) << world.story();
    EXPECT_EQ(world.starts(), 0) << world.story();
    EXPECT_NE(world.authority(), "godwit");
    world.disarm_by_hand();
    ASSERT_TRUE(world.run_until([&] { return world.sentence().find("stands armed") == std::string::npos; }, 5))
        << world.story();
    EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
    EXPECT_EQ(world.arms(), 1) << world.story();
  }
}

// Its ARM is on its way then.
TEST_P(cut_start, a_start_that_is_stopped_in_the_moment_of_its_arm_leaves_nothing_armed) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command, .speed = 1, .most_delay_ms = 100});
  begin_until(world, &flight_world::arms);
  ASSERT_TRUE(world.say(command_kind::pause).is_taken) << world.sentence();
  world.run_for(4);
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
  EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
  EXPECT_EQ(world.starts(), 0) << world.story();
}

// The first was lost.
TEST_P(cut_start, no_copy_of_an_arm_goes_out_after_the_start_was_stopped) {
  flight_world world(in_real_time());
  begin(world);
  world.lose_command(io::mavlink::number(io::mavlink::mav_cmd::component_arm_disarm), 1);
  ASSERT_TRUE(world.run_until([&] { return world.arms() > 0; }, 20)) << world.story();
  ASSERT_TRUE(world.say(command_kind::pause).is_taken) << world.sentence();
  EXPECT_FALSE(world.run_until([&] { return world.vehicle().describe().armed; }, 4)) << world.story();
  EXPECT_EQ(world.authority(), "nobody");
}

TEST_P(cut_start, a_vehicle_that_somebody_arms_when_it_is_ready_is_told_as_armed) {
  flight_world world(in_real_time());
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
  EXPECT_EQ(world.sentence().find("armed"), std::string::npos) << world.sentence();
  world.arm_by_hand();
  world.run_for(2);
  EXPECT_NE(world.sentence().find("the vehicle stands armed"), std::string::npos) << world.sentence();
}

// Only the way to the vehicle is left: what it does by then nobody knows.
TEST_P(cut_start, nothing_is_disarmed_unheard_and_nobody_who_has_armed_it_by_hand) {
  flight_world world(in_real_time());
  begin_until(world, &flight_world::arms);
  world.deafen(20);
  world.run_for(3);
  world.disarm_by_hand();
  world.run_for(0.5);
  world.arm_by_hand();
  world.run_for(18);
  if (GetParam() == sim::personality::rover) { // the others disarm by themselves
    EXPECT_TRUE(world.vehicle().describe().armed) << world.story();
  }
  EXPECT_EQ(world.disarms(), 0) << world.story();
}

// The hold of a replan is lost in a silence, and a person stops the vehicle in it.
TEST_P(cut_start, who_has_stopped_it_in_a_silence_in_which_a_replan_held_it_is_not_driven_on) {
  flight_world world(in_real_time());
  fly_on_to_w2(world);
  world.lose_command(io::mavlink::number(io::mavlink::mav_cmd::do_set_mode), 100);
  world.load(longer_mission());
  world.run_for(0.05);
  world.cut_line(10);
  world.run_for(6);
  world.lose_command(0, 0);
  world.switch_mode(drill::hold_mode(GetParam()));
  world.run_for(3);
  const auto orders = world.orders();
  world.run_for(20);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  EXPECT_EQ(world.orders(), orders) << world.story();
}

// A resume that was obeyed unheard; the next incarnation of the executor sees a hold as it was before the resume.
TEST_P(cut_start, who_has_stopped_it_in_a_silence_in_which_the_executor_died_is_not_driven_on) {
  for (const double died_s : {0.5, 7.5, 8.7}) { // before the person acts, and before the line is back
    flight_world world(in_real_time());
    fly_on_to_w2(world);
    ASSERT_TRUE(world.say(command_kind::pause).is_taken) << world.sentence();
    ASSERT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
    const auto before = world.orders();
    ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.sentence();
    ASSERT_TRUE(world.run_until([&] { return world.orders() > before; }, 5)) << world.story();
    world.cut_line(9);
    world.run_for(1);
    if (died_s < 1)
      world.crash();
    world.run_for(2);
    world.switch_mode(drill::hold_mode(GetParam()));
    world.run_for(std::max(0.0, died_s - 3));
    if (died_s > 1)
      world.crash();
    const auto orders = world.orders();
    world.run_for(20);
    EXPECT_EQ(world.orders(), orders) << died_s << "\n" << world.story();
    EXPECT_EQ(world.durable().status.now, phase::paused) << died_s << "\n" << world.story();
  }
}

// The vehicle is heard throughout, and nothing tells whose hold that is.
TEST_P(cut_start, who_has_stopped_it_after_the_hold_of_a_replan_was_lost_is_not_driven_on) {
  for (const double after_s : {0.3, 0.9, 1.5, 3.0}) {
    flight_world world(in_real_time());
    fly_on_to_w2(world);
    world.lose_command(io::mavlink::number(io::mavlink::mav_cmd::do_set_mode), 100);
    world.load(longer_mission());
    world.run_for(after_s);
    if (GetParam() == sim::personality::px4) { // takes a plan in flight, and none of its modes was ordered
      EXPECT_EQ(world.durable().status.now, phase::flying) << world.story();
      continue;
    }
    world.lose_command(0, 0);
    world.switch_mode(drill::hold_mode(GetParam()));
    const auto orders = world.orders();
    world.run_for(20);
    EXPECT_EQ(world.orders(), orders) << after_s << "\n" << world.story();
    EXPECT_EQ(world.durable().status.now, phase::paused) << after_s << "\n" << world.story();
  }
}

// The same of an operator's change, which holds the vehicle first.
TEST_P(cut_start, who_has_stopped_it_after_the_hold_of_a_go_to_was_lost_is_not_driven_on) {
  for (const double after_s : {0.3, 0.5, 0.7, 1.2, 1.5}) {
    flight_world world(in_real_time());
    fly_on_to_w2(world);
    world.lose_command(io::mavlink::number(io::mavlink::mav_cmd::do_set_mode), 100);
    operators::command there;
    there.kind = command_kind::go_to;
    there.place = mission::position{47.3978, 8.5460, 30};
    ASSERT_TRUE(world.say(there).is_taken) << world.sentence();
    world.run_for(after_s);
    world.lose_command(0, 0);
    world.switch_mode(drill::hold_mode(GetParam()));
    world.run_for(0.3);
    const auto orders = world.orders();
    world.run_for(20);
    EXPECT_EQ(world.orders(), orders) << after_s << "\n" << world.story();
    EXPECT_EQ(world.durable().status.now, phase::paused) << after_s << "\n" << world.story();
  }
}

TEST_P(cut_start, a_replan_whose_hold_was_not_acknowledged_waits_for_an_operator_who_sends_it_on_with_the_new_plan) {
  if (GetParam() == sim::personality::px4)
    return; // no hold
  flight_world world(in_real_time());
  fly_on_to_w2(world);
  world.load(longer_mission());
  ASSERT_TRUE(world.run_until([&] { return world.commands().back() == 176; }, 5)) << world.story();
  world.lose_message(io::mavlink::command_ack::message_id);
  world.run_for(1.5);
  world.lose_message(0);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  EXPECT_NE(world.sentence().find("somebody may have stopped it"), std::string::npos) << world.sentence();
  world.crash(); // and the next incarnation does the same
  world.run_for(5);
  EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
  EXPECT_NE(world.sentence().find("somebody may have stopped it"), std::string::npos) << world.sentence();
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.sentence();
  ASSERT_TRUE(world.run_until_phase(phase::done, 2'000)) << world.story();
  EXPECT_TRUE(tests::is_told(world, progress_kind::reached, "w9")) << world.story();
}

// They may have been obeyed, and then they are godwit's.
TEST_P(cut_start, what_was_ordered_and_obeyed_unheard_is_followed_when_the_vehicle_is_heard_again) {
  for (const auto what : {command_kind::come_home, command_kind::resume}) {
    flight_world world(in_real_time());
    fly_on_to_w2(world);
    if (what == command_kind::resume) {
      ASSERT_TRUE(world.say(command_kind::pause).is_taken);
      ASSERT_TRUE(world.run_until_phase(phase::paused, 5)) << world.story();
    }
    const auto orders = world.orders();
    ASSERT_TRUE(world.say(what).is_taken) << world.sentence();
    ASSERT_TRUE(world.run_until([&] { return world.orders() > orders; }, 5)) << world.story();
    world.deafen(8);
    world.run_for(14);
    EXPECT_EQ(world.durable().status.now, what == command_kind::resume ? phase::flying : phase::landing)
        << world.story();
    ASSERT_TRUE(world.run_until_phase(what == command_kind::resume ? phase::done : phase::aborted, 2'000))
        << world.story();
  }
}

TEST_P(cut_start, a_return_that_was_obeyed_unheard_is_followed_after_a_crash_as_well) {
  for (const bool is_killed : {false, true})
    for (const double after_s : {0.0, 0.002, 0.05, 0.5}) {
      flight_world world(in_real_time());
      fly_on_to_w2(world);
      ASSERT_TRUE(world.say(command_kind::come_home).is_taken) << world.sentence();
      world.run_for(after_s);
      world.cut_line(3);
      world.run_for(1);
      if (is_killed)
        world.crash_all();
      else
        world.crash();
      world.run_for(10);
      EXPECT_NE(world.durable().status.now, phase::flying) << is_killed << after_s << world.story();
      ASSERT_TRUE(world.run_until_phase(phase::aborted, 2'000)) << is_killed << after_s << world.story();
    }
}

// The disarm was decided on in the silence.
TEST_P(cut_start, who_has_armed_it_by_hand_in_a_silence_is_not_disarmed_when_it_is_heard_again) {
  const bool is_px4 = GetParam() == sim::personality::px4;
  for (const double cut_s : {1.6, 2.4, 5.0}) {
    flight_world world(in_real_time());
    begin_until(world, &flight_world::arms);
    world.lose_command(
        io::mavlink::number(is_px4 ? io::mavlink::mav_cmd::do_set_mode : io::mavlink::mav_cmd::mission_start), 100);
    ASSERT_TRUE(world.run_until([&] { return world.starts() > 0; }, 20)) << world.story();
    world.run_for(cut_s < 4 ? 3.5 : 0.5);
    world.cut_line(cut_s);
    world.run_for(0.5);
    world.disarm_by_hand();
    world.run_for(0.5);
    world.arm_by_hand();
    world.run_for(8);
    EXPECT_EQ(world.disarms(), 0) << cut_s << "\n" << world.story();
  }
}

TEST_P(cut_start, whoever_holds_it_in_the_air_has_it_also_when_the_executor_died_in_the_silence) {
  if (GetParam() == sim::personality::rover)
    return; // it stands, and is told as armed
  flight_world world(in_real_time());
  begin_until(world, &flight_world::starts);
  world.cut_line(24);
  world.run_for(12);
  world.crash();
  world.run_for(4);
  world.switch_mode(drill::pilot_mode(GetParam()));
  world.run_for(12);
  ASSERT_TRUE(world.vehicle().describe().in_air) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
}

// A pilot's mode after it is none of a flight that is prepared anew.
TEST_P(cut_start, a_flight_that_is_prepared_again_after_a_restart_in_its_start_becomes_ready) {
  flight_world world(in_real_time());
  begin_until(world, &flight_world::arms);
  world.cut_line(1);
  world.run_for(0.6);
  world.crash();
  world.run_for(1);
  world.switch_mode(drill::hold_mode(GetParam()));
  world.run_for(4);
  ASSERT_EQ(world.durable().status.now, phase::paused) << world.story();
  if (world.durable().status.cause == pause_cause::taken_over) {
    ASSERT_TRUE(world.say(command_kind::hand_back).is_taken) << world.sentence();
    world.run_for(0.5);
  }
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.sentence();
  EXPECT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
}

// Nobody sees what it would move: a person may have stopped the vehicle after the first.
TEST_P(cut_start, a_return_is_not_repeated_while_the_vehicle_is_not_heard) {
  flight_world world(in_real_time());
  fly_on_to_w2(world);
  world.deafen(8);
  const auto commands = world.commands().size();
  ASSERT_TRUE(world.say(command_kind::come_home).is_taken) << world.sentence();
  world.run_for(1);
  world.switch_mode(drill::hold_mode(GetParam()));
  world.run_for(20);
  EXPECT_EQ(modes_since(world, commands), 1) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
}

TEST_P(cut_start, whoever_holds_it_in_the_air_after_a_start_that_failed_unheard_has_it) {
  if (GetParam() == sim::personality::rover)
    return; // it stands, and is told as armed
  flight_world world(in_real_time());
  begin_until(world, &flight_world::starts);
  world.cut_line(12);
  world.run_for(8);
  ASSERT_TRUE(world.vehicle().describe().in_air) << world.story();
  world.switch_mode(drill::hold_mode(GetParam()));
  const auto orders = world.orders();
  world.run_for(10);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  EXPECT_EQ(world.orders(), orders) << world.story();
}

// godwit's own was lost.
TEST_P(cut_start, who_arms_it_by_hand_just_after_a_start_that_was_stopped_is_not_disarmed) {
  flight_world world(in_real_time());
  begin(world);
  world.lose_command(io::mavlink::number(io::mavlink::mav_cmd::component_arm_disarm), 3);
  ASSERT_TRUE(world.run_until([&] { return world.arms() > 0; }, 20)) << world.story();
  world.run_for(0.05);
  ASSERT_TRUE(world.say(command_kind::pause).is_taken) << world.sentence();
  world.run_for(0.8);
  world.arm_by_hand();
  world.run_for(4);
  EXPECT_EQ(world.disarms(), 0) << world.story();
  EXPECT_TRUE(world.vehicle().describe().armed) << world.story();
}

INSTANTIATE_TEST_SUITE_P(each, cut_start,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::rover));

} // namespace cut_start_test
} // namespace godwit::executor
