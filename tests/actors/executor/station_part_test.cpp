// A station starts a part of its plan: from one item to another, on the ground and in flight (FR-00089).
#include <limits>

#include "tests/actors/executor/station_plans.hpp"

namespace godwit::executor {
namespace station_part_test {

class part_by_station : public testing::TestWithParam<sim::personality> {
protected:
  [[nodiscard]] static bool drives() { return GetParam() == sim::personality::rover; }
  // Of its two waypoints, in station_items.
  [[nodiscard]] static std::uint16_t first_waypoint() { return drives() ? 1 : 2; }

  start_mission start(std::uint16_t first, std::uint16_t last) {
    auto result = start_of(world, items);
    result.first = first;
    result.last = last;
    world.station_says(result);
    return result;
  }
  // The answer to the start that was said last.
  [[nodiscard]] testing::AssertionResult is_answered(start_verdict wanted, double within_s = 20) {
    const auto so_far = answers_seen_;
    if (!world.run_until([&] { return world.start_answers().size() > so_far; }, within_s))
      return testing::AssertionFailure() << "no answer. " << world.story();
    answers_seen_ = world.start_answers().size();
    const auto& last = world.start_answers().back();
    return last.verdict == wanted ? testing::AssertionSuccess()
                                  : testing::AssertionFailure()
                                        << io::name_of(last.verdict) << ": " << last.reason << "\n"
                                        << world.story();
  }
  // It waits in the air there; a rover has done its mission.
  [[nodiscard]] bool runs_until_part_is_done() {
    return world.run_until(
        [&] {
          const auto& status = world.durable().status;
          return drives() ? status.now == phase::done : status.cause == pause_cause::plan_ended;
        },
        600);
  }

  // In real time: a part of one item is not over before it is seen to begin.
  [[nodiscard]] static flight_world::options in_real_time() {
    auto result = by_stations(GetParam());
    result.speed = 1;
    return result;
  }

  flight_world world{in_real_time()};
  upload items = station_items(GetParam());

private:
  std::size_t answers_seen_ = 0;
};

using io::mavlink::mission_state;
using numbers = std::vector<std::uint16_t>;

// -- on the ground --------------------------------------------------------------------------------

TEST_P(part_by_station, FR_00089_a_last_item_before_the_end_ends_the_flight_there) {
  ASSERT_TRUE(bring(world, items));
  const auto last = first_waypoint();
  start(0, last);
  ASSERT_TRUE(is_answered(start_verdict::started));
  ASSERT_TRUE(runs_until_part_is_done()) << world.story();
  EXPECT_EQ(world.shown_reached(), drives() ? (numbers{0, 1}) : (numbers{0, 1, 2})) << "in the station's numbers";
  EXPECT_EQ(world.shown_progress().back().plan_id, io::mavlink::checksum_of(items));
  EXPECT_EQ(world.shown_progress().back().current, last);
  EXPECT_TRUE(world.shown_items().empty()) << "the station goes on seeing its own plan";
  EXPECT_TRUE(world.reactions().empty());
}

TEST_P(part_by_station, FR_00089_what_flies_begins_with_the_take_off_and_goes_on_with_the_item_that_is_named) {
  ASSERT_TRUE(bring(world, items));
  const auto second = static_cast<std::uint16_t>(first_waypoint() + 1);
  start(second, static_cast<std::uint16_t>(items.size() - 1));
  ASSERT_TRUE(is_answered(start_verdict::started));
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.shown_reached(), drives() ? (numbers{2}) : (numbers{0, 3, 4})) << world.story();
  EXPECT_TRUE(drives() || was_said(world, "items 3 to 4 of 5 are prepared, after the take-off")) << world.story();
}

TEST_P(part_by_station, a_plan_without_a_take_off_before_the_item_is_not_begun_there) {
  if (drives())
    return;
  auto plain = items;
  plain.erase(plain.begin()); // stations may leave the take-off to a person, and then nothing of it is flown here
  items = numbered(plain);
  world.station_says(taken(items));
  world.run_for(10);
  start(1, 2);
  EXPECT_TRUE(is_answered(start_verdict::not_ready));
  EXPECT_FALSE(world.vehicle().describe().armed);
}

TEST_P(part_by_station, the_whole_plan_is_flown_after_a_part_of_it) {
  ASSERT_TRUE(bring(world, items));
  start(0, first_waypoint());
  ASSERT_TRUE(is_answered(start_verdict::started));
  ASSERT_TRUE(runs_until_part_is_done()) << world.story();
  world.run_for(3); // a PX4 holds by itself after the last item, and shows it with its next heartbeat
  const auto end = static_cast<std::uint16_t>(items.size() - 1);
  if (drives()) { // it has ended: another flight
    start(0, end);
    ASSERT_TRUE(is_answered(start_verdict::not_ready));
    ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  }
  start(0, end);
  ASSERT_TRUE(is_answered(start_verdict::started));
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.shown_reached().back(), end) << world.story();
  EXPECT_EQ(world.shown_progress().back().state, mission_state::complete);
}

