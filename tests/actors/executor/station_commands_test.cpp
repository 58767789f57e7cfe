// Commands of ground stations that go on to the vehicle: whose the vehicle is is pending until it has answered them,
// and one that it refuses has taken nothing.
#include <array>

#include <gtest/gtest.h>

#include "actors/executor/flight/pending_commands.hpp"
#include "tests/actors/executor/station_plans.hpp"

namespace godwit::executor {
namespace station_commands_test {

using operators::command_kind;

constexpr station here{255, 190};
constexpr station elsewhere{254, 190};

// Where a command comes.
enum class moment { ready, starting, flying, pausing, paused, landing };
constexpr std::array moments{moment::ready,   moment::starting, moment::flying,
                             moment::pausing, moment::paused,   moment::landing};
constexpr std::array commands{act_kind::stop, act_kind::command, act_kind::arm, act_kind::take_off, act_kind::hold};

flight_world::options on_command(sim::personality who) {
  return {.who = who, .start = start_policy::on_command, .arm_on_start = true};
}

testing::AssertionResult bring_to(flight_world& world, sim::personality who, moment to) {
  world.load(tests::short_mission(who));
  bool came = world.run_until_phase(phase::ready, 120);
  if (to != moment::ready) {
    (void)world.say(command_kind::start);
    came = came && world.run_until_phase(phase::starting, 5);
  }
  if (to > moment::starting) {
    came = came && world.run_until_phase(phase::flying, 60);
    world.run_for(to == moment::landing ? 0 : 4);
  }
  if (to == moment::pausing || to == moment::paused)
    (void)world.say(command_kind::pause);
  if (to == moment::paused)
    came = came && world.run_until_phase(phase::paused, 10);
  if (to == moment::landing && who != sim::personality::rover) // which only drives home
    came = came && world.run_until([&] { return progress::is_at_last_movement(world.durable().progress); }, 300);
  return came ? testing::AssertionSuccess() : testing::AssertionFailure() << world.story();
}

class station_commands : public testing::TestWithParam<sim::personality> {
protected:
  flight_world world{on_command(GetParam())};
};

TEST_P(station_commands, a_command_that_the_vehicle_refuses_leaves_everything_as_it_was) {
  for (const auto at : moments)
    for (const auto kind : commands) {
      flight_world one(on_command(GetParam()));
      ASSERT_TRUE(bring_to(one, GetParam(), at));
      const auto person_before = one.durable().person;
      const auto number = one.station_commands(kind);
      if (one.last_act_answer().verdict != act_verdict::pass)
        continue; // godwit does it, or the vehicle is so
      one.run_for(0.4);
      one.vehicle_answers(number, true);
      one.run_for(1.5);
      const auto what = std::string(io::name_of(kind)) + " at " + std::to_string(static_cast<int>(at)) + one.story();
      ASSERT_FALSE(needs_hand_back(one.durable().status.cause)) << what;
      ASSERT_EQ(one.durable().person, person_before) << what;
      if (at == moment::ready)
        (void)one.say(command_kind::start);
      if (at == moment::pausing || at == moment::paused) {
        ASSERT_TRUE(one.run_until_phase(phase::paused, 10)) << what;
        (void)one.say(command_kind::resume);
      }
      ASSERT_TRUE(one.run_until_phase(phase::done)) << what;
    }
}

TEST_P(station_commands, nothing_is_sent_while_a_command_is_pending) {
  for (const auto at : moments)
    for (const auto kind : commands) {
      flight_world one(on_command(GetParam()));
      ASSERT_TRUE(bring_to(one, GetParam(), at));
      (void)one.station_commands(kind);
      const bool stands = at == moment::ready && kind != act_kind::arm && kind != act_kind::take_off;
      if (one.last_act_answer().verdict != act_verdict::pass || stands)
        continue;
      const auto before = one.orders();
      (void)one.say(command_kind::come_home);
      (void)one.say(command_kind::start);
      (void)one.say(command_kind::resume);
      one.run_for(0.9);
      EXPECT_EQ(one.orders(), before) << io::name_of(kind) << one.story();
      EXPECT_TRUE(one.reactions().empty());
    }
}

TEST_P(station_commands, the_failsafe_sends_nothing_while_a_command_is_pending_and_acts_when_it_is_refused) {
  constexpr double ns_per_s = 1e9;
  const auto drain = [&](flight_world& which) {
    const auto came = bring_to(which, GetParam(), moment::flying);
    which.vehicle().set_battery(20, which.now_ns());
    return came;
  };
  auto slow = on_command(GetParam());
  slow.speed = 2; // it is under way when the battery has been low for long enough
  flight_world undisturbed(slow);
  flight_world one(slow);
  ASSERT_TRUE(drain(undisturbed));
  const auto since_ns = undisturbed.now_ns();
  ASSERT_TRUE(undisturbed.run_until([&] { return !undisturbed.reactions().empty(); }, 60)) << undisturbed.story();
  ASSERT_TRUE(drain(one));
  one.run_for(static_cast<double>(undisturbed.now_ns() - since_ns) / ns_per_s - 0.4);
  const auto number = one.station_commands(act_kind::stop);
  one.run_for(0.9);
  EXPECT_TRUE(one.reactions().empty()) << one.story();
  one.vehicle_answers(number, true);
  EXPECT_TRUE(one.run_until([&] { return !one.reactions().empty(); }, 2)) << one.story();
}

TEST_P(station_commands, a_command_that_the_vehicle_accepts_is_its_persons_takeover) {
  for (const auto at : {moment::starting, moment::flying, moment::pausing, moment::paused, moment::landing}) {
    flight_world one(on_command(GetParam()));
    ASSERT_TRUE(bring_to(one, GetParam(), at));
    const auto number = one.station_commands(act_kind::stop);
    EXPECT_FALSE(needs_hand_back(one.durable().status.cause)) << "not before";
    one.vehicle_answers(number, false);
    EXPECT_EQ(one.durable().status.cause, pause_cause::taken_over) << one.story();
    EXPECT_EQ(one.durable().person, here);
    const auto before = one.orders();
    one.run_for(10);
    EXPECT_EQ(one.orders(), before) << one.story();
  }
}

TEST_P(station_commands, a_vehicle_that_is_silent_for_a_second_is_a_persons) {
  ASSERT_TRUE(bring_to(world, GetParam(), moment::flying));
  (void)world.station_commands(act_kind::stop);
  world.run_for(0.9);
  EXPECT_FALSE(needs_hand_back(world.durable().status.cause)) << world.story();
  world.run_for(0.4);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  EXPECT_EQ(world.durable().person, here);
}

TEST_P(station_commands, a_refusal_that_comes_too_late_gives_nothing_back) {
  ASSERT_TRUE(bring_to(world, GetParam(), moment::flying));
  const auto number = world.station_commands(act_kind::stop);
  world.run_for(1.5);
  world.vehicle_answers(number, true);
  world.run_for(1);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
}

TEST_P(station_commands, of_two_one_that_is_accepted_counts) {
  ASSERT_TRUE(bring_to(world, GetParam(), moment::flying));
  const auto refused = world.station_commands(act_kind::stop, elsewhere);
  const auto accepted = world.station_commands(act_kind::command, here);
  world.vehicle_answers(refused, true);
  world.run_for(0.1);
  EXPECT_FALSE(needs_hand_back(world.durable().status.cause)) << "the other one is pending";
  world.vehicle_answers(accepted, false);
  EXPECT_EQ(world.durable().person, here) << world.story();
}

TEST_P(station_commands, an_operator_starts_what_a_station_wanted_to_arm_in_vain) {
  ASSERT_TRUE(bring_to(world, GetParam(), moment::ready));
  const auto number = world.station_commands(act_kind::arm);
  world.vehicle_answers(number, true);
  EXPECT_TRUE(world.say(command_kind::start).is_taken);
  EXPECT_TRUE(world.run_until_phase(phase::flying, 60)) << world.story();
}

// As MAVSDK does it, and before the vehicle has answered.
TEST_P(station_commands, arm_and_start_in_one_breath_fly_also_where_the_start_comes_before_the_vehicles_answer) {
  flight_world one(by_stations(GetParam()));
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(one, items));
  const auto number = one.station_commands(act_kind::arm);
  one.station_says(start_of(one, items));
  one.arm_by_hand();
  one.run_for(0.05);
  one.vehicle_answers(number, false);
  EXPECT_TRUE(one.run_until_phase(phase::flying, 30)) << one.story();
  EXPECT_EQ(one.start_answers().back().verdict, start_verdict::started);
  EXPECT_EQ(one.durable().person, std::nullopt);
}

TEST_P(station_commands, a_start_that_waits_ends_when_its_station_disarms) {
  flight_world one(by_stations(GetParam()));
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(one, items));
  one.arm_by_hand();
  one.run_for(1.2);
  const auto number = one.station_commands(act_kind::stop);
  one.station_says(start_of(one, items));
  one.vehicle_answers(number, false);
  const auto before = one.orders();
  one.run_for(5);
  EXPECT_EQ(one.orders(), before) << one.story();
}

