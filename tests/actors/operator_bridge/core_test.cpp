// What operator_bridge decides about commands.
#include "actors/operator_bridge/core.hpp"

#include <tuple>

#include <gtest/gtest.h>

#include "actors/operator_bridge/presence.hpp"
#include "tests/actors/operator_bridge/bridge_desk.hpp"

namespace godwit::operator_bridge::tests {
namespace operator_bridge_core_test {

using operators::command_kind;
using operators::role;

TEST(operator_bridge_core,
     a_command_of_who_has_control_is_handed_over_when_it_is_written_and_answered_as_the_executor_says) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  const auto request = desk.say(desk.command(anna, command_kind::start, "a1"));
  EXPECT_TRUE(desk.handed.empty());
  desk.write();
  ASSERT_EQ(desk.handed.size(), 1U);
  EXPECT_EQ(desk.handed[0].what.by, "anna");
  desk.answer(desk.handed[0].number, {false, "not ready", {}});
  EXPECT_EQ(desk.answers.at(request), (command_answer{verdict::refused, "not ready"}));
  EXPECT_EQ(desk.outcomes().back(), "refused");
}

TEST(operator_bridge_core, what_the_executor_advises_goes_to_the_sender_and_into_the_audit_and_is_said_again) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  const auto request = desk.say(desk.command(anna, command_kind::start, "a1"));
  desk.write();
  desk.answer(desk.handed[0].number, {true, {}, {}, "another aircraft is near"});
  desk.write();
  EXPECT_EQ(desk.answers.at(request), (command_answer{verdict::taken, "another aircraft is near"}));
  EXPECT_EQ(desk.outcomes().back(), "taken");
  const auto again = desk.say(desk.command(anna, command_kind::start, "a1"));
  desk.write();
  EXPECT_EQ(desk.answers.at(again), desk.answers.at(request));
}

TEST(operator_bridge_core, a_command_for_another_state_is_stale_and_says_how_the_flight_stands) {
  bridge_desk desk;
  const auto request = desk.say(desk.command(desk.pilot(), command_kind::start, "a1"));
  desk.write();
  desk.answer(desk.handed[0].number, {false, "the flight stands otherwise by now", "paused/asked/m/1/1/0"});
  EXPECT_EQ(desk.answers.at(request).verdict, verdict::stale);
  EXPECT_EQ(desk.answers.at(request).state, "paused/asked/m/1/1/0");
}

TEST(operator_bridge_core,
     command_without_session_expired_replayed_wrong_role_without_control_or_late_has_no_effect_and_one_row_each) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  const auto bob = desk.log_in("bob");
  const auto eve = desk.log_in("eve", role::viewer);
  ASSERT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::start, "first")), verdict::taken);
  const auto handed = desk.handed.size();

  const auto expect = [&](const operator_command& m, verdict wanted) {
    const auto rows = desk.rows();
    EXPECT_EQ(desk.say_all_the_way(m), wanted) << io::name_of(wanted);
    EXPECT_EQ(desk.rows(), rows + 1) << io::name_of(wanted);
    EXPECT_EQ(desk.handed.size(), handed) << io::name_of(wanted);
  };
  expect(desk.command({"mallory", role::engineer, "s99"}, command_kind::resume), verdict::no_session);
  expect(desk.command({"anna", role::engineer, anna.session}, command_kind::resume), verdict::no_session);
  expect(desk.command(eve, command_kind::resume, "e1"), verdict::wrong_role);
  expect(desk.command(eve, command_kind::pause, "e2"), verdict::wrong_role);
  expect(desk.command(bob, command_kind::resume, "b1"), verdict::no_control);
  expect(desk.command(anna, command_kind::start, "first"), verdict::taken); // as the first time
  expect(desk.command(anna, command_kind::resume, "first"), verdict::id_used);
  auto late = desk.command(anna, command_kind::resume, "late");
  late.valid_until_ns = desk.now.wall_ns - 1;
  expect(late, verdict::late);
  auto early = desk.command(anna, command_kind::resume, "early");
  early.valid_until_ns = desk.now.wall_ns + core::longest_validity_ns + 1;
  expect(early, verdict::refused);
  desk.pass(desk.set.session_idle_s * s);
  expect(desk.command(anna, command_kind::resume, "a9"), verdict::no_session); // expired
}

TEST(operator_bridge_core, leave_for_what_is_no_command_has_the_rules_of_one_and_a_refusal_is_one_row) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  const auto bob = desk.log_in("bob");
  const auto eve = desk.log_in("eve", role::viewer);
  const auto ask = [&](const operators::principal& by) {
    const auto [wanted, answer] = desk.decides().on_leave({by, "confirm point 3"}, desk.now);
    desk.execute(wanted);
    return answer.verdict;
  };
  for (const auto& [by, wanted, rows] : {std::tuple(anna, verdict::taken, 0U),
                                         {bob, verdict::no_control, 1U},
                                         {eve, verdict::wrong_role, 1U},
                                         {{"mallory", role::engineer, "s99"}, verdict::no_session, 1U},
                                         {local(), verdict::no_control, 1U}}) {
    const auto before = desk.rows();
    EXPECT_EQ(ask(by), wanted) << by.name;
    EXPECT_EQ(desk.rows(), before + rows) << by.name;
  }
  desk.pass(11 * s);
  EXPECT_EQ(ask(local()), verdict::taken) << "nobody has control";
}

