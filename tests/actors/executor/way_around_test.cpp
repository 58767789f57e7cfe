// Whom an operator calls home or sends elsewhere keeps to the fences, and to the margin that was promised: by the track
// of the simulated vehicle.
#include "actors/executor/tasks/way_around.hpp"

#include <algorithm>
#include <iostream>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/domain/geo/polygon.hpp"
#include "actors/domain/geofence/fence.hpp"
#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/flight_world.hpp"
#include "tests/support/vehicle_modes.hpp"

namespace godwit::executor {
namespace way_around_test {

using mission::progress_kind;
using operators::command_kind;
using sim::personality;
using tests::flight_world;

constexpr double promised_m = 10; // flight.fence_margin_m
constexpr std::uint32_t mission_count = 44;
constexpr std::uint32_t global_position_int = 33;
constexpr std::uint16_t mission_start = 300;

mission::position somewhere(double north_m, double east_m, double up_m = 0) {
  return std::get<mission::waypoint>(tests::place("", north_m, east_m, up_m)).at;
}

mission::geofence box(double south_m, double west_m, double north_m, double east_m) {
  mission::geofence result{mission::fence_kind::exclusion, {}, {}, {}};
  for (const auto& [north, east] : {std::pair(south_m, west_m), std::pair(north_m, west_m), std::pair(north_m, east_m),
                                    std::pair(south_m, east_m)}) {
    const auto at = somewhere(north, east);
    result.vertices.push_back({at.latitude, at.longitude});
  }
  return result;
}

// North, east, and back south: in the middle lies what must not be flown over.
mission::document around_a_fence(personality who) {
  auto result = tests::short_mission(who);
  result.geofences = {box(20, 20, 40, 40)};
  return result;
}

class way_around : public testing::TestWithParam<personality> {
protected:
  way_around() { begin_anew(); }

  void begin_anew() {
    nearest_m_ = std::numeric_limits<double>::infinity();
    world = std::make_unique<flight_world>(flight_world::options{.who = GetParam(), .speed = 1});
  }

  // On the way from the second waypoint to the third one, which the fence lies beside.
  void fly(const mission::document& mission) {
    world->load(mission);
    ASSERT_TRUE(world->acknowledge()) << "a failsafe would return through it\n" << world->story();
    ASSERT_TRUE(run_until([&] { return is_told(progress_kind::started, "w3"); }, 600)) << world->story();
    run_for(1);
  }

  template <class Condition>
  bool run_until(Condition condition, double most_s) {
    const auto watched = [&] {
      look();
      return condition();
    };
    return world->run_until(watched, most_s);
  }
  void run_for(double seconds) {
    (void)run_until([] { return false; }, seconds);
  }
  bool run_until_phase(phase wanted, double most_s = 300) {
    return run_until([&] { return world->durable().status.now == wanted; }, most_s);
  }

  void look() {
    const auto at = world->vehicle().describe().where;
    for (const auto& each : world->durable().mission ? world->durable().mission->geofences : no_fences_) {
      const geo::polygon area(geofence::corners_of(each));
      const auto here = area.flat({at.latitude_deg, at.longitude_deg}, {at.latitude_deg, at.longitude_deg}).from;
      nearest_m_ = std::min(nearest_m_, area.flat().contains(here) ? 0 : area.flat().distance_to_sides_m(here));
    }
  }

  [[nodiscard]] bool is_told(progress_kind kind, const std::string& item) const {
    return tests::is_told(*world, kind, item);
  }
  [[nodiscard]] std::ptrdiff_t told(progress_kind kind) const {
    return std::ranges::count(world->reports(), kind, &mission::progress_report::kind);
  }
  [[nodiscard]] std::string mode() { return world->vehicle().describe().mode; }
  [[nodiscard]] bool holds() { return mode() == "AUTO.LOITER" || mode() == "BRAKE" || mode() == "HOLD"; }
  [[nodiscard]] bool returns() { return mode() == "AUTO.RTL" || mode() == "RTL"; }
  [[nodiscard]] bool is_rover() const { return GetParam() == personality::rover; }
  [[nodiscard]] double from_home_m() {
    const auto at = world->vehicle().describe().where;
    const auto home = somewhere(0, 0);
    return geo::distance_m(geo::point{at.latitude_deg, at.longitude_deg}, geo::point{home.latitude, home.longitude});
  }
  [[nodiscard]] double up_m() const { return is_rover() ? 0 : 25; }
  [[nodiscard]] bool was_said(const std::string& part) const { return world->story().find(part) != std::string::npos; }