// -- hold -------------------------------------------------------------------------------------------

TEST_P(station_commands, a_hold_is_answered_when_the_vehicle_has_accepted_it) {
  ASSERT_TRUE(bring_to(world, GetParam(), moment::flying));
  const auto number = world.station_commands(act_kind::hold);
  EXPECT_EQ(world.last_act_answer().verdict, act_verdict::begun);
  EXPECT_TRUE(world.resolved_acts().empty());
  ASSERT_TRUE(world.run_until([&] { return !world.resolved_acts().empty(); }, 2)) << world.story();
  EXPECT_EQ(world.resolved_acts()[0].number, number);
  EXPECT_EQ(world.resolved_acts()[0].answer.verdict, act_verdict::done);
  EXPECT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::asked);
}

TEST_P(station_commands, a_hold_that_never_comes_to_the_vehicle_is_not_called_done) {
  ASSERT_TRUE(bring_to(world, GetParam(), moment::flying));
  world.lose_command(176, 100);
  (void)world.station_commands(act_kind::hold);
  ASSERT_TRUE(world.run_until([&] { return !world.resolved_acts().empty(); }, 60)) << world.story();
  EXPECT_EQ(world.resolved_acts()[0].answer.verdict, act_verdict::refused) << world.story();
  EXPECT_FALSE(world.resolved_acts()[0].answer.reason.empty());
}