TEST(operator_bridge_core, an_operator_is_there_who_was_heard_within_ten_seconds_and_a_viewer_is_none) {
  bridge_desk desk;
  presence shown;
  const auto is_there = [&] {
    if (const auto heard = desk.decides().operator_heard_ns())
      shown.hear(*heard);
    return shown.is_there(desk.now.monotonic_ns);
  };
  const auto eve = desk.log_in("eve", role::viewer);
  (void)desk.decides().on_identify({"hash of eve"}, desk.now);
  EXPECT_FALSE(is_there());
  const auto anna = desk.log_in("anna");
  (void)desk.decides().on_identify({"hash of anna"}, desk.now);
  EXPECT_TRUE(is_there());
  desk.pass(10 * s);
  EXPECT_TRUE(is_there());
  desk.pass(1);
  EXPECT_FALSE(is_there());
}

TEST(operator_bridge_core, hold_and_return_are_open_to_every_operator_and_go_out_before_they_are_written) {
  bridge_desk desk;
  (void)desk.pilot();
  const auto bob = desk.log_in("bob");
  for (const auto kind : {command_kind::pause, command_kind::come_home}) {
    const auto request = desk.say(desk.command(bob, kind));
    ASSERT_EQ(desk.with_executor.size(), 1U);
    desk.answer(std::exchange(desk.with_executor, {})[0].number, {true, {}, {}});
    EXPECT_EQ(desk.answers.at(request).verdict, verdict::taken);
  }
}

TEST(operator_bridge_core, a_hold_is_never_late_and_a_return_is) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  auto hold = desk.command(anna, command_kind::pause);
  hold.valid_until_ns = desk.now.wall_ns - 3'600 * s;
  EXPECT_EQ(desk.say_all_the_way(hold), verdict::taken);
  auto home = desk.command(anna, command_kind::come_home);
  home.valid_until_ns = hold.valid_until_ns;
  EXPECT_EQ(desk.say_all_the_way(home), verdict::late);
}

TEST(operator_bridge_core, a_stop_empties_what_waits_for_the_disk) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  const auto resume = desk.say(desk.command(anna, command_kind::resume, "r"));
  (void)desk.say(desk.command(desk.log_in("bob"), command_kind::pause, "p"));
  EXPECT_EQ(desk.answers.at(resume).verdict, verdict::superseded);
  desk.write();
  ASSERT_EQ(desk.handed.size(), 1U);
  EXPECT_EQ(desk.handed[0].what.kind, command_kind::pause);
  EXPECT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::resume, "r")), verdict::superseded);
}

TEST(operator_bridge_core, a_stop_that_is_said_again_empties_it_too) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  (void)desk.say(desk.command(anna, command_kind::pause, "p"));
  const auto start = desk.say(desk.command(anna, command_kind::start, "s"));
  (void)desk.say(desk.command(anna, command_kind::pause, "p"));
  EXPECT_EQ(desk.answers.at(start).verdict, verdict::superseded);
  desk.write();
  EXPECT_EQ(desk.handed.size(), 1U);
}

TEST(operator_bridge_core, what_the_disk_took_too_long_for_is_not_handed_over) {
  bridge_desk desk;
  const auto request = desk.say(desk.command(desk.pilot(), command_kind::resume, "r"));
  desk.pass(core::release_within_ns + 1);
  desk.write();
  EXPECT_TRUE(desk.handed.empty());
  EXPECT_EQ(desk.answers.at(request).verdict, verdict::late);
}

TEST(operator_bridge_core, who_has_lost_control_meanwhile_is_not_obeyed) {
  bridge_desk desk;
  const auto request = desk.say(desk.command(desk.pilot(), command_kind::resume, "r"));
  ASSERT_TRUE(desk.control(desk.log_in("chief", role::engineer), control_act::take_over).is_done);
  desk.write();
  EXPECT_TRUE(desk.handed.empty());
  EXPECT_EQ(desk.answers.at(request).verdict, verdict::no_control);
}

TEST(operator_bridge_core, a_repetition_while_it_is_under_way_waits_for_the_same_answer) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  const auto first = desk.say(desk.command(anna, command_kind::start, "a1"));
  desk.write();
  const auto second = desk.say(desk.command(anna, command_kind::start, "a1"));
  desk.write();
  ASSERT_EQ(desk.handed.size(), 1U);
  desk.answer(desk.handed[0].number, {true, {}, {}});
  EXPECT_EQ(desk.answers.at(first), desk.answers.at(second));
  EXPECT_EQ(desk.answered.at(first), 1);
}