  std::unique_ptr<flight_world> world;
  double nearest_m_ = std::numeric_limits<double>::infinity();

private:
  std::vector<mission::geofence> no_fences_;
};

// -- come-home ------------------------------------------------------------------------------------------

class come_home : public way_around {};

TEST_P(come_home, goes_around_an_exclusion_fence) {
  fly(around_a_fence(GetParam()));
  const auto reached = told(progress_kind::reached);
  const auto orders = world->orders();
  const auto generation = world->durable().progress.last_generation;
  ASSERT_TRUE(world->say(command_kind::come_home).is_taken);
  EXPECT_GT(world->orders(), orders) << "it is told to hold in the turn in which it is said";
  ASSERT_TRUE(run_until([&] { return holds(); }, 3)) << world->story();
  ASSERT_TRUE(run_until_phase(phase::landing, 6)) << world->story();
  EXPECT_FALSE(returns()) << world->story();
  EXPECT_GT(world->durable().progress.last_generation, generation) << "a plan of its own";
  ASSERT_TRUE(run_until_phase(phase::aborted)) << world->story();
  std::cout << "nearest to the fence: " << nearest_m_ << " m\n";
  EXPECT_GE(nearest_m_, promised_m) << world->story();
  EXPECT_LE(from_home_m(), 8) << world->story();
  EXPECT_FALSE(world->vehicle().describe().in_air);
  if (is_rover()) {
    EXPECT_TRUE(holds()) << mode();
  }
  EXPECT_EQ(told(progress_kind::reached), reached) << "what it flies by is no progress\n" << world->story();
  EXPECT_EQ(told(progress_kind::skipped), 0) << world->story();
  EXPECT_EQ(told(progress_kind::aborted), 1) << world->story();
}

TEST_P(come_home, returns_at_once_where_no_fence_lies_in_the_way) {
  auto mission = tests::short_mission(GetParam());
  mission.geofences = {box(-60, 20, -40, 40)};
  world->load(mission);
  ASSERT_TRUE(run_until([&] { return is_told(progress_kind::started, "w3"); }, 600)) << world->story();
  const auto orders = world->orders();
  const auto generation = world->durable().progress.last_generation;
  ASSERT_TRUE(world->say(command_kind::come_home).is_taken);
  EXPECT_EQ(world->orders(), orders + 1);
  ASSERT_TRUE(run_until([&] { return returns(); }, 1)) << world->story();
  ASSERT_TRUE(run_until_phase(phase::aborted)) << world->story();
  EXPECT_EQ(world->durable().progress.last_generation, generation) << "no plan is brought";
}

TEST_P(come_home, returns_at_once_where_no_way_is_flown_within_5_s) {
  fly(around_a_fence(GetParam()));
  world->lose_message(mission_count);
  const auto said_ns = world->now_ns();
  ASSERT_TRUE(world->say(command_kind::come_home).is_taken);
  ASSERT_TRUE(run_until([&] { return holds(); }, 3)) << world->story();
  ASSERT_TRUE(run_until([&] { return returns(); }, 10)) << world->story();
  EXPECT_LE(world->now_ns() - said_ns, 5'300'000'000) << world->story();
  EXPECT_TRUE(was_said("returns straight home")) << "people are told\n" << world->story();
  world->lose_message(0);
  if (is_rover()) // its failsafe holds it in the fence
    return;
  ASSERT_TRUE(run_until_phase(phase::aborted)) << world->story();
  EXPECT_LE(from_home_m(), 8) << world->story();
}

TEST_P(come_home, is_straight_with_a_low_battery) {
  fly(around_a_fence(GetParam()));
  world->vehicle().set_battery(24, world->now_ns());
  run_for(2);
  ASSERT_TRUE(world->reactions().empty()) << "it is the word that returns";
  ASSERT_TRUE(world->say(command_kind::come_home).is_taken);
  ASSERT_TRUE(run_until([&] { return returns(); }, 1)) << world->story();
  EXPECT_TRUE(was_said("the battery is low")) << world->story();
}

TEST_P(come_home, is_straight_where_it_is_not_known_where_the_vehicle_is) {
  fly(around_a_fence(GetParam()));
  world->lose_message(global_position_int);
  run_for(4);
  const auto orders = world->orders();
  ASSERT_TRUE(world->say(command_kind::come_home).is_taken);
  run_for(1);
  EXPECT_GT(world->orders(), orders);
  EXPECT_TRUE(was_said("does not report where it is")) << world->story();
  EXPECT_FALSE(was_said("it holds, and then flies around")) << world->story();
}

TEST_P(come_home, said_again_on_the_way_changes_nothing) {
  fly(around_a_fence(GetParam()));
  ASSERT_TRUE(world->say(command_kind::come_home).is_taken);
  run_for(0.3);
  EXPECT_TRUE(world->say(command_kind::come_home).is_taken);
  ASSERT_TRUE(run_until_phase(phase::landing, 6)) << world->story();
  const auto generation = world->durable().progress.last_generation;
  run_for(3);
  const auto orders = world->orders();
  EXPECT_TRUE(world->say(command_kind::come_home).is_taken);
  run_for(1);
  EXPECT_EQ(world->orders(), orders) << world->story();
  ASSERT_TRUE(run_until_phase(phase::aborted)) << world->story();
  EXPECT_EQ(world->durable().progress.last_generation, generation);
  EXPECT_GE(nearest_m_, promised_m) << world->story();
}

TEST_P(come_home, a_pause_on_the_way_holds_and_the_next_word_goes_around_as_well) {
  for (const double after_s : {0.2, 1.5, 8.0}) {
    SCOPED_TRACE(after_s);
    begin_anew();
    fly(around_a_fence(GetParam()));
    ASSERT_TRUE(world->say(command_kind::come_home).is_taken);
    run_for(after_s);
    ASSERT_TRUE(world->say(command_kind::pause).is_taken) << world->story();
    ASSERT_TRUE(run_until_phase(phase::paused, 10)) << world->story();
    run_for(15);
    EXPECT_TRUE(holds()) << world->story();
    EXPECT_EQ(world->durable().status.now, phase::paused) << world->story();
    ASSERT_TRUE(world->say(command_kind::come_home).is_taken) << world->story();
    ASSERT_TRUE(run_until_phase(phase::aborted)) << world->story();
    EXPECT_GE(nearest_m_, promised_m) << world->story();
    EXPECT_LE(from_home_m(), 8) << world->story();
  }
}

TEST_P(come_home, said_while_a_pause_on_the_way_is_not_obeyed_yet_is_the_last_word) {
  fly(around_a_fence(GetParam()));
  ASSERT_TRUE(world->say(command_kind::come_home).is_taken);
  ASSERT_TRUE(run_until_phase(phase::landing, 6)) << world->story();
  run_for(2);
  world->lose_command(176, 3); // DO_SET_MODE
  ASSERT_TRUE(world->say(command_kind::pause).is_taken) << world->story();
  run_for(0.3);
  ASSERT_EQ(world->durable().status.now, phase::pausing) << world->story();
  world->lose_command(0, 0);
  ASSERT_TRUE(world->say(command_kind::come_home).is_taken) << world->story();
  EXPECT_TRUE(run_until_phase(phase::aborted)) << world->story();
  EXPECT_LE(from_home_m(), 8) << world->story();
}

TEST_P(come_home, a_pilot_who_takes_it_on_the_way_has_it) {
  fly(around_a_fence(GetParam()));
  ASSERT_TRUE(world->say(command_kind::come_home).is_taken);
  ASSERT_TRUE(run_until_phase(phase::landing, 6)) << world->story();
  run_for(2);
  world->switch_mode(tests::pilot_mode(GetParam()));
  ASSERT_TRUE(run_until([&] { return world->durable().status.cause == pause_cause::taken_over; }, 6)) << world->story();
  const auto orders = world->orders();
  run_for(20);
  EXPECT_EQ(world->orders(), orders) << world->story();
}

// Whatever dies, and when: it comes home around the fence, or stands with a reason until somebody says the command
// again.
TEST_P(come_home, a_crash_at_any_moment_ends_at_home_or_in_a_hold_with_a_reason) {
  int straight = 0;
  for (const bool is_whole : {false, true})
    for (int moment = 0; moment < 30; ++moment) {
      SCOPED_TRACE(std::to_string(moment) + (is_whole ? " godwit" : " executor"));
      begin_anew();
      fly(around_a_fence(GetParam()));
      ASSERT_TRUE(world->say(command_kind::come_home).is_taken);
      run_for(0.15 * moment);
      const auto starts = std::ranges::count(world->commands(), mission_start);
      is_whole ? world->crash_all() : world->crash();
      const auto is_over = [&] {
        const auto at = world->durable().status;
        return at.now == phase::aborted || (at.now == phase::paused && !at.reason.empty() && holds());
      };
      ASSERT_TRUE(run_until(is_over, 120)) << world->story();
      EXPECT_EQ(std::ranges::count(world->commands(), mission_start), starts) << "nothing starts by a restart";
      if (world->durable().status.now == phase::paused) {
        run_for(10);
        EXPECT_TRUE(holds()) << world->story();
        ASSERT_TRUE(world->say(command_kind::come_home).is_taken) << world->story();
        ASSERT_TRUE(run_until_phase(phase::aborted)) << world->story();
      }
      EXPECT_LE(from_home_m(), 8) << world->story();
      EXPECT_FALSE(is_told(progress_kind::reached, "w3")) << world->story();
      if (was_said("returns straight home")) // an upload that a killed process began is resolved first, and late
        ++straight;
      else
        EXPECT_GE(nearest_m_, promised_m) << world->story();
    }
  EXPECT_LE(straight, 6) << "of 60";
}

// -- goto and cancel ------------------------------------------------------------------------------------

operators::command go_there(const mission::position& to) {
  operators::command result;
  result.kind = command_kind::go_to;
  result.place = to;
  return result;
}

class go_to : public way_around {};

TEST_P(go_to, keeps_the_promised_margin_at_corners) {
  fly(around_a_fence(GetParam()));
  const auto answer = world->say(go_there(somewhere(5, 5, up_m())));
  ASSERT_TRUE(answer.is_taken) << answer.reason;
  ASSERT_TRUE(run_until([&] { return world->durable().mission->revision == 2; }, 60)) << world->story();
  ASSERT_TRUE(run_until([&] { return from_home_m() < 10; }, 120)) << world->story();
  std::cout << "nearest to the fence: " << nearest_m_ << " m\n";
  EXPECT_GE(nearest_m_, promised_m) << world->story();
}

class cancel : public way_around {};

TEST_P(cancel, finds_the_way_that_goto_finds) {
  fly(around_a_fence(GetParam()));
  ASSERT_TRUE(world->say(go_there(somewhere(5, 5, up_m()))).is_taken);
  ASSERT_TRUE(run_until([&] { return world->durable().mission->revision == 2; }, 60)) << world->story();
  ASSERT_TRUE(run_until([&] { return from_home_m() < 10; }, 120)) << world->story();
  auto mission = *world->durable().mission;
  const auto answer = world->say(command_kind::cancel);
  ASSERT_TRUE(answer.is_taken) << answer.reason;
  ASSERT_TRUE(run_until([&] { return is_told(progress_kind::reached, "w3"); }, 300)) << world->story();
  ASSERT_TRUE(run_until_phase(phase::done)) << world->story();
  std::cout << "nearest to the fence: " << nearest_m_ << " m\n";
  EXPECT_GE(nearest_m_, promised_m) << world->story();
}

// After a wall as wide as the field: from the place where it was sent to the next item there is no straight way.
TEST_P(cancel, goes_around_a_fence_that_lies_between_the_vehicle_and_its_mission) {
  auto mission = tests::short_mission(GetParam());
  mission.geofences = {box(20, 15, 40, 42)};
  fly(mission);
  ASSERT_TRUE(world->say(command_kind::pause).is_taken);
  ASSERT_TRUE(run_until_phase(phase::paused, 10)) << world->story();
  ASSERT_TRUE(world->say(go_there(somewhere(30, -10, up_m()))).is_taken);
  ASSERT_TRUE(run_until([&] { return world->durable().mission->revision == 2; }, 60)) << world->story();
  run_for(120);
  const auto answer = world->say(command_kind::cancel);
  ASSERT_TRUE(answer.is_taken) << answer.reason;
  ASSERT_TRUE(run_until([&] { return is_told(progress_kind::reached, "w3"); }, 300)) << world->story();
  EXPECT_GE(nearest_m_, promised_m) << world->story();
}

constexpr auto all = {personality::px4, personality::ardupilot, personality::rover};
INSTANTIATE_TEST_SUITE_P(each, come_home, testing::ValuesIn(all));
INSTANTIATE_TEST_SUITE_P(each, go_to, testing::ValuesIn(all));
INSTANTIATE_TEST_SUITE_P(each, cancel, testing::ValuesIn(all));

} // namespace way_around_test
} // namespace godwit::executor
