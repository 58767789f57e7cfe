// How well boxes agree with labels on real footage, picture by picture and track by track.
//
// A mover counts where it moves more than `counted_lengths_per_s` of its length over the ground within a second; what
// moves less, lies at the border or is marked as ignored counts neither as found nor as false. Two figures: boxes that
// overlap (intersection by union), and boxes whose middle lies within 0.6 of the mover's length of its middle at 0.1 to
// 8 times its area. A false track covers no mover in two pictures or more, and in more than twice as many as it covers
// one. Boxes and labels are in pixels of the full picture. Errors: a sentence. Thread: plain values.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>
#include <tl/expected.hpp>

namespace godwit::eyes::test {

struct labelled_mover {
  std::string id;
  cv::Rect2d box;
};

struct labelled_picture {
  std::vector<labelled_mover> movers;
  std::vector<cv::Rect2d> ignored;
};

struct clip_labels {
  double pictures_per_s = 0;
  int step = 1;                             // only one of so many pictures is labelled
  int warm = 10;                            // pictures at the beginning that do not count
  double overlap = 0;                       // of boxes that agree
  std::map<int, labelled_picture> pictures; // from 1
};

struct found_box {
  std::uint32_t track = 0;
  cv::Rect2d box;
};

struct clip_detections {
  cv::Size size; // of the pictures
  std::map<int, std::vector<found_box>> boxes;
  std::map<int, bool> is_usable; // a picture that is missing was usable
};

struct clip_tally {
  int found = 0;
  int wrong = 0;
  int missed = 0;
  [[nodiscard]] double precision() const { return found == 0 ? 0 : static_cast<double>(found) / (found + wrong); }
  [[nodiscard]] double recall() const { return found == 0 ? 0 : static_cast<double>(found) / (found + missed); }
  [[nodiscard]] double f1() const { return found == 0 ? 0 : 2.0 * found / (2.0 * found + wrong + missed); }
};

struct clip_score {
  clip_tally by_overlap;
  clip_tally by_middle;
  int movers = 0; // that count in five pictures or more
  int movers_found = 0;
  int false_tracks = 0;
  double false_tracks_per_min = 0;
  double usable_share = 0;
};

[[nodiscard]] tl::expected<clip_labels, std::string> parse_clip_labels(const std::string& json);

// GROUND: for each picture how the ground moved since the one before; the first is of the first picture.
[[nodiscard]] clip_score score_of(const clip_labels& labels, const std::vector<cv::Matx33d>& ground,
                                  const clip_detections& found);

} // namespace godwit::eyes::test
