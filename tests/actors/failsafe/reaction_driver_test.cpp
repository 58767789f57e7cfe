#include <algorithm>

#include <gtest/gtest.h>

#include "actors/failsafe/events.hpp"
#include "actors/failsafe/reaction_driver.hpp"

namespace reaction_driver_test {

using namespace godwit::failsafe;
using godwit::vehicle_link::command_verdict;

constexpr std::int64_t tick = 100 * ns_per_ms;
constexpr std::int64_t s = ns_per_s;

constexpr command_verdict no_effect[] = {command_verdict::refused, command_verdict::not_sent,
                                         command_verdict::already_running, command_verdict::too_many,
                                         command_verdict::invalid};

reaction_driver::look sees(mode_kind mode, std::int64_t heartbeat_ns = 0, bool may_send = true) {
  return {.mode = mode, .heartbeat_ns = heartbeat_ns, .may_send = may_send};
}

struct sent_one {
  reaction_driver driver{std::nullopt, 0, 0};
  std::uint64_t number = 0;
  explicit sent_one(action what = action::return_home) {
    driver.begin(rule::fence, what);
    number = driver.drive(sees(mode_kind::mission), 0).send.value().number;
  }
};

TEST(reaction_driver, it_sends_at_once_and_only_once) {
  sent_one one;
  for (std::int64_t now = tick; now < s; now += tick)
    EXPECT_FALSE(one.driver.drive(sees(mode_kind::mission), now).send);
}

TEST(reaction_driver, what_the_vehicle_does_already_is_not_sent) {
  reaction_driver driver({}, 0, 0);
  driver.begin(rule::fence, action::return_home);
  EXPECT_FALSE(driver.drive(sees(mode_kind::landing), 0).send);
  EXPECT_EQ(driver.current()->phase, reaction_phase::done);
}

TEST(reaction_driver, sending_fails_again_each_tick) {
  for (const auto verdict : no_effect) {
    sent_one one;
    for (int i = 1; i <= 300; ++i) {
      one.driver.on_resolved({one.driver.last_number(), verdict});
      const auto step = one.driver.drive(sees(mode_kind::mission), i * tick);
      ASSERT_TRUE(step.send) << i;
      EXPECT_EQ(step.send->confirmation, std::min(i, 255));
      EXPECT_EQ(step.fails_first, i == 1);
      EXPECT_EQ(one.driver.stage(), reaction_stage::failing);
    }
  }
}

TEST(reaction_driver, accepted_is_waited_for_3_s_and_then_sent_again) {
  sent_one one;
  one.driver.on_resolved({one.number, command_verdict::accepted});
  (void)one.driver.drive(sees(mode_kind::mission, tick), tick);
  EXPECT_EQ(one.driver.stage(), reaction_stage::under_way);
  for (std::int64_t now = 2 * tick; now < tick + 3 * s; now += tick)
    EXPECT_FALSE(one.driver.drive(sees(mode_kind::mission, now), now).send);
  const auto step = one.driver.drive(sees(mode_kind::mission, tick + 3 * s), tick + 3 * s);
  EXPECT_TRUE(step.send);
  EXPECT_TRUE(step.disobeyed);
  EXPECT_EQ(one.driver.stage(), reaction_stage::failing);
}

TEST(reaction_driver, a_vehicle_that_accepts_again_and_again_and_never_obeys_is_complained_of_once) {
  sent_one one;
  int complaints = 0;
  int sent = 0;
  for (std::int64_t now = tick; now < 60 * s; now += tick) {
    one.driver.on_resolved({one.driver.last_number(), command_verdict::accepted});
    const auto step = one.driver.drive(sees(mode_kind::mission, now), now);
    complaints += step.disobeyed ? 1 : 0;
    sent += step.send ? 1 : 0;
    EXPECT_FALSE(step.fails_first);
  }
  EXPECT_EQ(complaints, 1);
  EXPECT_NEAR(sent, 19, 1);
}

TEST(reaction_driver, that_it_was_not_obeyed_is_believed_of_a_later_heartbeat_only) {
  sent_one one;
  one.driver.on_resolved({one.number, command_verdict::accepted});
  for (std::int64_t now = tick; now < 10 * s; now += tick)
    EXPECT_FALSE(one.driver.drive(sees(mode_kind::mission, tick), now).send);
}

TEST(reaction_driver, a_command_of_ours_that_led_out_of_what_was_done_is_answered_with_the_same_again) {
  sent_one one;
  (void)one.driver.drive(sees(mode_kind::returning, tick), tick);
  const auto step = one.driver.drive(sees(mode_kind::mission, s), s);
  EXPECT_TRUE(step.was_left);
  EXPECT_FALSE(step.fails_first);
  EXPECT_EQ(step.send.value().what, action::return_home);
}

TEST(reaction_driver, a_pilot_who_led_out_of_what_was_done_is_left_alone) {
  sent_one one;
  (void)one.driver.drive(sees(mode_kind::returning, tick), tick);
  auto look = sees(mode_kind::manual, s);
  look.is_ours = false;
  EXPECT_FALSE(one.driver.drive(look, s).send);
  EXPECT_EQ(one.driver.current()->phase, reaction_phase::done);
}

TEST(reaction_driver, the_mode_that_shows_it_is_as_good_as_an_answer) {
  sent_one one;
  (void)one.driver.drive(sees(mode_kind::returning, tick), tick);
  EXPECT_EQ(one.driver.current()->phase, reaction_phase::done);
  one.driver.on_resolved({one.number, command_verdict::timed_out});
  EXPECT_FALSE(one.driver.drive(sees(mode_kind::returning, tick), s).send);
}

TEST(reaction_driver, without_an_answer_it_looks_at_a_later_heartbeat_before_it_sends_again) {
  for (const auto verdict : {command_verdict::timed_out, command_verdict::vehicle_restarted}) {
    sent_one one;
    one.driver.on_resolved({one.number, verdict});
    EXPECT_FALSE(one.driver.drive(sees(mode_kind::mission, s / 2), s).send) << "this heartbeat may be too early";
    auto obeyed = one.driver;
    EXPECT_FALSE(obeyed.drive(sees(mode_kind::returning, 2 * s), 2 * s).send);
    EXPECT_TRUE(one.driver.drive(sees(mode_kind::mission, 2 * s), 2 * s).send);
  }
}

TEST(reaction_driver, an_answer_that_never_comes_is_none) {
  sent_one one;
  EXPECT_FALSE(one.driver.drive(sees(mode_kind::mission, 2 * s), 3 * s - 1).send);
  const auto gives_up = one.driver.drive(sees(mode_kind::mission, 2 * s), 3 * s);
  EXPECT_FALSE(gives_up.send);
  EXPECT_TRUE(gives_up.fails_first);
  EXPECT_TRUE(one.driver.drive(sees(mode_kind::mission, 3 * s + tick), 3 * s + tick).send);
}

TEST(reaction_driver, an_answer_to_an_older_command_says_nothing) {
  sent_one one;
  one.driver.on_resolved({one.number, command_verdict::refused});
  const auto second = one.driver.drive(sees(mode_kind::mission), tick).send.value().number;
  EXPECT_GT(second, one.number);
  one.driver.on_resolved({one.number, command_verdict::accepted});
  EXPECT_FALSE(one.driver.drive(sees(mode_kind::mission), 2 * tick).send);
  EXPECT_EQ(one.driver.current()->phase, reaction_phase::in_flight);
}

TEST(reaction_driver, an_aeroplane_whose_plan_has_no_landing_after_all_returns) {
  for (const auto verdict : {command_verdict::refused, command_verdict::invalid}) {
    sent_one one(action::do_land_start);
    one.driver.on_resolved({one.number, verdict});
    EXPECT_EQ(one.driver.drive(sees(mode_kind::mission), tick).send.value().what, action::return_home);
  }
  sent_one lost(action::do_land_start);
  lost.driver.on_resolved({lost.number, command_verdict::not_sent});
  EXPECT_EQ(lost.driver.drive(sees(mode_kind::mission), tick).send.value().what, action::do_land_start);
}

TEST(reaction_driver, that_a_plan_is_at_its_landing_shows_in_its_sequence) {
  sent_one one(action::do_land_start);
  auto look = sees(mode_kind::mission, tick);
  look.on_landing = true;
  (void)one.driver.drive(look, tick);
  EXPECT_EQ(one.driver.current()->phase, reaction_phase::done);
}

TEST(reaction_driver, without_an_answer_a_landing_is_looked_for_in_a_later_sequence_and_else_it_returns) {
  sent_one one(action::do_land_start);
  one.driver.on_resolved({one.number, command_verdict::timed_out});
  (void)one.driver.drive(sees(mode_kind::mission, s), s);
  EXPECT_FALSE(one.driver.drive(sees(mode_kind::mission, 2 * s), 2 * s).send) << "the sequence is an old one";
  auto seen = sees(mode_kind::mission, 2 * s);
  seen.sequence_ns = 2 * s;
  auto again = one.driver;
  EXPECT_EQ(again.drive(seen, 2 * s).send.value().what, action::do_land_start);
  EXPECT_EQ(one.driver.drive(sees(mode_kind::mission, 4 * s), 4 * s).send.value().what, action::return_home);
}

TEST(reaction_driver, where_no_sequence_comes_nobody_complains_of_a_landing_that_does_not_show) {
  sent_one one(action::do_land_start);
  one.driver.on_resolved({one.number, command_verdict::accepted});
  for (std::int64_t now = tick; now < 20 * s; now += tick) {
    const auto step = one.driver.drive(sees(mode_kind::mission, now), now);
    EXPECT_FALSE(step.send || step.disobeyed);
  }
}

TEST(reaction_driver, while_it_may_not_send_it_waits) {
  reaction_driver driver({}, 0, 0);
  driver.begin(rule::fence, action::return_home);
  EXPECT_FALSE(driver.drive(sees(mode_kind::mission, 0, false), 0).send);
  EXPECT_TRUE(driver.drive(sees(mode_kind::mission, tick), tick).send);
}

TEST(reaction_driver, a_higher_rule_that_wants_the_same_sends_nothing_new) {
  sent_one one;
  one.driver.raise(rule::battery_critical);
  EXPECT_FALSE(one.driver.drive(sees(mode_kind::mission), tick).send);
  EXPECT_EQ(one.driver.current()->why, rule::battery_critical);
}

TEST(reaction_driver, another_action_takes_the_place_of_the_first) {
  sent_one one;
  one.driver.begin(rule::battery_critical, action::land);
  const auto step = one.driver.drive(sees(mode_kind::returning), tick);
  EXPECT_EQ(step.send.value().what, action::land);
  EXPECT_EQ(step.send.value().confirmation, 0) << "a command of its own";
}

TEST(reaction_driver, after_a_restart_what_was_in_flight_is_waited_for) {
  sent_one one;
  reaction_driver restored(one.driver.current(), one.driver.last_number(), 100 * s);
  EXPECT_FALSE(restored.drive(sees(mode_kind::mission, 100 * s + tick), 100 * s + tick).send);
  EXPECT_FALSE(restored.drive(sees(mode_kind::mission, 102 * s), 103 * s).send) << "given up only now";
  auto obeyed = restored;
  EXPECT_FALSE(obeyed.drive(sees(mode_kind::returning, 104 * s), 104 * s).send);
  const auto again = restored.drive(sees(mode_kind::mission, 104 * s), 104 * s);
  EXPECT_GT(again.send.value().number, one.number) << "numbers go on rising";
}

TEST(reaction_driver, after_a_restart_what_was_accepted_or_done_and_shows_is_not_sent_again) {
  for (const auto phase : {reaction_phase::accepted, reaction_phase::done}) {
    reaction_driver restored(reaction{rule::fence, action::return_home, phase, 1}, 1, 0);
    for (std::int64_t now = tick; now < 20 * s; now += tick)
      EXPECT_FALSE(restored.drive(sees(mode_kind::returning, now), now).send);
  }
}

TEST(reaction_driver, without_a_reaction_nothing_happens) {
  reaction_driver driver({}, 0, 0);
  driver.on_resolved({0, command_verdict::refused});
  EXPECT_FALSE(driver.drive(sees(mode_kind::mission), 0).send);
  EXPECT_FALSE(driver.current());
}

TEST(reaction_driver, what_failed_before_says_nothing_of_the_next_one) {
  sent_one one;
  one.driver.on_resolved({one.number, command_verdict::refused});
  (void)one.driver.drive(sees(mode_kind::mission), tick);
  ASSERT_EQ(one.driver.stage(), reaction_stage::failing);
  one.driver.begin(rule::battery_critical, action::land);
  EXPECT_EQ(one.driver.stage(), reaction_stage::under_way);
}

TEST(reaction_driver, a_plan_at_its_landing_is_not_left_while_its_mode_stays) {
  reaction_driver driver({}, 0, 0);
  driver.begin(rule::battery_low, action::do_land_start);
  auto seen = sees(mode_kind::mission);
  seen.on_landing = true;
  (void)driver.drive(seen, 0);
  ASSERT_EQ(driver.stage(), reaction_stage::done);
  seen.on_landing = false; // its sequence is not heard for a moment
  const auto step = driver.drive(seen, tick);
  EXPECT_FALSE(step.send);
  EXPECT_FALSE(step.was_left);
  EXPECT_EQ(driver.stage(), reaction_stage::done);
}

TEST(reaction_driver, what_stays_done_is_not_told_to_be_left) {
  sent_one one;
  EXPECT_FALSE(one.driver.drive(sees(mode_kind::returning), tick).was_left);
  EXPECT_FALSE(one.driver.drive(sees(mode_kind::returning), 2 * tick).was_left);
}

} // namespace reaction_driver_test
