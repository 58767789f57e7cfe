#include "programs/godwit-eyes/detection/class_questions.hpp"

#include <map>

#include <gtest/gtest.h>

namespace godwit::eyes {
namespace class_questions_test {

constexpr double day = 120;
constexpr double picture_s = 0.1;

// A net that takes a fixed time, knows what lies left of the middle, and counts who it was asked about.
struct asked_about {
  std::vector<track> tracks;
  double cost_ms = 1;
  double now_ms = 0;
  double ask_ms = 0;
  std::map<double, int> asked; // by the left border of the box, in pixels of the picture
  class_questions all{[this](const frame_view&, const pixel_box& about) {
                        now_ms += cost_ms;
                        ask_ms += cost_ms;
                        ++asked[about.x_px];
                        return about.x_px < 320 ? class_answer{object_class::person, 0.9, about} : class_answer{};
                      },
                      [this] { return now_ms; }};

  void add(double x, double length = 30, int seen = 10) {
    const cv::Size2d size(length / 2, length);
    track made{static_cast<std::uint32_t>(tracks.size() + 1), track_filter({x + length / 4, 100}, 1), size, {x, 100}};
    made.seen = seen;
    tracks.push_back(made);
  }
  void step(int pictures, double brightness = day) {
    for (int n = 0; n < pictures; ++n)
      all.step(tracks, {}, 1, brightness, picture_s);
  }
};

TEST(class_questions, take_at_most_four_milliseconds_a_picture_on_average) {
  for (const double cost : {0.5, 3.0, 15.0, 55.0}) {
    asked_about a;
    a.cost_ms = cost;
    for (int n = 0; n < 60; ++n)
      a.add(10.0 * n);
    a.step(300);
    EXPECT_LE(a.ask_ms, 300 * class_questions::ms_a_picture + cost) << cost;
    EXPECT_GE(a.ask_ms, 0.8 * std::min(300 * class_questions::ms_a_picture, 60 * 60 * cost)) << cost;
  }
}

TEST(class_questions, go_to_who_was_never_asked_about_and_then_to_the_oldest_answer) {
  asked_about a;
  a.cost_ms = 4;
  for (int n = 0; n < 10; ++n)
    a.add(10.0 * n);
  a.step(9);
  EXPECT_EQ(a.asked.size(), 9U);
  a.add(500);
  a.step(2);
  EXPECT_EQ(a.asked.size(), 11U);
  a.step(11);
  for (const auto& [x, times] : a.asked)
    EXPECT_EQ(times, 2) << x;
}

TEST(class_questions, leave_out_what_is_small_new_or_not_seen_now_and_what_was_answered_just_now) {
  asked_about a;
  a.add(10, class_questions::least_length_px - 1);
  a.add(20, 30, class_questions::least_seen - 1);
  a.add(30);
  a.tracks.back().missed = 1;
  a.add(40);
  a.step(5);
  EXPECT_EQ(a.asked, (std::map<double, int>{{40, 1}}));
  a.step(1);
  EXPECT_EQ(a.asked.at(40), 2);
}

TEST(class_questions, count_against_only_what_is_large_by_day_while_the_net_recognises_something) {
  const auto is_unlike = [](double length, double brightness, bool recognises) {
    asked_about a;
    if (recognises)
      a.add(10);
    a.step(10, brightness);
    a.add(400, length);
    a.step(10, brightness);
    return a.tracks.back().looks.is_surely_unlike();
  };
  const double large = class_questions::least_known_px + 1;
  EXPECT_TRUE(is_unlike(large, day, true));
  EXPECT_FALSE(is_unlike(large - 2, day, true));
  EXPECT_FALSE(is_unlike(large, class_questions::least_day_brightness - 1, true));
  EXPECT_FALSE(is_unlike(large, day, false));
}

TEST(class_questions, say_the_box_in_pixels_of_the_track) {
  asked_about a;
  a.add(100);
  a.all.step(a.tracks, {}, 2, day, picture_s);
  EXPECT_EQ(a.asked.begin()->first, 200);
  ASSERT_TRUE(a.tracks[0].looks.extent());
  EXPECT_NEAR(a.tracks[0].looks.extent()->x, -7.5, 1e-9);
  EXPECT_NEAR(a.tracks[0].looks.extent()->height, 30, 1e-9);
}

} // namespace class_questions_test
} // namespace godwit::eyes
