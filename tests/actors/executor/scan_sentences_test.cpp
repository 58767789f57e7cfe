#include "actors/executor/scan_sentences.hpp"

#include <gtest/gtest.h>

namespace scan_sentences_test {

using namespace godwit;
using godwit::executor::sentence_about;

TEST(scan_sentences, what_is_shown_says_what_where_and_how_long) {
  scan_controller::point_shown shown;
  shown.number = 3;
  shown.class_group = "vehicle";
  shown.position = {47.3981, 8.5461, {}};
  shown.confidence = 0.9;
  shown.window_ms = 60'000;
  EXPECT_EQ(sentence_about(shown), "point 3: vehicle, 90 %, at 47.39810,8.54610; decide within 60 s");
}

TEST(scan_sentences, what_is_closed_says_how_and_by_whom) {
  using scan_controller::point_outcome;
  EXPECT_EQ(sentence_about(scan_controller::point_closed{3, "m", point_outcome::confirmed, "anna"}),
            "point 3 is confirmed by anna");
  EXPECT_EQ(sentence_about(scan_controller::point_closed{3, "m", point_outcome::passed_over, {}}),
            "point 3 is passed over: nobody has decided");
}

} // namespace scan_sentences_test
