#include "actors/executor/preflight/bit.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"
#include "tests/actors/executor/preflight/preparation.hpp"

namespace godwit::executor::preflight {
namespace bit_test {

using namespace test;

// -- from idle to a verdict -----------------------------------------------------------------------

TEST(bit, before_a_flight_is_prepared_it_is_idle_and_looks_change_nothing) {
  state s;
  EXPECT_TRUE(apply(s, looked{found({})}, 1).empty());
  EXPECT_EQ(s.now, phase::idle);
  EXPECT_FALSE(is_passed(s, survey, 1));
}

TEST(bit, it_runs_until_the_first_look) {
  state s;
  const auto news = apply(s, checks_wanted{survey, 1}, 1);
  ASSERT_EQ(news.size(), 1U);
  EXPECT_EQ(std::get<phase_changed>(news[0]).now, phase::running);
  EXPECT_FALSE(is_passed(s, survey, 1));
}

TEST(bit, a_look_in_which_all_is_well_is_a_pass) {
  preparation flight;
  const auto news = flight.looks({});
  EXPECT_EQ(said<phase_changed>(news)->now, phase::pass);
  EXPECT_TRUE(flight.is_passed());
}

TEST(bit, the_real_checks_lead_to_a_pass) {
  preparation flight;
  flight.happens(checks_wanted{small_mission().mission_id, small_mission().revision});
  flight.happens(looked{run_checks(good_facts(), {})});
  EXPECT_TRUE(is_passed(flight.s, small_mission().mission_id, small_mission().revision));
}

TEST(bit, one_that_fails_blocks_and_the_reason_is_its_sentence) {
  preparation flight;
  const auto news = flight.looks(camera, no_home);
  EXPECT_EQ(said<phase_changed>(news)->now, phase::failed);
  EXPECT_EQ(said<phase_changed>(news)->sentence, no_home[0]);
  EXPECT_FALSE(said<report_opened>(news)) << "there is nothing to acknowledge while something fails";
  EXPECT_FALSE(flight.is_passed());
}

TEST(bit, a_failure_can_not_be_acknowledged) {
  preparation flight;
  flight.looks(camera);
  flight.looks(camera, no_home);
  EXPECT_FALSE(flight.acknowledges(1).is_taken);
  EXPECT_EQ(flight.s.now, phase::failed);
}

TEST(bit, a_look_at_nothing_is_no_pass) {
  preparation flight;
  flight.happens(looked{report{0, survey, 1, verdict::fail, {}}});
  EXPECT_EQ(flight.s.now, phase::failed);
  flight.happens(looked{report{0, survey, 1, verdict::skipped, {{"camera", verdict::skipped, "It is off."}}}});
  EXPECT_EQ(flight.s.now, phase::failed);
  EXPECT_FALSE(sentence_of(flight.s).empty());
}

TEST(bit, the_same_look_again_is_no_news_and_does_not_matter) {
  preparation flight;
  for (const auto& each : {found({}), found(camera), found(camera, no_home)}) {
    EXPECT_TRUE(matters(flight.s, looked{each}, flight.now_ns));
    EXPECT_FALSE(flight.happens(looked{each}).empty());
    EXPECT_FALSE(matters(flight.s, looked{each}, flight.now_ns));
    EXPECT_TRUE(flight.happens(looked{each}).empty());
  }
}

TEST(bit, another_reason_of_a_failure_is_news) {
  preparation flight;
  flight.looks({}, {"The battery is at 40 %."});
  EXPECT_EQ(said<phase_changed>(flight.looks({}, {"The battery is at 39 %."}))->sentence, "The battery is at 39 %.");
}

// -- worse and better -----------------------------------------------------------------------------

TEST(bit, what_fails_after_a_pass_takes_the_pass_away) {
  preparation flight;
  flight.looks({});
  EXPECT_EQ(said<phase_changed>(flight.looks({}, no_home))->now, phase::failed);
  EXPECT_FALSE(flight.is_passed());
}

TEST(bit, what_degrades_after_a_pass_has_to_be_acknowledged) {
  preparation flight;
  flight.looks({});
  flight.looks(camera);
  EXPECT_EQ(flight.s.now, phase::awaiting_ack);
}

TEST(bit, what_degrades_after_an_acknowledgement_of_something_else_needs_another_one_for_all) {
  preparation flight;
  flight.looks(camera);
  EXPECT_TRUE(flight.acknowledges(1).is_taken);
  const auto opened = said<report_opened>(flight.looks(both));
  ASSERT_TRUE(opened);
  EXPECT_EQ(sentences_of(opened->what, verdict::degraded), both);
  EXPECT_FALSE(flight.acknowledges(1).is_taken);
  EXPECT_TRUE(flight.acknowledges(2).is_taken);
  EXPECT_TRUE(flight.is_passed());
}

TEST(bit, what_was_acknowledged_may_come_and_go) {
  preparation flight;
  flight.looks(both);
  EXPECT_TRUE(flight.acknowledges(1).is_taken);
  for (const auto& each : {texts{}, camera, map, both}) {
    EXPECT_FALSE(said<report_opened>(flight.looks(each)));
    EXPECT_TRUE(flight.is_passed());
  }
}

TEST(bit, a_failure_that_is_mended_leads_to_a_new_look_without_an_operator) {
  preparation flight;
  flight.looks({}, no_home);
  flight.looks({});
  EXPECT_TRUE(flight.is_passed());
}

TEST(bit, after_a_failure_there_is_a_new_report_and_the_old_acknowledgement_does_not_count) {
  preparation flight;
  flight.looks(camera);
  EXPECT_TRUE(flight.acknowledges(1).is_taken);
  flight.looks(camera, no_home);
  EXPECT_EQ(said<report_opened>(flight.looks(camera))->what.id, 2U);
  EXPECT_FALSE(flight.acknowledges(1).is_taken);
  EXPECT_FALSE(flight.is_passed());
}

// -- just before a start --------------------------------------------------------------------------

std::string why_not(const preparation& flight, const report& seen) {
  return why_not_start(flight.s, seen, flight.now_ns + one_second_ns);
}

TEST(bit, with_a_pass_and_a_look_that_finds_nothing_new_it_may_start) {
  preparation flight;
  flight.looks(camera);
  EXPECT_TRUE(flight.acknowledges(1).is_taken);
  EXPECT_EQ(why_not(flight, found(camera)), "");
  EXPECT_EQ(why_not(flight, found({})), "");
}

TEST(bit, what_a_look_just_before_the_start_finds_blocks_it_at_once) {
  preparation flight;
  flight.looks({});
  EXPECT_EQ(why_not(flight, found({}, no_home)), no_home[0]);
  EXPECT_TRUE(has(why_not(flight, found(camera)), "Report 1 waits for an operator"));
  EXPECT_TRUE(flight.is_passed()) << "to ask changes nothing";
}

TEST(bit, a_look_at_another_mission_just_before_the_start_blocks_it) {
  preparation flight;
  flight.looks({});
  EXPECT_TRUE(has(why_not(flight, found({}, {}, survey, 2)), "The mission was changed"));
  EXPECT_NE(why_not(flight, found({}, {}, delivery)), "");
}

TEST(bit, without_preparation_nothing_starts_however_well_all_is) {
  EXPECT_EQ(why_not_start({}, found({}), 1), "No preflight checks were asked for.");
  EXPECT_EQ(why_not_start({}, found({}, {}, "", 0), 1), "No preflight checks were asked for.");
}

} // namespace bit_test
} // namespace godwit::executor::preflight
