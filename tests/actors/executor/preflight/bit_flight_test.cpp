// For which flight a pass is, and what a restart leaves of it.
#include "actors/executor/preflight/bit.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"
#include "tests/actors/executor/preflight/preparation.hpp"

namespace godwit::executor::preflight {
namespace bit_flight_test {

using namespace test;

// -- for this flight only -------------------------------------------------------------------------

TEST(bit, a_pass_is_for_this_mission_and_this_revision) {
  preparation flight;
  flight.looks({});
  EXPECT_TRUE(is_passed(flight.s, survey, 1));
  EXPECT_FALSE(is_passed(flight.s, survey, 2));
  EXPECT_FALSE(is_passed(flight.s, delivery, 1));
}

TEST(bit, when_the_flight_has_ended_the_pass_is_gone) {
  preparation flight;
  flight.looks(camera);
  EXPECT_TRUE(flight.acknowledges(1).is_taken);
  flight.happens(took_off{});
  const auto news = flight.happens(flight_ended{});
  EXPECT_EQ(said<phase_changed>(news)->now, phase::idle);
  EXPECT_FALSE(flight.is_passed());
  flight.happens(checks_wanted{survey, 1});
  EXPECT_EQ(said<report_opened>(flight.looks(camera))->what.id, 2U) << "the next flight needs its own";
  EXPECT_FALSE(flight.acknowledges(1).is_taken);
}

TEST(bit, another_mission_or_another_revision_ends_the_pass) {
  for (const auto& each : {mission_changed{survey, 2}, mission_changed{delivery, 1}}) {
    preparation flight;
    flight.looks({});
    EXPECT_EQ(said<phase_changed>(flight.happens(each))->now, phase::idle);
    EXPECT_FALSE(flight.is_passed());
  }
}

TEST(bit, the_mission_that_is_checked_does_not_change_by_being_told_again) {
  preparation flight;
  flight.looks({});
  EXPECT_TRUE(flight.happens(mission_changed{survey, 1}).empty());
  EXPECT_TRUE(flight.is_passed());
}

TEST(bit, a_look_at_another_mission_ends_the_pass_too) {
  preparation flight;
  flight.looks({});
  flight.happens(looked{found({}, {}, survey, 2)});
  EXPECT_EQ(flight.s.now, phase::idle);
}

TEST(bit, checks_of_another_mission_begin_anew) {
  preparation flight;
  flight.looks(camera);
  EXPECT_TRUE(flight.acknowledges(1).is_taken);
  flight.happens(checks_wanted{delivery, 1});
  EXPECT_EQ(flight.s.now, phase::running);
  flight.happens(looked{found(camera, {}, delivery)});
  EXPECT_EQ(flight.s.now, phase::awaiting_ack);
  EXPECT_EQ(flight.s.report->id, 2U);
}

TEST(bit, checks_that_are_under_way_or_passed_are_not_begun_again) {
  preparation flight;
  EXPECT_TRUE(flight.happens(checks_wanted{survey, 1}).empty());
  flight.looks(camera);
  EXPECT_TRUE(flight.happens(checks_wanted{survey, 1}).empty());
  EXPECT_TRUE(flight.acknowledges(1).is_taken);
  EXPECT_TRUE(flight.happens(checks_wanted{survey, 1}).empty());
  EXPECT_TRUE(flight.is_passed());
}

// -- in the air -----------------------------------------------------------------------------------

TEST(bit, after_the_take_off_nothing_that_is_seen_takes_the_pass_away) {
  preparation flight;
  flight.looks({});
  EXPECT_TRUE(flight.happens(took_off{}).empty());
  EXPECT_TRUE(flight.looks(camera, no_home).empty());
  EXPECT_FALSE(matters(flight.s, looked{found({}, no_home)}, flight.now_ns));
  EXPECT_TRUE(flight.is_passed());
}

TEST(bit, who_takes_off_without_a_pass_has_none) {
  for (const auto& each : {found(camera), found({}, no_home)}) {
    preparation flight;
    flight.happens(looked{each});
    flight.happens(took_off{});
    EXPECT_EQ(flight.s.now, phase::idle);
  }
}

TEST(bit, a_new_revision_in_the_air_ends_the_pass_for_the_next_start) {
  preparation flight;
  flight.looks({});
  flight.happens(took_off{});
  flight.happens(mission_changed{survey, 2});
  EXPECT_EQ(flight.s.now, phase::idle);
  EXPECT_FALSE(flight.s.is_flying);
}

// -- a restart ------------------------------------------------------------------------------------

TEST(bit, after_a_restart_on_the_ground_a_look_comes_before_the_pass) {
  preparation flight;
  flight.looks({});
  EXPECT_EQ(said<phase_changed>(flight.happens(restarted{}))->now, phase::running);
  EXPECT_FALSE(flight.is_passed());
  flight.looks({});
  EXPECT_TRUE(flight.is_passed());
}

TEST(bit, a_restart_does_not_lose_an_acknowledgement) {
  preparation flight;
  flight.looks(camera);
  EXPECT_TRUE(flight.acknowledges(1).is_taken);
  flight.happens(restarted{});
  EXPECT_TRUE(flight.acknowledges(1).is_taken) << "nor the answer to it";
  EXPECT_FALSE(flight.is_passed());
  flight.looks(camera);
  EXPECT_TRUE(flight.is_passed());
}

TEST(bit, a_restart_does_not_change_the_number_of_the_report_that_waits) {
  preparation flight;
  flight.looks(camera);
  flight.happens(restarted{});
  EXPECT_FALSE(said<report_opened>(flight.looks(camera)));
  EXPECT_EQ(flight.s.now, phase::awaiting_ack);
  EXPECT_TRUE(flight.acknowledges(1).is_taken);
}

TEST(bit, an_acknowledgement_just_after_a_restart_counts_when_the_look_finds_nothing_new) {
  preparation flight;
  flight.looks(camera);
  flight.happens(restarted{});
  EXPECT_TRUE(flight.acknowledges(1).is_taken);
  EXPECT_FALSE(flight.is_passed()) << "the look comes first";
  flight.looks(camera);
  EXPECT_TRUE(flight.is_passed());
}

TEST(bit, a_restart_in_flight_changes_nothing) {
  preparation flight;
  flight.looks({});
  flight.happens(took_off{});
  EXPECT_TRUE(flight.happens(restarted{}).empty());
  EXPECT_TRUE(flight.is_passed());
}

TEST(bit, a_failure_stays_one_over_a_restart) {
  preparation flight;
  flight.looks({}, no_home);
  EXPECT_TRUE(flight.happens(restarted{}).empty());
  EXPECT_EQ(flight.s.now, phase::failed);
}

} // namespace bit_flight_test
} // namespace godwit::executor::preflight
