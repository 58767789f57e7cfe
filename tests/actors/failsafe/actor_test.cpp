#include <gtest/gtest.h>

#include <algorithm>

#include "tests/actors/failsafe/actor_world.hpp"

namespace failsafe_actor_test {

using namespace godwit;
using namespace godwit::tests;
using namespace std::chrono_literals;
using failsafe::reaction_stage;
using failsafe::rule;
using runtime::crash_point;
using vehicle_link::command_verdict;

constexpr crash_point points[] = {crash_point::before_handler, crash_point::after_handler, crash_point::after_commit,
                                  crash_point::before_dispatch};

// A process in mid-flight inside of its fence.
struct in_flight {
  explicit in_flight(const flown_vehicle& as = {}, const failsafe::settings& configured = {}) : vehicle(as) {
    process.emplace(disk, vehicle, log, configured);
    EXPECT_TRUE(process->guard().taken);
    process->run_s(10);
    EXPECT_TRUE(log.commands.empty());
  }
  // SIGKILL, and a new one that nobody tells the fences.
  void restart_process(const failsafe::settings& configured = {}) {
    process.reset();
    process.emplace(disk, vehicle, log, configured);
  }

  runtime::simulated_disk disk;
  flown_vehicle vehicle;
  flight_log log;
  std::optional<failsafe_process> process;
};

// -- in time --------------------------------------------------------------------------------------

// The breach lies anywhere between two positions and two ticks.
void expect_breach_to_command_within_250_ms(bool executor_is_dead, std::int64_t position_every_ms) {
  for (std::int64_t offset_ms = 0; offset_ms < 200; offset_ms += 10) {
    flown_vehicle vehicle;
    vehicle.position_every_ms = position_every_ms;
    in_flight f(vehicle);
    if (executor_is_dead) {
      ASSERT_TRUE(f.process->world.kill("executor"));
    }
    f.process->run_ms(offset_ms);
    f.vehicle.east_m = 101;
    const auto breached_ns = f.process->world.now_ns();
    f.process->run_s(1);
    ASSERT_EQ(f.log.returns(), 1) << offset_ms;
    EXPECT_LE(f.log.commands.front().at_ns - breached_ns, (position_every_ms + 250) * failsafe::ns_per_ms) << offset_ms;
  }
}

TEST(failsafe, from_the_second_position_outside_to_the_command_it_takes_at_most_250_ms) {
  expect_breach_to_command_within_250_ms(false, 200);
  expect_breach_to_command_within_250_ms(false, 100);
}

TEST(failsafe, from_the_second_position_outside_to_the_command_it_takes_at_most_250_ms_with_the_executor_dead) {
  expect_breach_to_command_within_250_ms(true, 200);
}

TEST(failsafe, operator_link_lost_nothing_at_25_s_and_return_at_30_s) {
  for (const std::int64_t offset_ms : {0, 330, 710}) {
    in_flight f;
    f.process->run_ms(offset_ms);
    const auto last_heard_ns = (f.process->world.now_ns() / failsafe::ns_per_ms - 10) * failsafe::ns_per_ms;
    f.vehicle.operator_there = false;
    f.process->run_s(25);
    EXPECT_TRUE(f.log.commands.empty());
    EXPECT_TRUE(std::any_of(f.log.texts.begin(), f.log.texts.end(),
                            [](const std::string& each) { return each.find("silent") != std::string::npos; }));
    EXPECT_EQ(f.log.logged, f.log.texts);
    f.process->run_s(6);
    ASSERT_EQ(f.log.returns(), 1);
    EXPECT_NEAR(static_cast<double>(f.log.commands.front().at_ns - last_heard_ns), 30e9, 0.2e9);
  }
}

TEST(failsafe, the_link_that_comes_back_does_not_cancel_the_return) {
  in_flight f;
  f.vehicle.operator_there = false;
  f.process->run_s(32);
  f.vehicle.operator_there = true;
  f.process->run_s(30);
  EXPECT_EQ(f.log.commands.size(), 1U);
  EXPECT_EQ(f.vehicle.mode, px4_return);
  EXPECT_EQ(f.process->stands().reacts.value().stage, reaction_stage::done);
}

// -- it waits for nobody ---------------------------------------------------------------------------

TEST(failsafe, a_command_does_not_wait_for_a_disk_that_fails) {
  in_flight f;
  f.process->world.journal().fail_writes(true);
  f.vehicle.east_m = 101;
  f.process->run_ms(250);
  EXPECT_EQ(f.log.returns(), 1);
}

// The journal refuses what an incarnation writes of which it believes that it was replaced.
TEST(failsafe, where_the_journal_takes_nothing_it_acts_all_the_same_once_and_says_so) {
  in_flight f;
  f.process->world.journal().refuse_writes(true);
  f.vehicle.east_m = 101;
  f.process->run_ms(250);
  EXPECT_EQ(f.log.returns(), 1);
  f.process->run_s(20);
  EXPECT_EQ(f.log.returns(), 1);
  EXPECT_EQ(f.process->world.counters("failsafe").crashes, 0U);
  EXPECT_EQ(f.process->health().colour, runtime::health_colour::red);
  EXPECT_NE(f.process->health().reason.find("written down"), std::string::npos);
}

TEST(failsafe, a_command_that_the_vehicle_does_not_answer_goes_out_again_until_its_mode_shows_it) {
  in_flight f;
  f.vehicle.is_silent = true;
  f.vehicle.east_m = 101;
  f.process->run_s(12);
  EXPECT_GE(f.log.returns(), 2);
  EXPECT_EQ(f.process->stands().reacts.value().stage, reaction_stage::failing);
  EXPECT_EQ(f.process->health().colour, runtime::health_colour::red);
  f.vehicle.is_silent = false;
  f.process->run_s(10);
  EXPECT_EQ(f.process->stands().reacts.value().stage, reaction_stage::done);
  const auto sent = f.log.returns();
  f.process->run_s(30);
  EXPECT_EQ(f.log.returns(), sent);
}

TEST(failsafe, sending_fails_again_each_tick) {
  in_flight f;
  f.vehicle.verdict = command_verdict::not_sent;
  f.vehicle.east_m = 101;
  f.process->run_s(2);
  EXPECT_GE(f.log.returns(), 18);
  f.vehicle.verdict.reset();
  f.process->run_s(3);
  EXPECT_EQ(f.vehicle.mode, px4_return);
}

TEST(failsafe, the_hold_of_a_rover_does_not_wait_for_a_change_of_mode_that_is_under_way) {
  flown_vehicle rover;
  rover.type = mavlink::mav_type::ground_rover;
  in_flight f(rover);
  f.vehicle.verdict = command_verdict::already_running;
  f.vehicle.east_m = 101;
  f.process->run_ms(250);
  ASSERT_EQ(f.log.modes.size(), 1U);
  EXPECT_EQ(f.log.modes.front().custom_mode, px4_hold);
  f.vehicle.mode = px4_hold;
  f.process->run_s(10);
  EXPECT_EQ(f.log.modes.size(), 1U);
  EXPECT_EQ(f.process->stands().reacts.value().stage, reaction_stage::done);
}

// -- what it tells ---------------------------------------------------------------------------------

TEST(failsafe, who_listens_knows_whose_the_command_is_before_it_goes_out_and_hears_that_it_is_done) {
  in_flight f;
  f.log.order.clear();
  f.log.failsafe_statuses.clear();
  f.vehicle.east_m = 101;
  f.process->run_s(3);
  ASSERT_GE(f.log.order.size(), 3U);
  EXPECT_EQ(f.log.order[0], "stance");
  EXPECT_EQ(f.log.order[1], "command");
  const auto& began = f.log.failsafe_statuses.front().reacts.value();
  EXPECT_EQ(began.why, rule::fence);
  EXPECT_EQ(began.what, failsafe::action::return_home);
  EXPECT_EQ(began.stage, reaction_stage::under_way);
  EXPECT_EQ(f.log.failsafe_statuses.back().reacts.value().stage, reaction_stage::done);
  EXPECT_EQ(f.log.failsafe_statuses.back().latched, std::vector{rule::fence});
}

TEST(failsafe, a_takeover_is_told_and_nothing_is_sent_until_hand_back) {
  in_flight f;
  f.vehicle.mode = px4_position;
  f.process->run_s(2);
  EXPECT_TRUE(f.log.failsafe_statuses.back().taken_over);
  f.vehicle.east_m = 101;
  f.process->run_s(30);
  EXPECT_TRUE(f.log.commands.empty());
  f.process->world.tell(f.process->failsafe, failsafe::hand_back{});
  f.process->run_s(1);
  EXPECT_EQ(f.log.returns(), 1);
}

TEST(failsafe, a_mode_that_the_executor_announced_is_no_takeover) {
  in_flight f;
  f.process->world.tell(f.process->failsafe, failsafe::expect_mode{{px4_hold}, 5'000});
  f.vehicle.mode = px4_hold;
  f.process->run_s(10);
  EXPECT_FALSE(f.process->stands().taken_over);
}

TEST(failsafe, a_takeover_that_the_executor_saw_silences_it_at_once) {
  in_flight f;
  f.process->world.tell(f.process->failsafe, failsafe::taken_over{});
  f.vehicle.east_m = 101;
  f.process->run_s(10);
  EXPECT_TRUE(f.log.commands.empty());
}

TEST(failsafe, fences_that_make_no_sense_are_refused_with_the_reason_and_the_ones_before_count) {
  in_flight f;
  const auto asked =
      f.process->world.ask(f.process->failsafe, 1s, failsafe::guard_mission{{mission::geofence{}}, {}, {}});
  f.process->world.run_until_idle();
  ASSERT_EQ(asked->answers, 1);
  EXPECT_FALSE(asked->answer.taken);
  EXPECT_NE(asked->answer.reason.find("corners"), std::string::npos);
  f.vehicle.east_m = 101;
  f.process->run_s(1);
  EXPECT_EQ(f.log.returns(), 1);
}

TEST(failsafe, takes_the_limits_of_a_flight_when_they_and_what_was_announced_before_are_on_the_disk) {
  in_flight f;
  f.process->world.journal().fail_writes(true);
  f.process->world.tell(f.process->failsafe, failsafe::expect_mode{{px4_hold}, 5'000});
  const auto asked = f.process->world.ask(f.process->failsafe, 5s, failsafe::guard_mission{{}, {}, {}});
  f.process->run_ms(500);
  EXPECT_EQ(asked->answers, 0);
  f.process->world.journal().fail_writes(false);
  f.process->run_ms(500);
  ASSERT_EQ(asked->answers, 1);
  EXPECT_TRUE(asked->answer.taken) << asked->answer.reason;
  f.restart_process();
  f.vehicle.mode = px4_hold;
  f.process->run_s(10);
  EXPECT_FALSE(f.process->stands().taken_over) << "the next process knows whose it is";
}

TEST(failsafe, an_override_is_answered_and_holds_until_its_deadline) {
  in_flight f;
  const auto until_ns = runtime::simulated_time::start_ns + f.process->world.now_ns() + 20'000'000'000;
  const auto asked = f.process->world.ask(f.process->failsafe, 1s,
                                          failsafe::override_rule{rule::fence, "the field is ours", until_ns});
  f.process->world.run_until_idle();
  ASSERT_EQ(asked->answers, 1);
  EXPECT_TRUE(asked->answer.taken) << asked->answer.reason;
  EXPECT_EQ(f.process->stands().overridden.size(), 1U);
  f.vehicle.east_m = 101;
  f.process->run_s(19);
  EXPECT_TRUE(f.log.commands.empty());
  f.process->run_s(2);
  EXPECT_EQ(f.log.returns(), 1);
  const auto refused = f.process->world.ask(f.process->failsafe, 1s,
                                            failsafe::override_rule{rule::battery_critical, "trust me", until_ns * 2});
  f.process->world.run_until_idle();
  EXPECT_FALSE(refused->answer.taken);
}

TEST(failsafe, while_an_object_is_followed_the_operator_may_be_silent_30_s_longer) {
  in_flight f;
  f.process->world.tell(f.process->failsafe, failsafe::following{true});
  f.vehicle.operator_there = false;
  f.process->run_s(59);
  EXPECT_TRUE(f.log.commands.empty());
  f.process->run_s(2);
  EXPECT_EQ(f.log.returns(), 1);
}

TEST(failsafe, its_health_is_on_the_board) {
  in_flight f;
  EXPECT_EQ(f.process->health().colour, runtime::health_colour::green) << f.process->health().reason;
  f.vehicle.battery_percent = -1;
  f.process->run_s(2);
  EXPECT_EQ(f.process->health().colour, runtime::health_colour::yellow);
  EXPECT_NE(f.process->health().reason.find("battery"), std::string::npos);
}

TEST(failsafe, while_nothing_happens_nothing_is_written_and_nothing_is_told) {
  in_flight f;
  const auto commits = f.disk.commits;
  const auto told = f.log.failsafe_statuses.size();
  f.process->run_s(60);
  EXPECT_EQ(f.disk.commits, commits);
  EXPECT_EQ(f.log.failsafe_statuses.size(), told);
}

// -- crashes ---------------------------------------------------------------------------------------

// The crash is planned for each moment around the breach.
TEST(failsafe, a_crash_at_any_point_makes_no_second_return_and_forgets_none) {
  for (const auto point : points)
    for (std::int64_t before_ms = -200; before_ms <= 1'000; before_ms += 100) {
      in_flight f;
      f.process->run_ms(300);
      if (before_ms < 0)
        f.process->world.crash_at("failsafe", point);
      f.vehicle.east_m = 101;
      f.process->run_ms(std::max<std::int64_t>(before_ms, 0));
      if (before_ms >= 0)
        f.process->world.crash_at("failsafe", point);
      f.process->run_s(12);
      EXPECT_EQ(f.log.returns(), 1) << static_cast<int>(point) << " " << before_ms;
      EXPECT_EQ(f.vehicle.mode, px4_return);
      EXPECT_EQ(f.process->stands().reacts.value().stage, reaction_stage::done);
    }
}

TEST(failsafe, a_crash_right_after_the_command_makes_no_second_return_however_slow_the_vehicle) {
  for (const std::int64_t obeys_after_ms : {0, 40, 500, 900}) {
    flown_vehicle vehicle;
    vehicle.obeys_after_ms = obeys_after_ms;
    in_flight f(vehicle);
    f.process->world.crash_at("failsafe", crash_point::after_commit);
    f.vehicle.east_m = 101;
    f.process->run_s(20);
    EXPECT_EQ(f.process->world.counters("failsafe").crashes, 1U);
    EXPECT_EQ(f.log.returns(), 1) << obeys_after_ms;
  }
}

TEST(failsafe, started_again_it_tells_its_stance_anew) {
  in_flight f;
  f.vehicle.east_m = 101;
  f.process->run_s(3);
  const auto before = f.log.failsafe_statuses.back();
  f.log.failsafe_statuses.clear();
  ASSERT_TRUE(f.process->world.kill("failsafe"));
  f.process->run_ms(100);
  ASSERT_FALSE(f.log.failsafe_statuses.empty());
  EXPECT_EQ(f.log.failsafe_statuses.front(), before);
  f.process->run_s(5);
  EXPECT_EQ(f.log.failsafe_statuses.back(), before);
}

TEST(failsafe, started_again_it_asks_the_vehicle_and_does_not_wait_for_its_streams) {
  in_flight f;
  f.vehicle.answers_looks = true;
  f.vehicle.streams = false;
  f.vehicle.east_m = 101; // nobody has said it yet
  ASSERT_TRUE(f.process->world.kill("failsafe"));
  f.process->run_ms(500);
  EXPECT_EQ(f.log.returns(), 1);
}

TEST(failsafe, connected_anew_it_asks_the_vehicle_again) {
  in_flight f;
  const auto before = f.log.looks.size();
  f.vehicle.streams = false;
  f.process->world.tell(f.process->failsafe,
                        vehicle_link::connection_changed{vehicle_link::connection_phase::lost, "silence"});
  f.process->run_ms(300);
  EXPECT_EQ(f.log.looks.size(), before);
  f.process->world.tell(f.process->failsafe,
                        vehicle_link::connection_changed{vehicle_link::connection_phase::connected, ""});
  f.process->run_ms(300);
  EXPECT_GT(f.log.looks.size(), before);
}

// -- the process is killed -------------------------------------------------------------------------

TEST(failsafe, a_killed_process_judges_its_fences_again_though_nobody_tells_them) {
  in_flight f;
  f.restart_process();
  f.process->run_s(2);
  EXPECT_TRUE(f.log.commands.empty());
  f.vehicle.east_m = 101;
  f.process->run_s(1);
  EXPECT_EQ(f.log.returns(), 1);
}

TEST(failsafe, a_killed_process_makes_no_second_return) {
  for (std::int64_t after_ms = 0; after_ms <= 600; after_ms += 50) {
    in_flight f;
    f.vehicle.east_m = 101;
    f.process->run_ms(after_ms);
    if (f.log.returns() > 0)
      f.vehicle.mode = px4_return; // it obeyed meanwhile
    f.restart_process();
    f.process->run_s(20);
    EXPECT_EQ(f.log.returns(), 1) << after_ms;
  }
}

// What was sent and never written: only the vehicle knows.
TEST(failsafe, a_process_that_was_killed_before_its_record_was_on_the_disk_makes_no_second_return) {
  in_flight f;
  f.process->world.journal().fail_writes(true);
  f.vehicle.east_m = 101;
  f.process->run_ms(300);
  ASSERT_EQ(f.log.returns(), 1);
  f.vehicle.mode = px4_return;
  f.restart_process();
  f.process->run_s(20);
  EXPECT_EQ(f.log.returns(), 1);
}

TEST(failsafe, a_killed_process_still_leaves_the_vehicle_to_the_pilot) {
  in_flight f;
  f.vehicle.mode = px4_position;
  f.process->run_s(2);
  f.restart_process();
  EXPECT_TRUE(f.process->stands().taken_over);
  f.vehicle.east_m = 101;
  f.process->run_s(20);
  EXPECT_TRUE(f.log.commands.empty());
}

} // namespace failsafe_actor_test
