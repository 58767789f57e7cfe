// What people do through a ground station: the vehicle is theirs before the vehicle hears of it.
#include <gtest/gtest.h>

#include "tests/actors/executor/flight_world.hpp"
#include "tests/support/vehicle_modes.hpp"

namespace godwit::executor {
namespace station_acts_test {

using operators::command_kind;
using tests::flight_world;

constexpr station here{255, 190};
constexpr station elsewhere{254, 190};

flight_world::options on_command(sim::personality who) {
  return {.who = who, .start = start_policy::on_command, .arm_on_start = true};
}

class station_acts : public testing::TestWithParam<sim::personality> {
protected:
  flight_world world{on_command(GetParam())};

  testing::AssertionResult make_ready() {
    world.load(tests::short_mission(GetParam()));
    return world.run_until_phase(phase::ready, 120) ? testing::AssertionSuccess()
                                                    : testing::AssertionFailure() << world.story();
  }
  testing::AssertionResult fly() {
    if (const auto ready = make_ready(); !ready)
      return ready;
    (void)world.say(command_kind::start);
    if (!world.run_until_phase(phase::flying, 60))
      return testing::AssertionFailure() << world.story();
    world.run_for(5);
    return testing::AssertionSuccess();
  }
  // From now on nothing goes to the vehicle.
  void expect_silence(double seconds) {
    const auto before = world.orders();
    world.run_for(seconds);
    EXPECT_EQ(world.orders(), before) << world.story();
  }
};

TEST_P(station_acts, a_mode_in_flight_makes_the_vehicle_that_persons_before_the_mode_is_seen) {
  ASSERT_TRUE(fly());
  EXPECT_EQ(world.station_does(act_kind::command).verdict, act_verdict::pass);
  EXPECT_EQ(world.durable().status.now, phase::paused);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over);
  EXPECT_EQ(world.durable().person, here);
  expect_silence(10);
}

TEST_P(station_acts, each_kind_of_act_takes_a_vehicle_in_flight) {
  for (const auto each : {act_kind::stop, act_kind::stream, act_kind::command}) {
    flight_world one(on_command(GetParam()));
    one.load(tests::short_mission(GetParam()));
    ASSERT_TRUE(one.run_until_phase(phase::ready, 120)) << one.story();
    (void)one.say(command_kind::start);
    ASSERT_TRUE(one.run_until_phase(phase::flying, 60)) << one.story();
    EXPECT_EQ(one.station_does(each).verdict, act_verdict::pass);
    EXPECT_EQ(one.durable().status.cause, pause_cause::taken_over) << io::name_of(each);
  }
}

TEST_P(station_acts, a_start_under_way_ends_when_a_person_acts) {
  ASSERT_TRUE(make_ready());
  (void)world.say(command_kind::start);
  ASSERT_TRUE(world.run_until_phase(phase::starting, 5)) << world.story();
  EXPECT_EQ(world.station_does(act_kind::stop).verdict, act_verdict::pass);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  expect_silence(20);
}

TEST_P(station_acts, arming_on_the_ground_takes_it_and_what_was_prepared_stays_so) {
  ASSERT_TRUE(make_ready());
  EXPECT_EQ(world.station_does(act_kind::arm).verdict, act_verdict::pass);
  EXPECT_EQ(world.durable().status.now, phase::ready);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over);
  (void)world.say(command_kind::start);
  expect_silence(10);
  EXPECT_TRUE(world.say(command_kind::hand_back).is_taken);
  world.run_for(1);
  EXPECT_EQ(world.durable().status.now, phase::ready);
  EXPECT_EQ(world.durable().person, std::nullopt);
}

TEST_P(station_acts, arming_during_an_upload_ends_it) {
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::uploading, 120)) << world.story();
  EXPECT_EQ(world.station_does(act_kind::arm).verdict, act_verdict::pass);
  EXPECT_EQ(world.durable().status.now, phase::paused);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over);
}

TEST_P(station_acts, a_mode_of_a_vehicle_that_stands_disarmed_takes_nothing) {
  ASSERT_TRUE(make_ready());
  EXPECT_EQ(world.station_does(act_kind::command).verdict, act_verdict::pass);
  EXPECT_EQ(world.durable().status.cause, pause_cause::none);
}

TEST_P(station_acts, a_hold_in_flight_is_godwits_pause) {
  ASSERT_TRUE(fly());
  EXPECT_EQ(world.station_does(act_kind::hold).verdict, act_verdict::begun);
  EXPECT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::asked);
}

