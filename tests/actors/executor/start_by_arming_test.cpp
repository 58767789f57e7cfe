// A start as QGroundControl does it on a PX4: the mission mode of a vehicle that stands disarmed, and then its arming.
#include <gtest/gtest.h>

#include "tests/actors/executor/station_plans.hpp"

namespace godwit::executor {
namespace start_by_arming_test {

using flight::mode_kind;
using operators::command_kind;

constexpr station here{255, 190};
constexpr station elsewhere{254, 190};

class start_by_arming : public testing::TestWithParam<sim::personality> {
protected:
  // godwit itself arms nothing.
  static flight_world::options without_arming() {
    auto result = by_stations(GetParam());
    result.arm_on_start = false;
    return result;
  }
  flight_world world{without_arming()};
  upload items = station_items(GetParam());

  [[nodiscard]] bool is_in_mission_mode() {
    return world.heard_mode() && flight::mode_of(world.owner(), *world.heard_mode()).kind == mode_kind::mission &&
           !world.vehicle().describe().armed;
  }
  [[nodiscard]] start_mission mission_mode() const {
    auto result = start_of(world, items);
    result.by_mode = true;
    return result;
  }
  [[nodiscard]] start_verdict last_verdict() const {
    return world.start_answers().empty() ? start_verdict::failed : world.start_answers().back().verdict;
  }
  // It stands disarmed in its mission mode.
  testing::AssertionResult wait_for_arm() {
    if (const auto brought = bring(world, items); !brought)
      return brought;
    world.station_says(mission_mode());
    const bool waits = world.run_until([&] { return !world.start_answers().empty(); }, 10);
    if (!waits || last_verdict() != start_verdict::awaits_arming || !is_in_mission_mode())
      return testing::AssertionFailure() << world.story();
    return testing::AssertionSuccess();
  }
};

TEST_P(start_by_arming, the_arm_of_its_station_starts_what_stands_in_its_mission_mode) {
  ASSERT_TRUE(wait_for_arm());
  world.run_for(4);
  EXPECT_TRUE(is_in_mission_mode()) << "it is left there as long as its station may arm it";
  EXPECT_EQ(world.station_does(act_kind::arm, here).verdict, act_verdict::done);
  EXPECT_TRUE(world.run_until_phase(phase::flying, 30)) << world.story();
  EXPECT_EQ(world.durable().person, std::nullopt) << "it is godwit's flight";
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

TEST_P(start_by_arming, nobody_elses_arm_starts_it) {
  ASSERT_TRUE(wait_for_arm());
  const auto answer = world.station_does(act_kind::arm, elsewhere);
  EXPECT_EQ(answer.verdict, act_verdict::refused);
  EXPECT_NE(answer.reason.find("station 255/190"), std::string::npos) << answer.reason;
  world.run_for(30);
  EXPECT_EQ(world.durable().status.now, phase::ready) << world.story();
  EXPECT_FALSE(world.vehicle().describe().armed);
}

TEST_P(start_by_arming, a_vehicle_that_nobody_arms_is_taken_out_of_its_mission_mode) {
  ASSERT_TRUE(wait_for_arm());
  world.run_for(25);
  EXPECT_FALSE(is_in_mission_mode()) << world.story();
  EXPECT_EQ(world.durable().status.now, phase::ready);
  EXPECT_TRUE(was_said(world, "was not armed within 15 s"));
  EXPECT_EQ(world.station_does(act_kind::arm, here).verdict, act_verdict::pass) << "it is a person's as always";
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over);
}

TEST_P(start_by_arming, after_a_crash_it_is_taken_out_of_its_mission_mode_and_its_arm_starts_nothing) {
  ASSERT_TRUE(wait_for_arm());
  world.crash();
  EXPECT_TRUE(world.run_until([&] { return !is_in_mission_mode(); }, 15)) << world.story();
  world.run_for(5);
  EXPECT_EQ(world.station_does(act_kind::arm, here).verdict, act_verdict::pass);
  world.run_for(20);
  EXPECT_NE(world.durable().status.now, phase::flying) << world.story();
  EXPECT_FALSE(world.vehicle().describe().armed);
}

TEST_P(start_by_arming, a_vehicle_that_is_not_ready_any_more_is_not_armed) {
  ASSERT_TRUE(wait_for_arm());
  world.vehicle().set_battery(3, world.now_ns());
  world.run_for(3);
  const auto answer = world.station_does(act_kind::arm, here);
  EXPECT_EQ(answer.verdict, act_verdict::refused) << world.story();
  EXPECT_FALSE(answer.reason.empty());
  world.run_for(20);
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
  EXPECT_FALSE(is_in_mission_mode());
}

TEST_P(start_by_arming, another_mode_of_a_station_ends_it) {
  ASSERT_TRUE(wait_for_arm());
  EXPECT_EQ(world.station_does(act_kind::command, elsewhere).verdict, act_verdict::pass);
  EXPECT_EQ(world.station_does(act_kind::arm, here).verdict, act_verdict::pass) << "not godwit's any more";
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over);
}

TEST_P(start_by_arming, the_mission_mode_said_again_waits_anew) {
  ASSERT_TRUE(wait_for_arm());
  world.run_for(12);
  world.station_says(mission_mode());
  world.run_for(10);
  ASSERT_EQ(world.start_answers().size(), 2U);
  EXPECT_EQ(last_verdict(), start_verdict::awaits_arming);
  EXPECT_EQ(world.station_does(act_kind::arm, here).verdict, act_verdict::done) << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::flying, 30)) << world.story();
}

TEST_P(start_by_arming, who_was_armed_by_hand_before_and_stands_again_is_handed_back_with_it) {
  ASSERT_TRUE(bring(world, items));
  ASSERT_EQ(world.station_does(act_kind::arm, here).verdict, act_verdict::pass); // it never came to the vehicle
  world.run_for(5);
  world.station_says(mission_mode());
  ASSERT_TRUE(world.run_until([&] { return !world.start_answers().empty(); }, 10)) << world.story();
  EXPECT_EQ(last_verdict(), start_verdict::awaits_arming) << world.story();
  EXPECT_EQ(world.station_does(act_kind::arm, here).verdict, act_verdict::done);
  EXPECT_TRUE(world.run_until_phase(phase::flying, 30)) << world.story();
}

TEST_P(start_by_arming, a_mission_start_of_a_disarmed_vehicle_is_refused_as_before) {
  ASSERT_TRUE(bring(world, items));
  world.station_says(start_of(world, items));
  world.run_for(5);
  EXPECT_EQ(last_verdict(), start_verdict::disarmed);
  EXPECT_FALSE(is_in_mission_mode());
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, start_by_arming,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot,
                                         sim::personality::plane),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

} // namespace start_by_arming_test
} // namespace godwit::executor
