// Whole missions of an ArduPilot rover, which stays armed in its mission mode after its last item.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/flight_world.hpp"
#include "tests/support/vehicle_modes.hpp"

namespace godwit::executor {
namespace ardurover_flight_test {

using mission::progress_kind;
using operators::command_kind;
using tests::flight_world;
using tests::fly_to;
using tests::is_told;

constexpr auto rover = sim::personality::ardurover;
constexpr std::uint32_t hold = 4;
constexpr std::uint32_t automatic = 10;
constexpr std::uint32_t manual = 0;

mission::assignment tail_after_w3() {
  mission::assignment result;
  result.assignment_id = "11111111-2222-4333-8444-100000000001";
  result.base_revision = 1;
  result.revision = 2;
  result.replace_after_item_id = "w3";
  result.items = {tests::place(rover, "z", -20, 20)};
  return result;
}

// Seen as armed in its mission mode, so long after the mission is over.
bool is_left_in_mission(const flight_world& world) { return world.heard_mode() == automatic; }

TEST(ardurover_flight, after_its_mission_it_is_told_to_hold_and_stays_armed) {
  flight_world world({.who = rover});
  world.load(tests::short_mission(rover));
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
  ASSERT_TRUE(world.run_until([&] { return world.heard_mode() == hold; }, 5)) << world.story();
  EXPECT_TRUE(world.vehicle().describe().armed) << "nobody has said that it may be disarmed";
  const auto stand_bys = world.stand_bys();
  world.run_for(30);
  EXPECT_EQ(world.stand_bys(), stand_bys) << world.story();
  EXPECT_EQ(world.arms(), 1) << world.story();
}

TEST(ardurover_flight, who_has_taken_it_at_the_end_of_its_mission_is_left_alone) {
  flight_world world({.who = rover, .speed = 2});
  ASSERT_TRUE(fly_to(world, tests::short_mission(rover), progress_kind::started, "w3"));
  world.switch_mode(manual);
  ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::taken_over; }, 6))
      << world.story();
  world.switch_mode(automatic); // the person has it drive the rest
  const auto orders = world.orders();
  const auto stand_bys = world.stand_bys();
  world.run_for(120);
  EXPECT_EQ(world.vehicle().describe().mission_state, "completed") << world.story();
  EXPECT_EQ(world.orders(), orders) << world.story();
  EXPECT_EQ(world.stand_bys(), stand_bys) << world.story();
}

TEST(ardurover_flight, an_assignment_right_after_its_last_item_is_driven_or_refused_with_the_reason) {
  for (const double late_s : {0.0, 0.1, 0.5, 2.0}) {
    flight_world world({.who = rover, .speed = 2});
    ASSERT_TRUE(fly_to(world, tests::short_mission(rover), progress_kind::reached, "w3"));
    world.run_for(late_s);
    world.assign(tail_after_w3());
    ASSERT_TRUE(world.run_until([&] { return !world.answers().empty(); }, 30)) << world.story();
    const auto& answer = world.answers().front().response;
    world.run_for(60);
    const bool is_driven = is_told(world, progress_kind::reached, "z");
    EXPECT_EQ(answer.outcome == mission::assignment_outcome::accepted, is_driven) << late_s << "\n" << world.story();
    EXPECT_TRUE(is_driven || answer.reason.value_or("") != "") << late_s;
    EXPECT_EQ(world.durable().status.now, phase::done) << late_s << "\n" << world.story();
    EXPECT_FALSE(is_left_in_mission(world)) << late_s << "\n" << world.story();
  }
}

TEST(ardurover_flight, a_pause_holds_and_resume_goes_on) {
  flight_world world({.who = rover, .speed = 2});
  ASSERT_TRUE(fly_to(world, tests::short_mission(rover), progress_kind::started, "w2"));
  ASSERT_TRUE(world.say(command_kind::pause).is_taken) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  EXPECT_EQ(world.heard_mode(), hold) << world.story();
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
}

TEST(ardurover_flight, killed_at_the_end_of_its_mission_it_is_still_told_to_hold) {
  flight_world world({.who = rover});
  ASSERT_TRUE(fly_to(world, tests::short_mission(rover), progress_kind::reached, "w3"));
  world.crash_all();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_TRUE(world.run_until([&] { return world.heard_mode() == hold; }, 10)) << world.story();
}

TEST(ardurover_flight, another_mission_is_driven_by_who_was_left_armed) {
  flight_world world({.who = rover, .start = start_policy::on_command});
  auto next = tests::short_mission(rover);
  world.load(next);
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  ASSERT_TRUE(world.say(command_kind::start).is_taken) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  next.mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a43";
  world.load(next);
  ASSERT_TRUE(world.run_until_phase(phase::ready, 60)) << world.sentence() << world.story();
  ASSERT_TRUE(world.say(command_kind::start).is_taken) << world.sentence() << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
}

} // namespace ardurover_flight_test
} // namespace godwit::executor