TEST_P(station_acts, a_resume_right_after_a_hold_goes_on_when_it_holds) {
  ASSERT_TRUE(fly());
  ASSERT_EQ(world.station_does(act_kind::hold).verdict, act_verdict::begun);
  EXPECT_TRUE(world.say(command_kind::resume).is_taken);
  EXPECT_TRUE(
      world.run_until([&] { return world.durable().status.now == phase::flying && !world.durable().doing; }, 20))
      << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

// On a slow line, and with nobody to start it again.
TEST_P(station_acts, who_has_it_go_on_is_answered_when_the_vehicle_is_in_its_mission) {
  auto wanted = on_command(GetParam());
  wanted.most_delay_ms = 150;
  flight_world slow(wanted);
  slow.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(slow.run_until_phase(phase::ready, 120)) << slow.story();
  (void)slow.say(command_kind::start);
  ASSERT_TRUE(slow.run_until_phase(phase::flying, 60)) << slow.story();
  slow.run_for(5);
  (void)slow.say(command_kind::pause);
  ASSERT_TRUE(slow.run_until_phase(phase::paused, 20)) << slow.story();
  EXPECT_EQ(slow.station_does(act_kind::go_on).verdict, act_verdict::begun);
  EXPECT_EQ(slow.station_does(act_kind::go_on).verdict, act_verdict::begun) << "said again";
  const auto starts = slow.starts();
  ASSERT_TRUE(slow.run_until([&] { return !slow.resolved_acts().empty(); }, 20)) << slow.story();
  ASSERT_EQ(slow.resolved_acts().size(), 2U) << slow.story();
  EXPECT_EQ(slow.resolved_acts()[0].answer.verdict, act_verdict::done) << slow.story();
  EXPECT_EQ(slow.heard_mode(), tests::mission_mode(GetParam())) << slow.story();
  slow.run_for(10);
  EXPECT_LE(slow.starts(), starts + 1) << slow.story();
  EXPECT_EQ(slow.station_does(act_kind::go_on).verdict, act_verdict::done) << "it goes on already\n" << slow.story();
}

TEST_P(station_acts, who_has_it_go_on_and_does_not_come_so_far_hears_why) {
  ASSERT_TRUE(fly());
  (void)world.say(command_kind::pause);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 20)) << world.story();
  EXPECT_EQ(world.station_does(act_kind::go_on).verdict, act_verdict::begun);
  world.switch_mode(tests::pilot_mode(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return !world.resolved_acts().empty(); }, 30)) << world.story();
  EXPECT_EQ(world.resolved_acts()[0].answer.verdict, act_verdict::refused) << world.story();
  EXPECT_NE(world.resolved_acts()[0].answer.reason.find("does not go on"), std::string::npos);
}

TEST_P(station_acts, a_hold_of_who_has_the_vehicle_is_passed_on) {
  ASSERT_TRUE(fly());
  (void)world.station_does(act_kind::command);
  EXPECT_EQ(world.station_does(act_kind::hold).verdict, act_verdict::pass);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over);
}

TEST_P(station_acts, arming_what_godwit_has_armed_changes_nothing) {
  ASSERT_TRUE(fly());
  EXPECT_EQ(world.station_does(act_kind::arm).verdict, act_verdict::done);
  EXPECT_EQ(world.durable().status.now, phase::flying);
}

TEST_P(station_acts, only_the_resume_of_the_station_that_has_it_hands_back) {
  ASSERT_TRUE(fly());
  (void)world.station_does(act_kind::command);
  operators::command resume;
  resume.kind = command_kind::resume;
  EXPECT_FALSE(world.say(resume).is_taken) << "nobody's";
  resume.system = elsewhere.system;
  resume.component = elsewhere.component;
  EXPECT_FALSE(world.say(resume).is_taken);
  resume.system = here.system;
  EXPECT_TRUE(world.say(resume).is_taken);
  EXPECT_TRUE(world.run_until_phase(phase::flying, 20)) << world.story();
  EXPECT_EQ(world.durable().person, std::nullopt);
}

TEST_P(station_acts, the_station_that_acted_last_has_it) {
  ASSERT_TRUE(fly());
  (void)world.station_does(act_kind::command, here);
  (void)world.station_does(act_kind::stop, elsewhere);
  EXPECT_EQ(world.durable().person, elsewhere);
}

TEST_P(station_acts, a_takeover_survives_a_crash_of_the_executor) {
  ASSERT_TRUE(fly());
  (void)world.station_does(act_kind::stop);
  world.crash();
  expect_silence(10);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  EXPECT_EQ(world.durable().person, here);
}

TEST_P(station_acts, on_the_ground_a_takeover_survives_a_crash_too) {
  ASSERT_TRUE(make_ready());
  (void)world.station_does(act_kind::arm);
  world.crash();
  expect_silence(10);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
}

TEST_P(station_acts, the_failsafe_warns_only_while_a_stations_person_has_it) {
  ASSERT_TRUE(fly());
  (void)world.station_does(act_kind::command);
  world.vehicle().set_battery(10, world.now_ns());
  world.run_for(30);
  EXPECT_TRUE(world.reactions().empty()) << world.story();
}

TEST_P(station_acts, configuration_needs_a_vehicle_that_stands_disarmed) {
  ASSERT_TRUE(make_ready());
  EXPECT_EQ(world.station_does(act_kind::configure).verdict, act_verdict::pass);
  world.run_for(5);
  (void)world.say(command_kind::start);
  ASSERT_TRUE(world.run_until_phase(phase::flying, 60)) << world.story();
  const auto answer = world.station_does(act_kind::configure);
  EXPECT_EQ(answer.verdict, act_verdict::refused);
  EXPECT_FALSE(answer.reason.empty());
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, station_acts,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot,
                                         sim::personality::plane),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

} // namespace station_acts_test
} // namespace godwit::executor
