// Which blobs belong to one thing over time, and which of these things really move over the ground.
//
// A blob goes to the track that expects it, nearest first; blobs that lie in one track's box are parts of one thing. A
// track is confirmed when it was seen in enough pictures, has gone farther than its place is unsure, and has gone there
// straight rather than to and fro. All of that is counted from where it was last cut off: at the border of what is
// known a box shows where the border is. A scene is taken to be cluttered until pictures show that it is not. Pixels
// are those of the reduced picture. Thread: one.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "programs/godwit-eyes/detection/blobs.hpp"
#include "programs/godwit-eyes/detection/track_filter.hpp"

namespace godwit::eyes {

struct track {
  struct place { // where it was seen
    int age = 0; // of the track
    cv::Rect2d box;
  };
  std::uint32_t number = 0;
  track_filter filter;
  cv::Size2d size;            // smoothed
  cv::Point2d born;           // its first place, carried along with the ground
  int age = 0;                // pictures since then
  int seen = 0;               // of these, with a blob
  int missed = 0;             // since it was last seen
  double way_px = 0;          // added up against the ground, from picture to picture
  std::deque<place> places{}; // the last ones, each in the pixels of its picture
  int along_parallax = 0;     // pictures in which it went as something high and still would go
  bool is_confirmed = false;
};

struct tracker_settings {
  int frames_to_confirm = 5;
  std::size_t max_tracks = 64;
};

class tracker {
public:
  static constexpr double cluttered_births = 2.5; // new tracks a picture

  explicit tracker(const tracker_settings& settings) : settings_(settings) {}

  // Whether a track that has shown all that is demanded has really moved.
  using prover = std::function<bool(const track& who)>;
  // Every picture, also one without blobs. GROUND: how it moved since the last one. PROVES is asked where the scene is
  // cluttered, and less is demanded there for it; none: nothing can be proved.
  void step(std::span<const blob> blobs, double dt_s, const cv::Matx33d& ground, const cv::Size& picture,
            const prover& proves = {});
  [[nodiscard]] std::vector<track>& tracks() { return tracks_; }
  [[nodiscard]] const std::vector<track>& tracks() const { return tracks_; }
  [[nodiscard]] bool is_full() const { return is_full_; } // more things than it can follow
  void forget() {
    tracks_.clear();
    grounds_.clear();
    births_ = cluttered_births;
  }

private:
  void assign(std::span<const blob> blobs, std::vector<bool>& is_taken);
  void see(track& who, const cv::Rect2d& box);
  [[nodiscard]] bool is_whole(const cv::Rect2d& box) const;
  [[nodiscard]] double clutter() const; // 0 to 1

  tracker_settings settings_;
  std::vector<track> tracks_;
  std::uint32_t last_number_ = 0;
  cv::Size picture_;
  std::deque<cv::Matx33d> grounds_;  // how it moved, over the pictures that make a place known
  double births_ = cluttered_births; // new tracks a picture, smoothed: how cluttered the scene is
  bool is_full_ = false;
};

[[nodiscard]] cv::Rect2d box_of(const track& who);
[[nodiscard]] cv::Point2d middle_of(const cv::Rect2d& box);

} // namespace godwit::eyes