TEST_P(part_by_station, a_part_that_was_flown_to_its_end_is_prepared_anew_and_flown_again) {
  ASSERT_TRUE(bring(world, items));
  const auto second = static_cast<std::uint16_t>(first_waypoint() + (drives() ? 0 : 1));
  const auto end = static_cast<std::uint16_t>(items.size() - 1);
  start(second, end);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  ASSERT_TRUE(is_answered(start_verdict::started));
  start(second, end);
  ASSERT_TRUE(is_answered(start_verdict::not_ready)) << "it is prepared anew";
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  start(second, end);
  ASSERT_TRUE(is_answered(start_verdict::started));
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.shown_reached(), drives() ? (numbers{1, 2, 1, 2}) : (numbers{0, 3, 4, 0, 3, 4})) << world.story();
}

// FR_00089: a rover that stands takes it as one that is disarmed does.
TEST_P(part_by_station, an_armed_vehicle_that_flies_is_brought_no_other_part) {
  ASSERT_TRUE(bring(world, items));
  world.arm_by_hand();
  ASSERT_TRUE(world.run_until([&] { return world.vehicle().describe().armed; }, 10));
  world.run_for(1.5);
  const auto orders = world.orders();
  start(0, first_waypoint());
  ASSERT_TRUE(is_answered(drives() ? start_verdict::started : start_verdict::not_ready));
  if (!drives()) {
    EXPECT_EQ(world.orders(), orders) << world.story();
  }
}

TEST_P(part_by_station, who_may_not_arm_prepares_it_and_says_so) {
  auto wanted = by_stations(GetParam());
  wanted.arm_on_start = false;
  flight_world unarmed(wanted);
  ASSERT_TRUE(bring(unarmed, items));
  const auto half = [&] {
    auto result = start_of(unarmed, items);
    result.last = first_waypoint();
    return result;
  };
  unarmed.station_says(half());
  ASSERT_TRUE(unarmed.run_until([&] { return !unarmed.start_answers().empty(); }, 20)) << unarmed.story();
  EXPECT_EQ(unarmed.start_answers().back().verdict, start_verdict::disarmed);
  ASSERT_EQ(unarmed.station_does(act_kind::arm).verdict, act_verdict::pass);
  unarmed.arm_by_hand();
  unarmed.station_says(half());
  EXPECT_TRUE(unarmed.run_until_phase(phase::flying, 30)) << unarmed.story();
  EXPECT_EQ(unarmed.start_answers().back().verdict, start_verdict::started);
}

