// What an operator says goes through operator_bridge on the real composition: while that crashes or is given up, and
// while the process is killed, no command is obeyed twice, and the flight goes on.
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "tests/support/run_options.hpp"

namespace operator_commands_test {

using namespace godwit;
using namespace godwit::drill;
using namespace godwit::tests;
using executor::phase;
using operator_bridge::verdict;
using operators::command_kind;
using runtime::crash_point;
using side = flight_simulation::side;

constexpr std::array crash_points{crash_point::before_handler, crash_point::after_handler, crash_point::after_commit,
                                  crash_point::before_dispatch};

// Under the same id, again each half second as long as nobody answers.
std::optional<verdict> say(flight_simulation& flight, command_kind kind, const std::string& id) {
  operator_bridge::operator_command command;
  command.id = id;
  command.by = {"anna", operators::role::engineer, std::string(operators::local_session)};
  command.what.kind = kind;
  for (int tries = 0; tries < 20; ++tries) {
    const auto processes = flight.processes();
    if (auto* const process = flight.process()) {
      const auto answer = process->command(command);
      (void)flight.run_until([&] { return answer() || flight.processes() != processes || !flight.process(); }, 0.5);
      if (const auto is = answer())
        return is->verdict;
    }
    flight.run_for(0.1);
  }
  return std::nullopt;
}

class operator_commands : public testing::TestWithParam<sim::personality> {
protected:
  static void fly(flight_simulation& flight) {
    ASSERT_TRUE(
        flight.run_until([&] { return flight.status().now == phase::flying && !flight.reports().empty(); }, 120))
        << flight.story();
    flight.run_for(2);
  }
  static void hold(flight_simulation& flight, const std::string& id) {
    ASSERT_EQ(say(flight, command_kind::pause, id), verdict::taken) << flight.story();
    ASSERT_TRUE(flight.run_until_phase(phase::paused, 20)) << flight.story();
  }
  // A resume that was obeyed, or may have been, is not obeyed again after a hold.
  static void expect_no_second_resume(flight_simulation& flight, const std::string& id) {
    flight.run_for(2);
    if (flight.status().now != phase::paused)
      hold(flight, "hold-again");
    flight.run_for(2);
    const auto since_ns = flight.now_ns();
    EXPECT_TRUE(say(flight, command_kind::resume, id)) << flight.story();
    flight.run_for(3);
    EXPECT_EQ(moves_since(flight, since_ns), 0) << flight.story();
    // What a killed process was just about to be told can look like a pilot's doing; then it has to be handed back.
    EXPECT_TRUE(say(flight, command_kind::resume, "go-on")) << flight.story();
    EXPECT_TRUE(fly_with_help(flight)) << flight.story();
    EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
  }
};

TEST_P(operator_commands, hold_and_go_on_through_operator_bridge) {
  flight_simulation flight({.who = GetParam()});
  fly(flight);
  hold(flight, "h1");
  EXPECT_EQ(say(flight, command_kind::resume, "r1"), verdict::taken);
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
  EXPECT_EQ(say(flight, command_kind::start, "s1"), verdict::refused);
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
}

TEST_P(operator_commands, a_throw_at_any_point_of_operator_bridge_has_no_command_obeyed_twice) {
  for (const auto point : crash_points) {
    SCOPED_TRACE("point " + std::to_string(static_cast<int>(point)));
    flight_simulation flight({.who = GetParam()});
    fly(flight);
    hold(flight, "h1");
    flight.process()->crash_at("operator_bridge", point);
    EXPECT_TRUE(say(flight, command_kind::resume, "r1")) << flight.story();
    expect_no_second_resume(flight, "r1");
    if (HasFailure())
      return;
  }
}

TEST_P(operator_commands, a_kill_at_any_commit_of_a_command_has_it_not_obeyed_twice) {
  const std::uint64_t stride = is_full_run() ? 1 : 3;
  for (const auto where : {side::before, side::after})
    for (std::uint64_t commit = 1; commit <= 10; commit += stride) {
      SCOPED_TRACE("commit " + std::to_string(commit) + (where == side::before ? ", before" : ", after"));
      flight_simulation flight({.who = GetParam(), .seed = commit});
      fly(flight);
      hold(flight, "h1");
      flight.kill_process_at_commit(flight.commits() + commit, where);
      EXPECT_TRUE(say(flight, command_kind::resume, "r1")) << flight.story();
      expect_no_second_resume(flight, "r1");
      if (HasFailure())
        return;
    }
}

TEST_P(operator_commands, that_operator_bridge_is_given_up_or_hangs_touches_no_flight_and_a_hold_goes_past_it) {
  for (const bool hangs : {false, true}) {
    flight_simulation flight({.who = GetParam()});
    fly(flight);
    if (hangs)
      flight.process()->hang("operator_bridge");
    else
      (void)flight.give_up("operator_bridge");
    flight.say(command_kind::pause);
    EXPECT_TRUE(flight.run_until_phase(phase::paused, 20)) << flight.story();
    flight.say(command_kind::resume);
    EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
    EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
    EXPECT_EQ(flight.processes(), 1) << flight.story();
  }
}

// A hold of a station goes to the executor whoever has control, and while operator_bridge is gone.
TEST_P(operator_commands, a_station_moves_nothing_while_somebody_else_has_control_and_holds_whoever_has_it) {
  using io::mavlink::mav_cmd;
  constexpr int temporarily_rejected = 1;
  flight_simulation flight({.who = GetParam()});
  fly(flight);
  const operators::principal anna{"anna", operators::role::engineer, std::string(operators::local_session)};
  flight.process()->change_control({anna, operator_bridge::control_act::take, {}});
  flight.run_for(0.2);
  flight.station().command(mav_cmd::do_pause_continue, 0);
  ASSERT_TRUE(flight.run_until_phase(phase::paused, 20)) << flight.story();
  flight.run_for(0.2);
  const auto since_ns = flight.now_ns();
  flight.station().command(mav_cmd::do_pause_continue, 1);
  flight.run_for(1);
  EXPECT_EQ(flight.station().result_of(mav_cmd::do_pause_continue).value_or(255), temporarily_rejected)
      << flight.story();
  EXPECT_EQ(moves_since(flight, since_ns), 0) << flight.story();
  EXPECT_EQ(flight.status().now, phase::paused) << flight.story();
  flight.process()->change_control({anna, operator_bridge::control_act::give, {}});
  flight.run_for(0.5);
  flight.station().command(mav_cmd::do_pause_continue, 1);
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 20)) << flight.story();
  (void)flight.give_up("operator_bridge");
  flight.run_for(0.5);
  flight.station().command(mav_cmd::do_pause_continue, 0);
  ASSERT_TRUE(flight.run_until_phase(phase::paused, 20)) << flight.story();
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, operator_commands,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

} // namespace operator_commands_test
