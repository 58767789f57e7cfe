// What operators acknowledge: a report with a number, in time.
#include "actors/executor/preflight/bit.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"
#include "tests/actors/executor/preflight/preparation.hpp"

namespace godwit::executor::preflight {
namespace bit_acknowledgement_test {

using namespace test;

// -- who, and what ------------------------------------------------------------------------------

TEST(bit, what_is_degraded_waits_for_an_acknowledgement_of_a_numbered_report) {
  preparation flight;
  const auto news = flight.looks(camera);
  const auto opened = said<report_opened>(news);
  ASSERT_TRUE(opened);
  EXPECT_EQ(opened->what.id, 1U);
  EXPECT_EQ(sentences_of(opened->what, verdict::degraded), camera);
  EXPECT_EQ(opened->acknowledge_until_ns, flight.now_ns + 300 * one_second_ns);
  EXPECT_EQ(said<phase_changed>(news)->now, phase::awaiting_ack);
  EXPECT_TRUE(has(said<phase_changed>(news)->sentence, "Report 1 waits for an operator"));
  EXPECT_FALSE(flight.is_passed());
}

TEST(bit, the_acknowledgement_that_names_the_report_makes_it_a_pass) {
  preparation flight;
  flight.looks(camera);
  EXPECT_TRUE(flight.acknowledges(1).is_taken);
  EXPECT_TRUE(flight.is_passed());
  EXPECT_TRUE(has(sentence_of(flight.s), "Ada has acknowledged report 1"));
}

TEST(bit, a_line_without_a_key_is_acknowledged_once_for_its_vehicle_and_anew_for_another) {
  const texts open{"The line to vehicle 7, udpin://0.0.0.0:14550, has no key."};
  const texts of_another{"The line to vehicle 8, udpin://0.0.0.0:14550, has no key."};
  preparation flight;
  flight.looks(open);
  EXPECT_FALSE(flight.is_passed());
  EXPECT_TRUE(flight.acknowledges(1).is_taken);
  flight.happens(flight_ended{});
  flight.happens(checks_wanted{delivery, 1});
  flight.happens(looked{found(open, {}, delivery)});
  EXPECT_TRUE(is_passed(flight.s, delivery, 1)) << "the next flight of it";
  flight.happens(looked{found({open[0], camera[0]}, {}, delivery)});
  EXPECT_EQ(flight.s.now, phase::awaiting_ack);
  EXPECT_EQ(flight.s.report->sentences, camera) << "of what is new alone";
  flight.happens(looked{found(of_another, {}, delivery)});
  EXPECT_EQ(flight.s.now, phase::awaiting_ack);
  EXPECT_EQ(flight.s.report->sentences, of_another);
  for (std::size_t i = 0; i < 3 * max_known_open_lines; ++i) {
    const texts many{"The line to vehicle " + std::to_string(100 + i) + " has no key."};
    flight.happens(looked{found(many, {}, delivery)});
    EXPECT_TRUE(flight.acknowledges(flight.s.report->id).is_taken);
  }
  EXPECT_EQ(flight.s.known_open_lines.size(), max_known_open_lines);
}

TEST(bit, an_acknowledgement_of_another_report_is_refused_and_says_which_is_the_newest) {
  preparation flight;
  flight.looks(camera);
  flight.looks(both);
  for (const std::uint32_t other : {0U, 1U, 3U}) {
    const auto answer = flight.acknowledges(other);
    EXPECT_FALSE(answer.is_taken);
    EXPECT_TRUE(has(answer.reason, "number 2")) << answer.reason;
  }
  EXPECT_EQ(flight.s.now, phase::awaiting_ack);
}

TEST(bit, an_acknowledgement_by_nobody_is_refused) {
  preparation flight;
  flight.looks(camera);
  EXPECT_FALSE(flight.acknowledges(1, "").is_taken);
  EXPECT_FALSE(flight.is_passed());
}

TEST(bit, an_acknowledgement_when_nothing_waits_is_refused) {
  preparation flight;
  EXPECT_FALSE(flight.acknowledges(1).is_taken);
  flight.looks({});
  EXPECT_FALSE(flight.acknowledges(1).is_taken);
}

TEST(bit, an_acknowledgement_again_is_taken_again_and_the_first_one_stays) {
  preparation flight;
  flight.looks(camera);
  EXPECT_TRUE(flight.acknowledges(1, "Ada").is_taken);
  EXPECT_TRUE(flight.acknowledges(1, "Bob").is_taken);
  EXPECT_EQ(flight.s.report->acknowledged_by, "Ada");
}

TEST(bit, the_name_of_who_acknowledges_has_a_bound) {
  preparation flight;
  flight.looks(camera);
  EXPECT_TRUE(flight.acknowledges(1, std::string(10'000, 'x')).is_taken);
  EXPECT_EQ(flight.s.report->acknowledged_by.size(), max_operator_name);
}

// -- the number of a report -----------------------------------------------------------------------

TEST(bit, the_same_sentences_are_the_same_report_so_that_it_can_be_named) {
  preparation flight;
  flight.looks(both);
  EXPECT_TRUE(flight.looks({both[1], both[0]}).empty()) << "in whatever order";
  EXPECT_EQ(flight.s.report->id, 1U);
}

TEST(bit, another_sentence_is_another_report_with_its_own_deadline) {
  preparation flight;
  flight.looks(camera);
  flight.passes_s(200);
  const auto opened = said<report_opened>(flight.looks(both));
  ASSERT_TRUE(opened);
  EXPECT_EQ(opened->what.id, 2U);
  EXPECT_EQ(opened->acknowledge_until_ns, flight.now_ns + 300 * one_second_ns);
}

TEST(bit, fewer_sentences_are_no_new_report) {
  preparation flight;
  flight.looks(both);
  EXPECT_TRUE(flight.looks(camera).empty());
  EXPECT_TRUE(flight.acknowledges(1).is_taken);
  EXPECT_TRUE(flight.is_passed());
}

TEST(bit, when_nothing_degrades_any_more_no_acknowledgement_is_needed) {
  preparation flight;
  flight.looks(camera);
  flight.looks({});
  EXPECT_TRUE(flight.is_passed());
}

TEST(bit, what_comes_and_goes_stays_the_same_report) {
  preparation flight;
  for (int i = 0; i < 20; ++i) {
    flight.looks(camera);
    EXPECT_FALSE(flight.is_passed());
    flight.looks({});
  }
  EXPECT_EQ(flight.s.report->id, 1U);
  EXPECT_TRUE(flight.acknowledges(1).is_taken) << "also while it is gone";
  flight.looks(camera);
  EXPECT_TRUE(flight.is_passed());
}

// -- the deadline ---------------------------------------------------------------------------------

TEST(bit, a_report_that_nobody_acknowledges_within_five_minutes_has_failed) {
  preparation flight;
  flight.looks(camera);
  flight.passes_s(298);
  EXPECT_TRUE(flight.looks(camera).empty()) << "a second is left";
  const auto news = flight.looks(camera);
  EXPECT_EQ(said<phase_changed>(news)->now, phase::failed);
  EXPECT_TRUE(has(said<phase_changed>(news)->sentence, "Report 1 was not acknowledged within 5 minutes"));
}

TEST(bit, an_acknowledgement_after_the_deadline_is_refused) {
  preparation flight;
  flight.looks(camera);
  flight.passes_s(299);
  EXPECT_FALSE(flight.acknowledges(1).is_taken) << "the deadline passed and nobody had looked since";
  EXPECT_EQ(flight.s.now, phase::failed);
  EXPECT_FALSE(flight.acknowledges(1).is_taken);
}

TEST(bit, an_acknowledged_report_has_no_deadline_any_more) {
  preparation flight;
  flight.looks(camera);
  EXPECT_TRUE(flight.acknowledges(1).is_taken);
  flight.passes_s(10'000);
  flight.looks(camera);
  EXPECT_TRUE(flight.is_passed());
}

TEST(bit, a_report_that_was_not_acknowledged_is_not_opened_again_by_itself) {
  preparation flight;
  flight.looks(camera);
  flight.passes_s(300);
  for (const auto& each : {camera, both, map}) {
    EXPECT_FALSE(said<report_opened>(flight.looks(each)));
    EXPECT_EQ(flight.s.now, phase::failed);
  }
}

TEST(bit, after_the_deadline_a_new_look_can_be_asked_for) {
  preparation flight;
  flight.looks(camera);
  flight.passes_s(300);
  flight.looks(camera);
  flight.happens(checks_wanted{survey, 1});
  EXPECT_EQ(flight.s.now, phase::running);
  EXPECT_EQ(said<report_opened>(flight.looks(camera))->what.id, 2U);
}

TEST(bit, after_the_deadline_what_is_better_is_a_new_report) {
  preparation flight;
  flight.looks(both);
  flight.passes_s(300);
  flight.looks(both);
  EXPECT_EQ(said<report_opened>(flight.looks(camera))->what.id, 2U);
  EXPECT_EQ(flight.s.now, phase::awaiting_ack);
}

TEST(bit, after_the_deadline_all_well_is_a_pass) {
  preparation flight;
  flight.looks(camera);
  flight.passes_s(300);
  flight.looks(camera);
  flight.looks({});
  EXPECT_TRUE(flight.is_passed());
}

TEST(bit, a_report_whose_time_passed_while_it_was_well_is_a_new_one) {
  preparation flight;
  flight.looks(camera);
  flight.looks({});
  flight.passes_s(300);
  EXPECT_EQ(said<report_opened>(flight.looks(camera))->what.id, 2U);
}

TEST(bit, a_clock_that_was_set_back_does_not_prolong_the_deadline) {
  preparation flight;
  flight.looks(camera);
  flight.passes_s(-3'600);
  EXPECT_FALSE(flight.acknowledges(1).is_taken);
  EXPECT_EQ(flight.s.now, phase::failed);
}

} // namespace bit_acknowledgement_test
} // namespace godwit::executor::preflight
