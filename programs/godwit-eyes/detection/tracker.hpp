// Which blobs belong to one thing over time, and which of these things really move over the ground.
//
// Where the background is calm its blobs count, elsewhere those of a difference of recent pictures; what slows down is
// followed on by the other ones (the second association of ByteTrack, Zhang et al. 2022). Where tracks can be proved to
// have moved, those of the background count everywhere. A blob goes to the track that
// expects it, nearest first; blobs that lie in one track's box are parts of one thing. A track is confirmed when it was
// seen for long enough, has gone farther than its place is unsure, and has gone there straight rather than to and fro;
// more is demanded where many tracks begin or the background is cluttered, and everywhere in a scene that is not yet
// known. All of that is counted from where it was last cut off: at the border of what is known a box shows where the
// border is. What a classifier has recognised needs less, and what it should have recognised is not confirmed. Where
// there are more things than tracks, the weakest track is dropped. Pixels are those of the reduced picture. Thread:
// one.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "programs/godwit-eyes/detection/appearance.hpp"
#include "programs/godwit-eyes/detection/blobs.hpp"
#include "programs/godwit-eyes/detection/clutter.hpp"
#include "programs/godwit-eyes/detection/track_filter.hpp"

namespace godwit::eyes {

struct track {
  struct place { // where it was seen
    int age = 0; // of the track
    cv::Rect2d box;
  };
  std::uint32_t number = 0;
  track_filter filter;
  cv::Size2d size;                    // smoothed
  cv::Point2d born;                   // its first place, carried along with the ground
  int age = 0;                        // pictures since then
  int seen = 0;                       // of these, with a blob
  int missed = 0;                     // since it was last seen
  double way_px = 0;                  // added up against the ground, from picture to picture
  std::deque<place> places{};         // the last ones, each in the pixels of its picture
  int along_parallax = 0;             // pictures in which it went as something high and still would go
  int by_background = 0;              // of the pictures in which it was seen, those with a blob of the background
  double age_s = 0;                   // as `age`
  std::optional<cv::Rect2d> extent{}; // about its place; none: its size is all of it
  appearance looks{};
  bool is_confirmed = false;
  bool is_double = false; // most of it lies in a larger confirmed track: both follow one thing
};

struct tracker_settings {
  int frames_to_confirm = 5;
  std::size_t max_tracks = 64;
};

// Of one picture.
struct sightings {
  std::span<const blob> background;
  std::span<const blob> difference;      // may be left out where the background is calm
  std::span<const blob> slow_difference; // likewise
};

class tracker {
public:
  explicit tracker(const tracker_settings& settings) : settings_(settings) {}

  // Whether a track that has shown all that is demanded has really moved.
  using prover = std::function<bool(const track& who)>;
  // Every picture, also one without blobs. CLUTTER: that of the background, with this picture. GROUND: how it moved
  // since the last one. PROVES is asked where the scene is cluttered, and less is demanded there for it; none: nothing
  // can be proved.
  void step(const sightings& seen, const clutter_map& clutter, double dt_s, const cv::Matx33d& ground,
            const cv::Size& picture, const prover& proves = {});
  // Whether a confirmed track may need the differences to be followed on.
  [[nodiscard]] bool needs_differences() const;
  // Where what is confirmed can be in the next picture.
  [[nodiscard]] std::vector<cv::Rect2d> confirmed_boxes(const cv::Matx33d& ground) const;
  [[nodiscard]] std::vector<track>& tracks() { return tracks_; }
  [[nodiscard]] const std::vector<track>& tracks() const { return tracks_; }
  void forget() {
    tracks_.clear();
    grounds_.clear();
    births_.clear();
    known_s_ = 0;
  }

private:
  struct birth { // where a track began
    std::uint32_t track = 0;
    cv::Point2d place;
    double age_s = 0;
  };
  struct ground_step {
    cv::Matx33d before_to_now;
    double dt_s = 0;
  };
  void carry(double dt_s, const cv::Matx33d& ground);
  using admits = std::function<bool(const track& who, const blob& seen)>;
  void assign(std::span<const blob> blobs, const admits& may_take, std::vector<bool>& is_taken);
  void confirm(const clutter_map& clutter, const prover& proves);
  void find_extents(const sightings& seen);
  void drop_lost();
  void find_doubles();
  void begin(std::span<const blob> blobs, const std::vector<bool>& is_taken);
  [[nodiscard]] bool drop_weakest();
  void see(track& who, const blob& seen);
  [[nodiscard]] bool is_whole(const cv::Rect2d& box) const;
  [[nodiscard]] double births_a_s(const std::function<bool(const birth&)>& counts) const;
  [[nodiscard]] double clutter_around(const track& who, const clutter_map& clutter) const; // 0 to 1

  tracker_settings settings_;
  std::vector<track> tracks_;
  std::uint32_t last_number_ = 0;
  cv::Size picture_;
  std::deque<ground_step> grounds_; // how it moved, over the time that makes a place known
  std::deque<birth> births_;
  double known_s_ = 0; // for which the scene is known
};

[[nodiscard]] cv::Rect2d box_of(const track& who);    // by which it is followed
[[nodiscard]] cv::Rect2d extent_of(const track& who); // all of it

} // namespace godwit::eyes
