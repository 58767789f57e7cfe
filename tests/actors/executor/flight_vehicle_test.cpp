// Which vehicle a flight is flown with: the one that it began with, over a kill of the process too, until the mission
// is over or a person ends it.
#include <gtest/gtest.h>

#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace flight_vehicle_test {

using operators::command_kind;
using sim::personality;
using tests::flight_world;
using vehicle_link::vehicle_name;

class flight_vehicle : public testing::TestWithParam<personality> {
protected:
  void fly() {
    world.load(tests::short_mission(GetParam()));
    ASSERT_TRUE(world.run_until([&] { return world.durable().home.has_value(); }, 300)) << world.story();
  }
  // Its own is not heard; the other one speaks.
  void hear_another(int seconds) {
    for (int i = 0; i < seconds; ++i) {
      world.another_vehicle_beats(2);
      world.run_for(1);
    }
  }

  flight_world world{{.who = GetParam()}};
};

TEST_P(flight_vehicle, is_kept_from_the_start_to_the_end_of_the_mission) {
  EXPECT_FALSE(world.kept_vehicle());
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.vehicle().describe().armed; }, 300)) << world.story();
  EXPECT_EQ(world.kept_vehicle(), (vehicle_name{1, 1})) << world.story();
  ASSERT_TRUE(world.run_until([&] { return is_over(world.durable().status.now); }, 900)) << world.story();
  world.run_for(1);
  EXPECT_FALSE(world.kept_vehicle()) << world.story();
}

TEST_P(flight_vehicle, after_a_kill_is_waited_for_and_nothing_goes_to_another_one) {
  ASSERT_NO_FATAL_FAILURE(fly());
  world.silence_vehicle(true);
  world.crash_all();
  const auto before = world.orders();
  hear_another(3);
  EXPECT_EQ(world.orders(), before) << world.story();
  EXPECT_TRUE(world.durable().status.in_flight) << world.story();
  for (const auto word : {command_kind::hand_back, command_kind::resume, command_kind::start})
    EXPECT_FALSE(world.say(word).is_taken) << world.story();
  hear_another(2);
  EXPECT_EQ(world.sent_to_others(), 0) << world.story();
  EXPECT_NE(world.sentence().find("system 2 is heard"), std::string::npos) << world.sentence();
  world.silence_vehicle(false);
  ASSERT_TRUE(world.run_until([&] { return is_over(world.durable().status.now); }, 900)) << world.story();
  EXPECT_EQ(world.reports().back().kind, mission::progress_kind::complete) << world.story();
}

TEST_P(flight_vehicle, that_does_not_come_back_is_given_up_by_a_person_and_not_before) {
  ASSERT_NO_FATAL_FAILURE(fly());
  EXPECT_FALSE(world.say(command_kind::end_flight).is_taken) << "it is heard and flies";
  world.silence_vehicle(true);
  world.crash_all();
  hear_another(10);
  EXPECT_EQ(world.kept_vehicle(), (vehicle_name{1, 1}));
  ASSERT_TRUE(world.say(command_kind::end_flight).is_taken) << world.story();
  hear_another(3);
  EXPECT_FALSE(world.kept_vehicle()) << world.story();
  EXPECT_EQ(world.durable().status.now, phase::aborted) << world.story();
  EXPECT_EQ(world.reports().back().kind, mission::progress_kind::aborted) << world.story();
  EXPECT_FALSE(world.say(command_kind::end_flight).is_taken) << "no flight is open";
}

// The line is cut as it begins: what it passes meanwhile is not flown a second time.
TEST_P(flight_vehicle, that_is_not_heard_from_its_start_on_goes_on_from_where_it_is_heard_again) {
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.durable().status.now == phase::flying; }, 300)) << world.story();
  const auto began_at = world.vehicle().describe().mission_current;
  world.silence_vehicle(true);
  ASSERT_TRUE(world.run_until([&] { return world.vehicle().describe().mission_current >= began_at + 2; }, 300));
  const auto seen_at = world.vehicle().describe().mission_current;
  world.silence_vehicle(false);
  const auto has_gone_back = [&] {
    const auto seen = world.vehicle().describe();
    return seen.armed && seen.mission_current < seen_at;
  };
  EXPECT_FALSE(world.run_until(has_gone_back, 20)) << world.story();
  ASSERT_TRUE(world.run_until([&] { return is_over(world.durable().status.now); }, 900)) << world.story();
  EXPECT_EQ(world.reports().back().kind, mission::progress_kind::complete) << world.story();
}

// It would be a vehicle without a kind, disarmed, in no mode: a pilot's, and nobody's failsafe.
TEST_P(flight_vehicle, is_not_a_program_that_speaks_under_its_ids) {
  world.load(tests::short_mission(GetParam()));
  const auto flies_on = [&] {
    world.another_program_beats();
    world.run_for(0.3);
    return is_over(world.durable().status.now);
  };
  ASSERT_TRUE(world.run_until(flies_on, 900)) << world.story();
  EXPECT_EQ(world.reports().back().kind, mission::progress_kind::complete) << world.story();
}

TEST_P(flight_vehicle, is_not_chosen_by_chance_where_two_are_on_the_line) {
  world.another_vehicle_beats(2);
  world.load(tests::short_mission(GetParam()));
  hear_another(60);
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
  EXPECT_EQ(world.durable().status.now, phase::preflight) << world.story();
  EXPECT_NE(world.sentence().find("system 2"), std::string::npos) << world.sentence();
}

INSTANTIATE_TEST_SUITE_P(each, flight_vehicle,
                         testing::Values(personality::rover, personality::px4, personality::ardupilot),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

} // namespace flight_vehicle_test
} // namespace godwit::executor
