// Whole flights of missions with items that go to the vehicle as they came: cameras, waits, jumps, splines and the rest
// of the table of commands, on each kind of simulated vehicle.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "tests/actors/executor/command_samples.hpp"
#include "tests/actors/executor/flight_checks.hpp"

namespace godwit::executor {
namespace command_items_flight_test {

using command_samples::act;
using command_samples::at_place;
using command_samples::end_of;
using command_samples::mission_with;
using command_samples::rows_flown_on_from;
using command_samples::sample_of;
using command_samples::tells_the_truth;
using command_samples::vehicle_row;
using command_samples::vehicles;
using mission::item_answer;
using mission::progress_kind;
using sim::personality;
using tests::flight_world;
using tests::is_told;

std::vector<int> commands_on(flight_world& world) {
  std::vector<int> found;
  for (const auto& each : world.vehicle().mission_items())
    found.push_back(each.command);
  return found;
}

TEST(command_items_flight, a_survey_with_its_camera_is_flown_and_its_acts_are_passed) {
  for (const auto& row : vehicles) {
    flight_world world({.who = row.who});
    const auto first = sim::drives(row.who) ? 1U : 2U;
    auto mission = mission_with(row.who, first, {act("on", 206, 5, 0, 1)});
    mission.items.insert(mission.items.begin() + first + 2, act("off", 206, 0, 0, 1));
    world.load(mission);
    ASSERT_TRUE(world.run_until_phase(phase::done, 900)) << io::name_of(row.who) << world.story();
    EXPECT_TRUE(tells_the_truth(world, mission, {{"on", progress_kind::passed}, {"off", progress_kind::passed}}))
        << io::name_of(row.who);
    const auto& held = world.vehicle().mission_items();
    EXPECT_EQ(std::ranges::count(held, 206, &io::mavlink::mission_item_int::command), 2) << io::name_of(row.who);
  }
}

TEST(command_items_flight, the_rounds_of_a_jump_are_flown_and_each_is_reported_once) {
  for (const auto& row : vehicles) {
    flight_world world({.who = row.who});
    const auto after_w3 = sim::drives(row.who) ? 3U : 4U;
    auto mission = mission_with(row.who, after_w3, {mission::jump{"again", "w1", 2}});
    if (sim::drives(row.who))
      mission.items.push_back(tests::place(row.who, "end", -20, 20));
    world.load(mission);
    std::vector<int> flown;
    const bool is_done = world.run_until(
        [&] {
          const auto seen = world.vehicle().describe();
          if (seen.armed && (flown.empty() || flown.back() != seen.mission_current))
            flown.push_back(seen.mission_current);
          return world.durable().status.now == phase::done;
        },
        1500);
    ASSERT_TRUE(is_done) << io::name_of(row.who) << world.story();
    const auto w2 = static_cast<int>(after_w3) - 2 + (row.who == personality::px4 ? 0 : 1);
    EXPECT_EQ(std::ranges::count(flown, w2), 3) << io::name_of(row.who) << " flies it three times\n" << world.story();
    EXPECT_TRUE(tells_the_truth(world, mission, {{"again", progress_kind::passed}})) << io::name_of(row.who);
    for (const auto* id : {"w1", "w2", "w3"})
      EXPECT_EQ(std::ranges::count_if(
                    world.reports(),
                    [&](const auto& each) { return each.item_id == id && each.kind == progress_kind::reached; }),
                3)
          << io::name_of(row.who) << ' ' << id << '\n'
          << world.story();
  }
}

TEST(command_items_flight, a_wait_is_no_standstill_and_is_passed) {
  for (const auto& row : vehicles) {
    flight_world world({.who = row.who});
    const auto mission = mission_with(row.who, 2, {act("wait", 93, 40)});
    world.load(mission);
    ASSERT_TRUE(world.run_until_phase(phase::done, 900)) << io::name_of(row.who) << world.story();
    EXPECT_TRUE(tells_the_truth(world, mission, {{"wait", progress_kind::passed}})) << io::name_of(row.who);
  }
}

TEST(command_items_flight, a_guarded_command_is_not_brought_to_the_vehicle) {
  flight_world world({.who = personality::ardupilot});
  world.load(mission_with(personality::ardupilot, 2, {act("p", 208, 2)}));
  EXPECT_FALSE(world.run_until_phase(phase::flying, 60)) << world.story();
  EXPECT_TRUE(world.vehicle().mission_items().size() <= 1) << world.story();
}

// Another approach, for a failure: after a landing without a take-off.
TEST(command_items_flight, what_lies_after_a_landing_is_kept_and_not_flown) {
  for (const auto& row : vehicles) {
    if (sim::drives(row.who))
      continue;
    flight_world world({.who = row.who});
    auto mission = tests::short_mission(row.who);
    mission.schema_version = mission::schema_version_2;
    auto down = at_place("down", 21, tests::place(row.who, "", 0, 0));
    down.params[6] = 0;
    mission.items.back() = down;
    mission.items.emplace_back(act("mark", 189, 0));
    mission.items.push_back(tests::place(row.who, "other", -60, 0));
    world.load(mission);
    if (row.who == personality::px4) {
      EXPECT_FALSE(world.run_until_phase(phase::flying, 20)) << "nobody has seen what it does after a landing";
      continue;
    }
    ASSERT_TRUE(world.run_until_phase(phase::done, 1200)) << io::name_of(row.who) << world.story();
    EXPECT_TRUE(tells_the_truth(world, mission, {{"mark", progress_kind::skipped}, {"other", progress_kind::skipped}}))
        << io::name_of(row.who);
    EXPECT_EQ(commands_on(world).back(), 16) << io::name_of(row.who);
    EXPECT_FALSE(world.vehicle().describe().in_air) << io::name_of(row.who) << world.story();
  }
}

// -- the rest of a mission -------------------------------------------------------------------------

operators::command go_to_beside(personality who) {
  operators::command result;
  result.kind = operators::command_kind::go_to;
  result.place = std::get<mission::waypoint>(tests::place(who, "there", 20, 20)).at;
  return result;
}

// An operator calls the vehicle away from a line with pictures, and lets it go on.
TEST(command_items_flight, a_rest_repeats_what_was_set_and_begins_the_line_anew) {
  for (const auto& row : vehicles) {
    if (row.who == personality::plane)
      continue; // which circles where it is sent to, far from the line
    flight_world world({.who = row.who});
    const auto first = sim::drives(row.who) ? 0U : 1U;
    auto mission = mission_with(row.who, first, {act("slow", 178, 1, 4, -1)});
    mission.items.insert(mission.items.begin() + first + 2, act("on", 206, 5, 0, 1));  // after w1
    mission.items.insert(mission.items.begin() + first + 4, act("off", 206, 0, 0, 1)); // after w2
    ASSERT_TRUE(tests::fly_to(world, mission, progress_kind::started, "w2")) << io::name_of(row.who);
    world.run_for(1);
    ASSERT_TRUE(world.say(go_to_beside(row.who)).is_taken) << world.story();
    world.run_for(15);
    ASSERT_TRUE(world.say(operators::command_kind::cancel).is_taken) << world.sentence() << world.story();
    ASSERT_TRUE(world.run_until([&] { return world.durable().set_aside.empty(); }, 30)) << world.story();
    world.run_for(3);
    const auto held = commands_on(world);
    const std::vector<int> rest{178, 16, 206, 16, 206, 16};
    EXPECT_NE(std::ranges::search(held, rest).begin(), held.end())
        << io::name_of(row.who) << ": speed, entry, trigger, w2, trigger off, w3\n"
        << world.story();
    ASSERT_TRUE(world.run_until_phase(phase::done, 900)) << io::name_of(row.who) << world.story();
    EXPECT_TRUE(is_told(world, progress_kind::reached, "w2")) << world.story();
    EXPECT_NE(world.story().find("DO_SET_CAM_TRIGG_DIST of item 'on' is repeated"), std::string::npos) << world.story();
  }
}

// -- each command of the table on each vehicle ----------------------------------------------------

enum class disturbance { none, executor_crash, process_kill };

// One flight; the sentence says what was wrong with it.
testing::AssertionResult flies(const vehicle_row& vehicle, const mission::command_row& row, disturbance what,
                               std::uint64_t seed) {
  flight_world world({.who = vehicle.who, .seed = seed});
  const auto sample = sample_of(row, vehicle.who);
  const auto mission = mission_with(vehicle.who, 2, {sample});
  world.load(mission);
  if (row.answer_of(vehicle.planned) == item_answer::refused) {
    if (world.run_until_phase(phase::flying, 20) || world.vehicle().mission_items().size() > 1)
      return testing::AssertionFailure() << "it is brought, and the vehicle refuses it\n" << world.story();
    return testing::AssertionSuccess();
  }
  std::mt19937_64 random(seed);
  if (what != disturbance::none) {
    if (!world.run_until_phase(phase::flying, 60))
      return testing::AssertionFailure() << "it does not begin\n" << world.story();
    world.run_for(std::uniform_real_distribution<double>(0, 30)(random));
    if (what == disturbance::executor_crash)
      world.crash();
    else
      world.crash_all();
  }
  if (!world.run_until_phase(phase::done, 1200))
    return testing::AssertionFailure() << "it does not end\n" << world.story();
  return tells_the_truth(world, mission, {{"x", end_of(row, vehicle)}});
}

TEST(command_items_flight, each_command_of_the_table_is_flown_and_reported_truthfully_or_refused_before_it_is_brought) {
  for (const auto& vehicle : vehicles)
    for (const auto* row : rows_flown_on_from())
      EXPECT_TRUE(flies(vehicle, *row, disturbance::none, 1)) << io::name_of(vehicle.who) << ' ' << row->name;
}

TEST(command_items_flight, a_crash_and_a_kill_at_any_time_change_nothing_of_what_is_reported) {
  std::uint64_t seed = 7;
  for (const auto& vehicle : vehicles)
    for (const auto* row : rows_flown_on_from())
      if (row->answer_of(vehicle.planned) != item_answer::refused)
        for (const auto what : {disturbance::executor_crash, disturbance::process_kill}) {
          ++seed;
          EXPECT_TRUE(flies(vehicle, *row, what, seed))
              << io::name_of(vehicle.who) << ' ' << row->name << " seed " << seed << ' ' << static_cast<int>(what);
        }
}

} // namespace command_items_flight_test
} // namespace godwit::executor