TEST(operator_bridge_core, what_was_handed_over_when_the_process_died_is_never_done_twice_and_its_outcome_is_unknown) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  (void)desk.say(desk.command(anna, command_kind::start, "a1"));
  desk.write();
  ASSERT_EQ(desk.handed.size(), 1U);
  desk.crash();
  EXPECT_EQ(desk.outcomes().back(), "unknown");
  EXPECT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::start, "a1")), verdict::unknown);
  EXPECT_EQ(desk.handed.size(), 1U);
}

TEST(operator_bridge_core, an_answer_that_was_given_is_given_again_after_a_crash) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  ASSERT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::start, "a1")), verdict::taken);
  desk.crash();
  EXPECT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::start, "a1")), verdict::taken);
  EXPECT_EQ(desk.handed.size(), 1U);
}

TEST(operator_bridge_core, an_executor_that_takes_nothing_is_told_from_one_that_gives_no_answer) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  const auto one = desk.say(desk.command(anna, command_kind::check));
  const auto two = desk.say(desk.command(anna, command_kind::resume));
  desk.write();
  ASSERT_EQ(desk.handed.size(), 2U);
  desk.no_answer(desk.handed[0].number, false);
  desk.no_answer(desk.handed[1].number, true);
  EXPECT_EQ(desk.answers.at(one).verdict, verdict::not_done);
  EXPECT_EQ(desk.answers.at(two).verdict, verdict::unknown);
}

TEST(operator_bridge_core, more_than_its_bound_are_refused_and_a_stop_is_not) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  for (std::size_t i = 0; i < core::max_under_way; ++i)
    (void)desk.say(desk.command(anna, command_kind::check));
  const auto request = desk.say(desk.command(anna, command_kind::check));
  EXPECT_EQ(desk.answers.at(request).verdict, verdict::busy);
  (void)desk.say(desk.command(anna, command_kind::pause));
  EXPECT_EQ(desk.with_executor.size(), 1U);
}

TEST(operator_bridge_core, many_stops_at_once_are_handed_over_a_few_times_and_all_are_answered) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  for (int i = 0; i < 30; ++i)
    (void)desk.say(desk.command(anna, command_kind::pause));
  EXPECT_EQ(desk.handed.size(), core::max_stops_under_way);
  for (const auto& each : std::exchange(desk.with_executor, {}))
    desk.answer(each.number, {true, {}, {}});
  EXPECT_EQ(desk.answers.size(), 30U);
}

TEST(operator_bridge_core, ids_are_known_until_they_are_late_and_one_person_does_not_fill_the_table) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  for (std::size_t i = 0; i < max_kept_of_one; ++i)
    ASSERT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::check, "c" + std::to_string(i))), verdict::taken);
  EXPECT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::check, "more")), verdict::busy);
  EXPECT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::check, "c0")), verdict::taken) << "as the first time";
  ASSERT_TRUE(desk.control(anna, control_act::give).is_done);
  const auto bob = desk.pilot("bob");
  EXPECT_EQ(desk.say_all_the_way(desk.command(bob, command_kind::check, "b")), verdict::taken);
  ASSERT_TRUE(desk.control(bob, control_act::give).is_done);
  desk.pass(6 * s);
  ASSERT_TRUE(desk.control(anna, control_act::take).is_done);
  EXPECT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::check, "z")), verdict::taken);
}

TEST(operator_bridge_core, at_the_control_socket_control_is_not_asked_for_as_long_as_it_is_free) {
  bridge_desk desk;
  EXPECT_EQ(desk.say_all_the_way(desk.command(local(), command_kind::start)), verdict::taken);
  (void)desk.pilot();
  const auto request = desk.say(desk.command(local(), command_kind::resume));
  EXPECT_EQ(desk.answers.at(request).verdict, verdict::no_control);
  EXPECT_NE(desk.answers.at(request).reason.find("anna"), std::string::npos);
}

TEST(operator_bridge_core, a_stop_that_was_not_taken_is_handed_over_again_when_it_is_said_again) {
  bridge_desk desk;
  const auto hold = desk.command(desk.pilot(), command_kind::pause, "h1");
  (void)desk.say(hold);
  desk.answer(std::exchange(desk.with_executor, {})[0].number, {false, "no flight is under way", {}});
  EXPECT_EQ(desk.say_all_the_way(hold), verdict::taken);
  EXPECT_EQ(desk.say_all_the_way(hold), verdict::taken);
  EXPECT_EQ(desk.handed.size(), 2U) << "and once it was taken it is a repetition";
}

TEST(operator_bridge_core, nobody_is_kept_from_stopping_the_vehicle_by_a_bad_id) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  ASSERT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::start, "a1")), verdict::taken);
  EXPECT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::pause, "a1")), verdict::taken);
  EXPECT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::pause, "no id")), verdict::taken);
  EXPECT_EQ(desk.handed.size(), 3U);
}

TEST(operator_bridge_core, an_id_that_is_none_is_refused) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  for (const auto& id : {std::string("a b"), std::string(max_command_id + 1, 'x'), std::string("\n")})
    EXPECT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::check, id)), verdict::refused);
  EXPECT_TRUE(desk.handed.empty());
}

} // namespace operator_bridge_core_test
} // namespace godwit::operator_bridge::tests