TEST_P(part_by_station, a_crash_while_it_is_prepared_starts_nothing) {
  ASSERT_TRUE(bring(world, items));
  start(0, first_waypoint());
  world.crash_all();
  world.run_for(30);
  EXPECT_EQ(world.durable().status.cause, pause_cause::restarted) << world.story();
  EXPECT_FALSE(world.vehicle().describe().armed);
  ASSERT_TRUE(world.say(operators::command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  start(0, first_waypoint());
  ASSERT_TRUE(is_answered(start_verdict::started));
}

TEST_P(part_by_station, who_takes_the_vehicle_while_it_is_prepared_has_it_and_the_start_is_refused) {
  ASSERT_TRUE(bring(world, items));
  start(0, first_waypoint());
  ASSERT_TRUE(world.start_answers().empty());
  ASSERT_EQ(world.station_does(act_kind::arm, {254, 190}).verdict, act_verdict::pass);
  ASSERT_TRUE(is_answered(start_verdict::not_ready, 1));
  const auto commands = world.commands().size();
  world.run_for(20);
  EXPECT_EQ(world.commands().size(), commands) << world.story();
}

TEST_P(part_by_station, another_plan_that_comes_while_it_is_prepared_is_not_started) {
  ASSERT_TRUE(bring(world, items));
  start(0, first_waypoint());
  auto other = items;
  other.insert(other.begin() + first_waypoint(), waypoint_at(GetParam(), 30, 30));
  world.station_says(taken(numbered(other)));
  ASSERT_TRUE(is_answered(start_verdict::no_such_item));
  world.run_for(20);
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
}

TEST_P(part_by_station, a_vehicle_that_takes_no_plan_is_not_started_with_the_one_before) {
  ASSERT_TRUE(bring(world, items));
  world.lose_message(io::mavlink::mission_count::message_id);
  start(0, first_waypoint());
  ASSERT_TRUE(is_answered(start_verdict::not_ready));
  world.lose_message(0);
  world.run_for(60);
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
}

TEST_P(part_by_station, a_mission_of_the_service_is_flown_to_its_end) {
  flight_world other({.who = GetParam(), .start = start_policy::on_command});
  other.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(other.run_until_phase(phase::ready)) << other.story();
  auto half = start_of(other, other.shown_items());
  half.last = 1;
  other.station_says(half);
  ASSERT_EQ(other.start_answers().size(), 1U);
  EXPECT_EQ(other.start_answers().back().verdict, start_verdict::no_such_item);
}

// -- in flight ------------------------------------------------------------------------------------

TEST_P(part_by_station, FR_00089_a_start_in_flight_ends_it_at_the_item_that_is_named) {
  ASSERT_TRUE(bring(world, items));
  world.station_says(start_of(world, items));
  ASSERT_TRUE(is_answered(start_verdict::started));
  ASSERT_TRUE(world.run_until([&] { return world.shown_progress().back().current == first_waypoint(); }, 600))
      << world.story();
  start(first_waypoint(), first_waypoint());
  ASSERT_TRUE(is_answered(start_verdict::started));
  ASSERT_TRUE(runs_until_part_is_done()) << world.story();
  EXPECT_EQ(world.shown_reached().back(), first_waypoint()) << world.story();
  EXPECT_TRUE(world.shown_items().empty()) << "the station goes on seeing its own plan";
  EXPECT_TRUE(world.reactions().empty());
}

TEST_P(part_by_station, in_flight_it_goes_back_to_an_item_that_the_part_on_the_vehicle_does_not_have) {
  ASSERT_TRUE(bring(world, items));
  const auto second = static_cast<std::uint16_t>(first_waypoint() + 1);
  const auto end = static_cast<std::uint16_t>(items.size() - 1);
  if (second == end)
    return; // the rover's plan ends there
  start(second, end);
  ASSERT_TRUE(is_answered(start_verdict::started));
  ASSERT_TRUE(world.run_until([&] { return world.shown_progress().back().current == second; }, 600)) << world.story();
  start(first_waypoint(), end);
  ASSERT_TRUE(is_answered(start_verdict::started));
  EXPECT_TRUE(world.run_until([&] { return world.shown_progress().back().current == first_waypoint(); }, 5))
      << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.shown_reached(), (numbers{0, 2, 3, 4})) << world.story();
}

TEST_P(part_by_station, a_flight_that_is_paused_in_its_part_goes_on_to_the_end_of_the_part) {
  ASSERT_TRUE(bring(world, items));
  start(0, first_waypoint());
  ASSERT_TRUE(is_answered(start_verdict::started));
  ASSERT_TRUE(world.run_until([&] { return world.shown_progress().back().current == first_waypoint(); }, 600));
  ASSERT_TRUE(world.say(operators::command_kind::pause).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 20)) << world.story();
  start(0, static_cast<std::uint16_t>(items.size() - 1));
  ASSERT_TRUE(is_answered(start_verdict::started));
  ASSERT_TRUE(runs_until_part_is_done()) << world.story();
  EXPECT_EQ(world.shown_reached().back(), first_waypoint()) << world.story();
}

TEST_P(part_by_station, a_crash_while_a_part_is_brought_in_flight_ends_in_a_flight_or_a_pause) {
  for (const double after_s : {0.05, 0.3, 1.0, 2.0}) {
    flight_world crashes(in_real_time());
    ASSERT_TRUE(bring(crashes, items));
    crashes.station_says(start_of(crashes, items));
    ASSERT_TRUE(crashes.run_until([&] { return crashes.shown_progress().back().current == first_waypoint(); }, 600));
    auto half = start_of(crashes, items);
    half.first = half.last = first_waypoint();
    crashes.station_says(half);
    crashes.run_for(after_s);
    crashes.crash_all();
    EXPECT_TRUE(crashes.run_until(
        [&] {
          const auto at = crashes.durable().status.now;
          return at == phase::done || at == phase::paused;
        },
        600))
        << after_s << ": " << crashes.story();
    EXPECT_EQ(crashes.start_answers().size(), 2U) << after_s << ": it is answered once";
  }
}

TEST_P(part_by_station, while_the_plan_may_not_be_changed_it_is_refused) {
  ASSERT_TRUE(bring(world, items));
  world.station_says(start_of(world, items));
  ASSERT_TRUE(is_answered(start_verdict::started));
  ASSERT_TRUE(world.run_until([&] { return world.shown_progress().back().current == first_waypoint(); }, 600));
  world.lose_failsafe(true);
  const auto orders = world.orders();
  start(first_waypoint(), first_waypoint());
  ASSERT_TRUE(is_answered(start_verdict::not_ready, 1));
  EXPECT_EQ(world.orders(), orders);
}

INSTANTIATE_TEST_SUITE_P(each, part_by_station,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::rover,
                                         sim::personality::plane),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

} // namespace station_part_test
} // namespace godwit::executor
