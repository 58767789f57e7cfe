// What the detector has seen in a picture, drawn into it.
//
//   green    said: the track's number, its speed over the ground in pixels a second, and the way that it came
//   yellow   said, and not seen in this picture: where it should be
//   magenta  not said: it goes as something high and still would (a tree, a mast)
//   white    not said: new, too small, or lost
//   blue     how the ground went since the picture before
//
// Above it three lines: time and reason, how sure the ground's motion is, and the counts. Thread: one.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include <opencv2/core.hpp>

#include "programs/godwit-eyes/detection/detector.hpp"

namespace godwit::eyes {

// Where each track that is said came from, carried along with the ground.
class trails {
public:
  static constexpr std::size_t max_places = 60;  // of each; the oldest goes
  static constexpr std::size_t max_tracks = 256; // the one with the lowest number goes

  // Each picture, in its order.
  void add(const verdict& seen);
  [[nodiscard]] const std::map<std::uint32_t, std::deque<cv::Point2d>>& all() const { return all_; }

private:
  std::map<std::uint32_t, std::deque<cv::Point2d>> all_;
};

struct picture_label {
  std::uint64_t number = 0; // from 1
  double at_s = 0;
};

// Three bytes a pixel, red first.
[[nodiscard]] cv::Mat drawn(const frame_view& frame, const verdict& seen, const trails& ways,
                            const picture_label& label);

} // namespace godwit::eyes