TEST_P(station_commands, a_vehicle_that_is_known_to_hold_is_answered_at_once) {
  ASSERT_TRUE(bring_to(world, GetParam(), moment::paused));
  world.run_for(2);
  (void)world.station_commands(act_kind::hold);
  EXPECT_EQ(world.last_act_answer().verdict, act_verdict::done) << world.story();
}

// The mode that is shown is older than what was sent.
TEST_P(station_commands, a_hold_right_after_a_resume_is_not_answered_by_the_mode_of_before) {
  ASSERT_TRUE(bring_to(world, GetParam(), moment::paused));
  (void)world.say(command_kind::resume);
  (void)world.station_commands(act_kind::hold);
  EXPECT_EQ(world.last_act_answer().verdict, act_verdict::begun);
  ASSERT_TRUE(world.run_until([&] { return !world.resolved_acts().empty(); }, 20)) << world.story();
  EXPECT_EQ(world.resolved_acts()[0].answer.verdict, act_verdict::done);
  EXPECT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
}

TEST_P(station_commands, a_hold_goes_on_to_the_vehicle_where_a_person_takes_it_before) {
  ASSERT_TRUE(bring_to(world, GetParam(), moment::flying));
  world.lose_command(176, 3);
  (void)world.station_commands(act_kind::hold);
  world.run_for(0.1);
  (void)world.station_does(act_kind::stream, elsewhere);
  world.run_for(0.3);
  ASSERT_EQ(world.resolved_acts().size(), 1U);
  EXPECT_EQ(world.resolved_acts()[0].answer.verdict, act_verdict::pass) << world.story();
}

TEST_P(station_commands, a_hold_in_a_start_goes_on_to_the_vehicle) {
  ASSERT_TRUE(bring_to(world, GetParam(), moment::starting));
  const auto number = world.station_commands(act_kind::hold);
  EXPECT_EQ(world.last_act_answer().verdict, act_verdict::pass);
  world.vehicle_answers(number, false);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
}

TEST_P(station_commands, a_take_off_in_flight_goes_on_to_the_vehicle) {
  ASSERT_TRUE(bring_to(world, GetParam(), moment::flying));
  (void)world.station_commands(act_kind::take_off);
  EXPECT_EQ(world.last_act_answer().verdict, act_verdict::pass) << "whether it may is the vehicle's to say";
}

TEST_P(station_commands, a_go_to_is_godwits_unless_a_person_has_the_vehicle) {
  ASSERT_TRUE(bring_to(world, GetParam(), moment::flying));
  (void)world.station_commands(act_kind::go_to);
  EXPECT_EQ(world.last_act_answer().verdict, act_verdict::own);
  EXPECT_FALSE(needs_hand_back(world.durable().status.cause));
  (void)world.station_does(act_kind::command);
  const auto number = world.station_commands(act_kind::go_to);
  EXPECT_EQ(world.last_act_answer().verdict, act_verdict::pass);
  world.vehicle_answers(number, false);
  EXPECT_EQ(world.durable().person, here) << "it keeps it";
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, station_commands,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot,
                                         sim::personality::plane),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

// -- what is pending --------------------------------------------------------------------------------

station_act numbered(std::uint64_t number) { return {act_kind::stop, here, "stop", number, true}; }

TEST(pending_commands, an_answer_to_what_is_not_known_changes_nothing) {
  pending_commands pending;
  EXPECT_FALSE(pending.begin(numbered(1), 0));
  EXPECT_FALSE(pending.acknowledge({2, false}));
  EXPECT_TRUE(pending.is_pending());
  ASSERT_TRUE(pending.acknowledge({1, false}));
  EXPECT_FALSE(pending.is_pending());
}

TEST(pending_commands, at_the_bound_the_oldest_counts_as_accepted) {
  pending_commands pending;
  for (std::uint64_t i = 0; i < pending_commands::max_pending; ++i)
    EXPECT_FALSE(pending.begin(numbered(i), 0));
  const auto oldest = pending.begin(numbered(99), 0);
  ASSERT_TRUE(oldest);
  EXPECT_EQ(oldest->number, 0U);
}

TEST(pending_commands, silence_is_judged_in_the_order_in_which_they_went_on) {
  pending_commands pending;
  (void)pending.begin(numbered(1), 0);
  (void)pending.begin(numbered(2), 5);
  EXPECT_FALSE(pending.take_silent(pending_commands::answered_within_ns - 1));
  EXPECT_EQ(pending.take_silent(pending_commands::answered_within_ns)->number, 1U);
  EXPECT_FALSE(pending.take_silent(pending_commands::answered_within_ns));
  EXPECT_EQ(pending.take_silent(pending_commands::answered_within_ns + 5)->number, 2U);
}

} // namespace station_commands_test
} // namespace godwit::executor
