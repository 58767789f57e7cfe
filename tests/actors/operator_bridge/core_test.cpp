// What operator_bridge decides about commands.
#include "actors/operator_bridge/core.hpp"

#include <tuple>

#include <gtest/gtest.h>

#include "actors/operator_bridge/presence.hpp"
#include "tests/actors/operator_bridge/bridge_world.hpp"

namespace godwit::operator_bridge::tests {
namespace operator_bridge_core_test {

using operators::command_kind;
using operators::role;

TEST(operator_bridge_core,
     a_command_of_who_has_control_is_handed_over_when_it_is_written_and_answered_as_the_executor_says) {
  bridge_world world;
  const auto anna = world.pilot();
  const auto request = world.say(world.command(anna, command_kind::start, "a1"));
  EXPECT_TRUE(world.handed.empty());
  world.write();
  ASSERT_EQ(world.handed.size(), 1U);
  EXPECT_EQ(world.handed[0].what.by, "anna");
  world.answer(world.handed[0].number, {false, "not ready", {}});
  EXPECT_EQ(world.answers.at(request), (command_answer{verdict::refused, "not ready"}));
  EXPECT_EQ(world.outcomes().back(), "refused");
}

TEST(operator_bridge_core, what_the_executor_advises_goes_to_the_sender_and_into_the_audit_and_is_said_again) {
  bridge_world world;
  const auto anna = world.pilot();
  const auto request = world.say(world.command(anna, command_kind::start, "a1"));
  world.write();
  world.answer(world.handed[0].number, {true, {}, {}, "another aircraft is near"});
  world.write();
  EXPECT_EQ(world.answers.at(request), (command_answer{verdict::taken, "another aircraft is near"}));
  EXPECT_EQ(world.outcomes().back(), "taken");
  const auto again = world.say(world.command(anna, command_kind::start, "a1"));
  world.write();
  EXPECT_EQ(world.answers.at(again), world.answers.at(request));
}

TEST(operator_bridge_core, a_command_for_another_state_is_stale_and_says_how_the_flight_stands) {
  bridge_world world;
  const auto request = world.say(world.command(world.pilot(), command_kind::start, "a1"));
  world.write();
  world.answer(world.handed[0].number, {false, "the flight stands otherwise by now", "paused/asked/m/1/1/0"});
  EXPECT_EQ(world.answers.at(request).verdict, verdict::stale);
  EXPECT_EQ(world.answers.at(request).state, "paused/asked/m/1/1/0");
}

TEST(operator_bridge_core,
     command_without_session_expired_replayed_wrong_role_without_control_or_late_has_no_effect_and_one_row_each) {
  bridge_world world;
  const auto anna = world.pilot();
  const auto bob = world.log_in("bob");
  const auto eve = world.log_in("eve", role::viewer);
  ASSERT_EQ(world.say_all_the_way(world.command(anna, command_kind::start, "first")), verdict::taken);
  const auto handed = world.handed.size();

  const auto expect = [&](const operator_command& m, verdict wanted) {
    const auto rows = world.rows();
    EXPECT_EQ(world.say_all_the_way(m), wanted) << io::name_of(wanted);
    EXPECT_EQ(world.rows(), rows + 1) << io::name_of(wanted);
    EXPECT_EQ(world.handed.size(), handed) << io::name_of(wanted);
  };
  expect(world.command({"mallory", role::engineer, "s99"}, command_kind::resume), verdict::no_session);
  expect(world.command({"anna", role::engineer, anna.session}, command_kind::resume), verdict::no_session);
  expect(world.command(eve, command_kind::resume, "e1"), verdict::wrong_role);
  expect(world.command(eve, command_kind::pause, "e2"), verdict::wrong_role);
  expect(world.command(bob, command_kind::resume, "b1"), verdict::no_control);
  expect(world.command(anna, command_kind::start, "first"), verdict::taken); // as the first time
  expect(world.command(anna, command_kind::resume, "first"), verdict::id_used);
  auto late = world.command(anna, command_kind::resume, "late");
  late.valid_until_ns = world.now.wall_ns - 1;
  expect(late, verdict::late);
  auto early = world.command(anna, command_kind::resume, "early");
  early.valid_until_ns = world.now.wall_ns + core::longest_validity_ns + 1;
  expect(early, verdict::refused);
  world.pass(world.set.session_idle_s * s);
  expect(world.command(anna, command_kind::resume, "a9"), verdict::no_session); // expired
}

TEST(operator_bridge_core, leave_for_what_is_no_command_has_the_rules_of_one_and_a_refusal_is_one_row) {
  bridge_world world;
  const auto anna = world.pilot();
  const auto bob = world.log_in("bob");
  const auto eve = world.log_in("eve", role::viewer);
  const auto ask = [&](const operators::principal& by) {
    const auto [wanted, answer] = world.decides().on_leave({by, "confirm point 3"}, world.now);
    world.execute(wanted);
    return answer.verdict;
  };
  for (const auto& [by, wanted, rows] : {std::tuple(anna, verdict::taken, 0U),
                                         {bob, verdict::no_control, 1U},
                                         {eve, verdict::wrong_role, 1U},
                                         {{"mallory", role::engineer, "s99"}, verdict::no_session, 1U},
                                         {local(), verdict::no_control, 1U}}) {
    const auto before = world.rows();
    EXPECT_EQ(ask(by), wanted) << by.name;
    EXPECT_EQ(world.rows(), before + rows) << by.name;
  }
  world.pass(11 * s);
  EXPECT_EQ(ask(local()), verdict::taken) << "nobody has control";
}

TEST(operator_bridge_core, an_operator_is_there_who_was_heard_within_ten_seconds_and_a_viewer_is_none) {
  bridge_world world;
  presence shown;
  const auto is_there = [&] {
    if (const auto heard = world.decides().operator_heard_ns())
      shown.hear(*heard);
    return shown.is_there(world.now.monotonic_ns);
  };
  const auto eve = world.log_in("eve", role::viewer);
  (void)world.decides().on_identify({"hash of eve"}, world.now);
  EXPECT_FALSE(is_there());
  const auto anna = world.log_in("anna");
  (void)world.decides().on_identify({"hash of anna"}, world.now);
  EXPECT_TRUE(is_there());
  world.pass(10 * s);
  EXPECT_TRUE(is_there());
  world.pass(1);
  EXPECT_FALSE(is_there());
}

TEST(operator_bridge_core, hold_and_return_are_open_to_every_operator_and_go_out_before_they_are_written) {
  bridge_world world;
  (void)world.pilot();
  const auto bob = world.log_in("bob");
  for (const auto kind : {command_kind::pause, command_kind::come_home}) {
    const auto request = world.say(world.command(bob, kind));
    ASSERT_EQ(world.with_executor.size(), 1U);
    world.answer(std::exchange(world.with_executor, {})[0].number, {true, {}, {}});
    EXPECT_EQ(world.answers.at(request).verdict, verdict::taken);
  }
}

TEST(operator_bridge_core, a_hold_is_never_late_and_a_return_is) {
  bridge_world world;
  const auto anna = world.pilot();
  auto hold = world.command(anna, command_kind::pause);
  hold.valid_until_ns = world.now.wall_ns - 3'600 * s;
  EXPECT_EQ(world.say_all_the_way(hold), verdict::taken);
  auto home = world.command(anna, command_kind::come_home);
  home.valid_until_ns = hold.valid_until_ns;
  EXPECT_EQ(world.say_all_the_way(home), verdict::late);
}

TEST(operator_bridge_core, a_stop_empties_what_waits_for_the_disk) {
  bridge_world world;
  const auto anna = world.pilot();
  const auto resume = world.say(world.command(anna, command_kind::resume, "r"));
  (void)world.say(world.command(world.log_in("bob"), command_kind::pause, "p"));
  EXPECT_EQ(world.answers.at(resume).verdict, verdict::superseded);
  world.write();
  ASSERT_EQ(world.handed.size(), 1U);
  EXPECT_EQ(world.handed[0].what.kind, command_kind::pause);
  EXPECT_EQ(world.say_all_the_way(world.command(anna, command_kind::resume, "r")), verdict::superseded);
}

TEST(operator_bridge_core, a_stop_that_is_said_again_empties_it_too) {
  bridge_world world;
  const auto anna = world.pilot();
  (void)world.say(world.command(anna, command_kind::pause, "p"));
  const auto start = world.say(world.command(anna, command_kind::start, "s"));
  (void)world.say(world.command(anna, command_kind::pause, "p"));
  EXPECT_EQ(world.answers.at(start).verdict, verdict::superseded);
  world.write();
  EXPECT_EQ(world.handed.size(), 1U);
}

TEST(operator_bridge_core, what_the_disk_took_too_long_for_is_not_handed_over) {
  bridge_world world;
  const auto request = world.say(world.command(world.pilot(), command_kind::resume, "r"));
  world.pass(core::release_within_ns + 1);
  world.write();
  EXPECT_TRUE(world.handed.empty());
  EXPECT_EQ(world.answers.at(request).verdict, verdict::late);
}

TEST(operator_bridge_core, who_has_lost_control_meanwhile_is_not_obeyed) {
  bridge_world world;
  const auto request = world.say(world.command(world.pilot(), command_kind::resume, "r"));
  ASSERT_TRUE(world.control(world.log_in("chief", role::engineer), control_act::take_over).is_done);
  world.write();
  EXPECT_TRUE(world.handed.empty());
  EXPECT_EQ(world.answers.at(request).verdict, verdict::no_control);
}

TEST(operator_bridge_core, a_repetition_while_it_is_under_way_waits_for_the_same_answer) {
  bridge_world world;
  const auto anna = world.pilot();
  const auto first = world.say(world.command(anna, command_kind::start, "a1"));
  world.write();
  const auto second = world.say(world.command(anna, command_kind::start, "a1"));
  world.write();
  ASSERT_EQ(world.handed.size(), 1U);
  world.answer(world.handed[0].number, {true, {}, {}});
  EXPECT_EQ(world.answers.at(first), world.answers.at(second));
  EXPECT_EQ(world.answered.at(first), 1);
}

TEST(operator_bridge_core, what_was_handed_over_when_the_process_died_is_never_done_twice_and_its_outcome_is_unknown) {
  bridge_world world;
  const auto anna = world.pilot();
  (void)world.say(world.command(anna, command_kind::start, "a1"));
  world.write();
  ASSERT_EQ(world.handed.size(), 1U);
  world.crash();
  EXPECT_EQ(world.outcomes().back(), "unknown");
  EXPECT_EQ(world.say_all_the_way(world.command(anna, command_kind::start, "a1")), verdict::unknown);
  EXPECT_EQ(world.handed.size(), 1U);
}

TEST(operator_bridge_core, an_answer_that_was_given_is_given_again_after_a_crash) {
  bridge_world world;
  const auto anna = world.pilot();
  ASSERT_EQ(world.say_all_the_way(world.command(anna, command_kind::start, "a1")), verdict::taken);
  world.crash();
  EXPECT_EQ(world.say_all_the_way(world.command(anna, command_kind::start, "a1")), verdict::taken);
  EXPECT_EQ(world.handed.size(), 1U);
}

TEST(operator_bridge_core, an_executor_that_takes_nothing_is_told_from_one_that_gives_no_answer) {
  bridge_world world;
  const auto anna = world.pilot();
  const auto one = world.say(world.command(anna, command_kind::check));
  const auto two = world.say(world.command(anna, command_kind::resume));
  world.write();
  ASSERT_EQ(world.handed.size(), 2U);
  world.no_answer(world.handed[0].number, false);
  world.no_answer(world.handed[1].number, true);
  EXPECT_EQ(world.answers.at(one).verdict, verdict::not_done);
  EXPECT_EQ(world.answers.at(two).verdict, verdict::unknown);
}

TEST(operator_bridge_core, more_than_its_bound_are_refused_and_a_stop_is_not) {
  bridge_world world;
  const auto anna = world.pilot();
  for (std::size_t i = 0; i < core::max_under_way; ++i)
    (void)world.say(world.command(anna, command_kind::check));
  const auto request = world.say(world.command(anna, command_kind::check));
  EXPECT_EQ(world.answers.at(request).verdict, verdict::busy);
  (void)world.say(world.command(anna, command_kind::pause));
  EXPECT_EQ(world.with_executor.size(), 1U);
}

TEST(operator_bridge_core, many_stops_at_once_are_handed_over_a_few_times_and_all_are_answered) {
  bridge_world world;
  const auto anna = world.pilot();
  for (int i = 0; i < 30; ++i)
    (void)world.say(world.command(anna, command_kind::pause));
  EXPECT_EQ(world.handed.size(), core::max_stops_under_way);
  for (const auto& each : std::exchange(world.with_executor, {}))
    world.answer(each.number, {true, {}, {}});
  EXPECT_EQ(world.answers.size(), 30U);
}

TEST(operator_bridge_core, ids_are_known_until_they_are_late_and_one_person_does_not_fill_the_table) {
  bridge_world world;
  const auto anna = world.pilot();
  for (std::size_t i = 0; i < max_kept_of_one; ++i)
    ASSERT_EQ(world.say_all_the_way(world.command(anna, command_kind::check, "c" + std::to_string(i))), verdict::taken);
  EXPECT_EQ(world.say_all_the_way(world.command(anna, command_kind::check, "more")), verdict::busy);
  EXPECT_EQ(world.say_all_the_way(world.command(anna, command_kind::check, "c0")), verdict::taken)
      << "as the first time";
  ASSERT_TRUE(world.control(anna, control_act::give).is_done);
  const auto bob = world.pilot("bob");
  EXPECT_EQ(world.say_all_the_way(world.command(bob, command_kind::check, "b")), verdict::taken);
  ASSERT_TRUE(world.control(bob, control_act::give).is_done);
  world.pass(6 * s);
  ASSERT_TRUE(world.control(anna, control_act::take).is_done);
  EXPECT_EQ(world.say_all_the_way(world.command(anna, command_kind::check, "z")), verdict::taken);
}

TEST(operator_bridge_core, at_the_control_socket_control_is_not_asked_for_as_long_as_it_is_free) {
  bridge_world world;
  EXPECT_EQ(world.say_all_the_way(world.command(local(), command_kind::start)), verdict::taken);
  (void)world.pilot();
  const auto request = world.say(world.command(local(), command_kind::resume));
  EXPECT_EQ(world.answers.at(request).verdict, verdict::no_control);
  EXPECT_NE(world.answers.at(request).reason.find("anna"), std::string::npos);
}

TEST(operator_bridge_core, a_stop_that_was_not_taken_is_handed_over_again_when_it_is_said_again) {
  bridge_world world;
  const auto hold = world.command(world.pilot(), command_kind::pause, "h1");
  (void)world.say(hold);
  world.answer(std::exchange(world.with_executor, {})[0].number, {false, "no flight is under way", {}});
  EXPECT_EQ(world.say_all_the_way(hold), verdict::taken);
  EXPECT_EQ(world.say_all_the_way(hold), verdict::taken);
  EXPECT_EQ(world.handed.size(), 2U) << "and once it was taken it is a repetition";
}

TEST(operator_bridge_core, nobody_is_kept_from_stopping_the_vehicle_by_a_bad_id) {
  bridge_world world;
  const auto anna = world.pilot();
  ASSERT_EQ(world.say_all_the_way(world.command(anna, command_kind::start, "a1")), verdict::taken);
  EXPECT_EQ(world.say_all_the_way(world.command(anna, command_kind::pause, "a1")), verdict::taken);
  EXPECT_EQ(world.say_all_the_way(world.command(anna, command_kind::pause, "no id")), verdict::taken);
  EXPECT_EQ(world.handed.size(), 3U);
}

TEST(operator_bridge_core, an_id_that_is_none_is_refused) {
  bridge_world world;
  const auto anna = world.pilot();
  for (const auto& id : {std::string("a b"), std::string(max_command_id + 1, 'x'), std::string("\n")})
    EXPECT_EQ(world.say_all_the_way(world.command(anna, command_kind::check, id)), verdict::refused);
  EXPECT_TRUE(world.handed.empty());
}

} // namespace operator_bridge_core_test
} // namespace godwit::operator_bridge::tests
