#include "programs/godwit-sim/vehicle/flight/mission_run.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/vehicle/flight/flight_fixture.hpp"

namespace godwit::sim::test {
namespace mission_run_test {

const plan three{waypoint(10, 0), waypoint(20, 0), waypoint(30, 0)};

mission_run loaded(const plan& items, int first_flown = 0) {
  mission_run run;
  run.load(items, first_flown);
  return run;
}

// At its item 1 of three, in STATE.
mission_run at_one(run_state state) {
  auto run = loaded(three);
  run.start(1, 1);
  if (state == run_state::idle)
    run.stop();
  else if (state == run_state::completed)
    run.advance();
  EXPECT_EQ(run.state(), state);
  EXPECT_EQ(run.current(), 1);
  return run;
}

// The sequences that are current, one after the other, when each is done at once.
std::vector<int> walk(mission_run& run, std::size_t at_most = 100) {
  std::vector<int> way;
  while (run.item() != nullptr && way.size() < at_most) {
    way.push_back(run.current());
    run.advance();
  }
  return way;
}

TEST(sim_mission_run, table_of_transitions) {
  using change = std::function<void(mission_run&)>;
  const change start = [](mission_run& run) { run.start(0); };
  const change stop = [](mission_run& run) { run.stop(); };
  const change load = [](mission_run& run) { run.load(three); };
  const change replace = [](mission_run& run) { run.replace(three, 0, 2); };
  const change set_current = [](mission_run& run) { EXPECT_TRUE(run.set_current(2)); };
  const change set_nowhere = [](mission_run& run) { EXPECT_FALSE(run.set_current(3)); };
  const change advance = [](mission_run& run) { run.advance(); };
  constexpr auto idle = run_state::idle;
  constexpr auto running = run_state::running;
  constexpr auto completed = run_state::completed;
  struct row {
    run_state from;
    const char* what;
    const change& how;
    run_state to;
    int current;
  };
  const row rows[] = {
      {idle, "start", start, running, 0},
      {idle, "stop", stop, idle, 1},
      {idle, "load", load, idle, 0},
      {idle, "replace", replace, idle, 2},
      {idle, "set_current", set_current, idle, 2},
      {idle, "set_current to no item", set_nowhere, idle, 1},
      {idle, "advance", advance, idle, 1},
      {running, "start", start, running, 0},
      {running, "stop", stop, idle, 1},
      {running, "load", load, idle, 0},
      {running, "replace", replace, running, 2},
      {running, "set_current", set_current, running, 2},
      {running, "set_current to no item", set_nowhere, running, 1},
      {running, "advance", advance, completed, 1},
      {completed, "start", start, running, 0},
      {completed, "stop", stop, idle, 1},
      {completed, "load", load, idle, 0},
      {completed, "replace", replace, idle, 2},
      {completed, "set_current", set_current, idle, 2},
      {completed, "set_current to no item", set_nowhere, completed, 1},
      {completed, "advance", advance, completed, 1},
  };
  for (const auto& row : rows) {
    auto run = at_one(row.from);
    row.how(run);
    EXPECT_EQ(run.state(), row.to) << row.what << " from state " << static_cast<int>(row.from);
    EXPECT_EQ(run.current(), row.current) << row.what << " from state " << static_cast<int>(row.from);
  }
}

TEST(sim_mission_run, without_a_plan_it_is_idle_and_nothing_can_be_current) {
  mission_run run;
  EXPECT_TRUE(run.is_empty());
  EXPECT_FALSE(run.set_current(0));
  run.advance();
  run.stop();
  EXPECT_EQ(run.state(), run_state::idle);
  EXPECT_EQ(run.item(), nullptr);
}

TEST(sim_mission_run, home_at_item_0_is_not_flown) {
  auto run = loaded(three, 1);
  EXPECT_EQ(run.current(), 1);
  EXPECT_FALSE(run.set_current(0));
  run.start(0);
  EXPECT_EQ(walk(run), (std::vector{1, 2}));
  EXPECT_TRUE(loaded({waypoint(0, 0)}, 1).is_empty());
}

TEST(sim_mission_run, it_ends_after_the_last_item_that_was_asked_for) {
  auto run = loaded(three);
  run.start(0, 1);
  EXPECT_EQ(walk(run), (std::vector{0, 1}));
  EXPECT_EQ(run.state(), run_state::completed);
  EXPECT_EQ(run.current(), 1);
}

TEST(sim_mission_run, one_item_can_be_asked_for) {
  auto run = loaded(three);
  run.start(0, 0);
  EXPECT_EQ(walk(run), (std::vector{0}));
}

TEST(sim_mission_run, set_current_beyond_the_bound_lifts_it) {
  auto run = loaded({waypoint(1, 0), waypoint(2, 0), waypoint(3, 0), waypoint(4, 0)});
  run.start(0, 1);
  EXPECT_TRUE(run.set_current(2));
  EXPECT_EQ(walk(run), (std::vector{2, 3}));
}

TEST(sim_mission_run, at_the_end_the_last_item_stays_current) {
  auto run = loaded({waypoint(1, 0), command(do_change_speed, 1, 3)});
  run.start(0);
  EXPECT_EQ(walk(run), (std::vector{0}));
  EXPECT_EQ(run.current(), 1);
}

TEST(sim_mission_run, the_commands_after_a_nav_item_belong_to_it) {
  auto run = loaded({waypoint(1, 0), command(201), command(do_change_speed), waypoint(2, 0)});
  run.start(0);
  EXPECT_EQ(run.commands_end(), 3);
  EXPECT_EQ(walk(run), (std::vector{0, 3}));
}

TEST(sim_mission_run, the_commands_in_front_of_the_first_nav_item_come_one_by_one) {
  auto run = loaded({command(201), command(202), waypoint(2, 0)});
  run.start(0);
  EXPECT_EQ(walk(run), (std::vector{0, 1, 2}));
}

TEST(sim_mission_run, commands_beyond_the_bound_belong_to_nobody) {
  auto run = loaded({waypoint(1, 0), command(201), waypoint(2, 0)});
  run.start(0, 0);
  EXPECT_EQ(run.commands_end(), 1);
}

TEST(sim_mission_run, autocontinue_0_holds_after_the_item_until_somebody_goes_on) {
  auto run = loaded({held(waypoint(1, 0)), waypoint(2, 0)});
  run.start(0);
  EXPECT_FALSE(run.goes_on());
  run.advance();
  EXPECT_TRUE(run.is_held());
  EXPECT_EQ(run.state(), run_state::running);
  EXPECT_EQ(run.current(), 0);
  EXPECT_EQ(run.item(), nullptr);
  run.advance();
  EXPECT_EQ(run.current(), 0);
  EXPECT_TRUE(run.set_current(1));
  EXPECT_FALSE(run.is_held());
  EXPECT_EQ(walk(run), (std::vector{1}));
}

TEST(sim_mission_run, autocontinue_0_of_a_command_holds_after_the_nav_item_in_front_of_it) {
  auto run = loaded({waypoint(1, 0), held(command(201)), waypoint(2, 0)});
  run.start(0);
  run.advance();
  EXPECT_TRUE(run.is_held());
}

TEST(sim_mission_run, the_last_item_does_not_hold) {
  auto run = loaded({waypoint(1, 0), held(waypoint(2, 0))});
  run.start(0);
  walk(run);
  EXPECT_EQ(run.state(), run_state::completed);
}

TEST(sim_mission_run, a_mission_of_commands_alone_ends_without_a_nav_item) {
  auto run = loaded({command(201), held(command(202))});
  run.start(0);
  EXPECT_EQ(walk(run), (std::vector{0, 1}));
  EXPECT_EQ(run.state(), run_state::completed);
}

TEST(sim_mission_run, a_jump_leads_back_as_often_as_it_says) {
  auto run = loaded({waypoint(1, 0), waypoint(2, 0), jump_to(0, 2), waypoint(3, 0)});
  run.start(0);
  EXPECT_EQ(walk(run), (std::vector{0, 1, 0, 1, 0, 1, 3}));
  run.start(1);
  EXPECT_EQ(walk(run), (std::vector{1, 0, 1, 0, 1, 3}));
}

// As recorded of both autopilots: a pause in the middle of the rounds.
TEST(sim_mission_run, a_run_that_was_stopped_has_as_many_rounds_left_as_before) {
  auto run = loaded({waypoint(1, 0), waypoint(2, 0), jump_to(0, 2), waypoint(3, 0)});
  run.start(0);
  EXPECT_EQ(walk(run, 3), (std::vector{0, 1, 0}));
  run.stop();
  run.start(0);
  EXPECT_EQ(walk(run), (std::vector{0, 1, 0, 1, 3}));
}

TEST(sim_mission_run, a_replaced_plan_keeps_the_counts_of_its_jumps_until_they_are_forgotten) {
  const std::vector plan{waypoint(1, 0), waypoint(2, 0), jump_to(0, 1), waypoint(3, 0)};
  auto run = loaded(plan);
  run.start(0);
  EXPECT_EQ(walk(run, 3), (std::vector{0, 1, 0}));
  run.replace(plan, 0, 0);
  EXPECT_EQ(walk(run), (std::vector{0, 1, 3}));
  run = loaded(plan);
  run.start(0);
  EXPECT_EQ(walk(run, 3), (std::vector{0, 1, 0}));
  run.replace(plan, 0, 0);
  run.forget_jumps();
  EXPECT_EQ(walk(run), (std::vector{0, 1, 0, 1, 3}));
}

TEST(sim_mission_run, an_inner_loop_counts_anew_in_each_outer_round_where_the_vehicle_does) {
  for (const bool anew : {false, true}) {
    auto run = loaded({waypoint(1, 0), jump_to(0, 1), waypoint(2, 0), jump_to(0, 1), waypoint(3, 0)});
    if (anew)
      run.count_left_loops_anew();
    run.start(0);
    EXPECT_EQ(walk(run), anew ? (std::vector{0, 0, 2, 0, 0, 2, 4}) : (std::vector{0, 0, 2, 0, 2, 4}));
  }
}

TEST(sim_mission_run, a_jump_without_end_goes_on_as_long_as_something_is_flown) {
  auto run = loaded({waypoint(1, 0), jump_to(0, -1)});
  run.start(0);
  EXPECT_EQ(walk(run, 1'000).size(), 1'000U);
}

TEST(sim_mission_run, jumps_in_circles_end_when_nothing_is_flown) {
  auto run = loaded({command(201), jump_to(0, -1)});
  run.start(0);
  EXPECT_EQ(walk(run).size(), 2U + mission_run::max_jumps_in_a_row);
  EXPECT_EQ(run.state(), run_state::completed);
}

TEST(sim_mission_run, a_jump_to_itself_ends) {
  auto run = loaded({waypoint(1, 0), jump_to(1, -1)});
  run.start(0);
  EXPECT_LE(walk(run).size(), 2U + mission_run::max_jumps_in_a_row);
  EXPECT_EQ(run.state(), run_state::completed);
}

TEST(sim_mission_run, a_jump_to_no_item_is_passed_over) {
  for (const float to : {-1.0F, 3.0F, 1e9F, std::numeric_limits<float>::quiet_NaN()}) {
    auto run = loaded({waypoint(1, 0), command(do_jump, to, 5), waypoint(2, 0)});
    run.start(0);
    EXPECT_EQ(walk(run), (std::vector{0, 2})) << to;
  }
}

TEST(sim_mission_run, a_jump_beyond_the_bound_ends_the_mission) {
  auto run = loaded({waypoint(1, 0), jump_to(2, 1), waypoint(2, 0)});
  run.start(0, 1);
  EXPECT_EQ(walk(run), (std::vector{0}));
  EXPECT_EQ(run.state(), run_state::completed);
}

TEST(sim_mission_run, commands_after_a_jump_that_is_taken_wait_for_the_end_of_the_jumps) {
  auto run = loaded({waypoint(1, 0), jump_to(0, 1), command(201), waypoint(2, 0)});
  run.start(0);
  EXPECT_EQ(run.commands_end(), 1);
  run.advance();
  EXPECT_EQ(run.current(), 0);
  EXPECT_EQ(run.commands_end(), 3);
}

TEST(sim_mission_run, a_replaced_plan_goes_on_at_the_given_item_or_at_its_first) {
  auto run = loaded(three);
  run.start(0);
  run.replace({waypoint(1, 0), waypoint(2, 0)}, 0, 1);
  EXPECT_EQ(run.current(), 1);
  run.replace({waypoint(1, 0), waypoint(2, 0)}, 0, 7);
  EXPECT_EQ(run.current(), 0);
  EXPECT_EQ(run.state(), run_state::running);
  run.replace({}, 0, 0);
  EXPECT_EQ(run.state(), run_state::idle);
}

TEST(sim_mission_run_death, a_start_outside_of_the_plan_is_the_callers_mistake) {
  auto run = loaded(three);
  EXPECT_DEATH(run.start(3), "one of its items");
  EXPECT_DEATH(run.start(2, 1), "one of its items");
  EXPECT_DEATH(run.start(0, 3), "one of its items");
  mission_run empty;
  EXPECT_DEATH(empty.start(0), "one of its items");
}

} // namespace mission_run_test
} // namespace godwit::sim::test
