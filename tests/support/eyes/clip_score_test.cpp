#include "tests/support/eyes/clip_score.hpp"

#include <gtest/gtest.h>

namespace clip_score_test {

using namespace godwit::eyes::test;

constexpr int pictures = 30;

// One walks 3 px a picture to the right, one stands, and a third place is ignored. Ten pictures a second.
clip_labels scene() {
  clip_labels result;
  result.pictures_per_s = 10;
  result.overlap = 0.3;
  for (int n = 1; n <= pictures; ++n)
    result.pictures[n] = {{{"walks", {100.0 + 3 * n, 100, 20, 40}}, {"stands", {500, 100, 20, 40}}},
                          {cv::Rect2d(800, 100, 50, 50)}};
  return result;
}

std::vector<cv::Matx33d> still_ground() { return std::vector<cv::Matx33d>(pictures, cv::Matx33d::eye()); }

clip_detections nothing() {
  clip_detections result;
  result.size = {1280, 720};
  return result;
}

TEST(clip_score, who_walks_and_is_found_in_each_picture_is_perfect) {
  auto found = nothing();
  for (int n = 1; n <= pictures; ++n)
    found.boxes[n] = {{7, cv::Rect2d(100.0 + 3 * n, 100, 20, 40)}};
  const auto score = score_of(scene(), still_ground(), found);
  EXPECT_EQ(score.by_overlap.f1(), 1);
  EXPECT_EQ(score.by_middle.f1(), 1);
  EXPECT_EQ(score.by_middle.found, pictures - 10); // the first ten do not count
  EXPECT_EQ(score.movers, 1);
  EXPECT_EQ(score.movers_found, 1);
  EXPECT_EQ(score.false_tracks, 0);
}

TEST(clip_score, who_stands_or_is_ignored_counts_neither_way) {
  auto found = nothing();
  for (int n = 1; n <= pictures; ++n)
    found.boxes[n] = {{7, cv::Rect2d(500, 100, 20, 40)}, {8, cv::Rect2d(810, 110, 20, 20)}};
  const auto score = score_of(scene(), still_ground(), found);
  EXPECT_EQ(score.by_middle.wrong, 0);
  EXPECT_EQ(score.by_middle.missed, pictures - 10);
  EXPECT_EQ(score.false_tracks, 0);
}

TEST(clip_score, what_only_the_camera_moves_stands) {
  auto labels = scene();
  std::vector<cv::Matx33d> ground(pictures, cv::Matx33d(1, 0, 3, 0, 1, 0, 0, 0, 1));
  const auto score = score_of(labels, ground, nothing());
  EXPECT_EQ(score.by_middle.missed, pictures - 10); // `walks` goes with the ground, and `stands` against it
  EXPECT_EQ(score.movers, 1);
}

TEST(clip_score, a_box_of_six_times_the_area_agrees_by_its_middle_and_not_by_overlap) {
  auto found = nothing();
  for (int n = 1; n <= pictures; ++n)
    found.boxes[n] = {{7, cv::Rect2d(80.0 + 3 * n, 80, 60, 80)}};
  const auto score = score_of(scene(), still_ground(), found);
  EXPECT_EQ(score.by_overlap.f1(), 0);
  EXPECT_EQ(score.by_middle.f1(), 1);
}

TEST(clip_score, a_track_over_bare_ground_is_false_and_counted_a_minute) {
  auto found = nothing();
  for (int n = 11; n <= 13; ++n)
    found.boxes[n] = {{7, cv::Rect2d(300, 400, 20, 20)}};
  found.boxes[20] = {{8, cv::Rect2d(300, 400, 20, 20)}}; // once is a flicker: a false box, no false track
  const auto score = score_of(scene(), still_ground(), found);
  EXPECT_EQ(score.by_middle.wrong, 4);
  EXPECT_EQ(score.false_tracks, 1);
  EXPECT_NEAR(score.false_tracks_per_min, 30, 1e-9); // in 20 pictures of 0.1 s
}

TEST(clip_score, pictures_of_no_use_are_counted) {
  auto found = nothing();
  for (int n = 11; n <= 15; ++n)
    found.is_usable[n] = false;
  EXPECT_NEAR(score_of(scene(), still_ground(), found).usable_share, 0.75, 1e-9);
}

TEST(clip_score, labels_are_read_and_what_is_none_is_an_error) {
  const auto labels = parse_clip_labels(
      R"({"fps": 25, "step": 2, "frames": {"3": {"movers": [["a", 1, 2, 3, 4]], "ignore": [["b", 5, 6, 7, 8], [9, 9, 1, 1]]}}})");
  ASSERT_TRUE(labels) << labels.error();
  EXPECT_EQ(labels->pictures_per_s, 25);
  EXPECT_EQ(labels->step, 2);
  EXPECT_EQ(labels->pictures.at(3).movers.at(0).box, cv::Rect2d(1, 2, 3, 4));
  EXPECT_EQ(labels->pictures.at(3).ignored.at(0), cv::Rect2d(5, 6, 7, 8));
  EXPECT_EQ(labels->pictures.at(3).ignored.at(1), cv::Rect2d(9, 9, 1, 1));
  EXPECT_FALSE(parse_clip_labels("{}"));
  EXPECT_FALSE(parse_clip_labels("no JSON"));
  EXPECT_FALSE(parse_clip_labels(R"({"fps": 0, "frames": {}})"));
}

} // namespace clip_score_test
