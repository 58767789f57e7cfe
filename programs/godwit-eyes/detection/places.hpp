// Where each pixel of a picture lies in another one. Thread: pure.
//
// Along a row the way is straight between places some pixels apart, to a thousandth of a pixel: a division for each
// pixel, as warpPerspective has it, takes three times as long.
#pragma once

#include <algorithm>

#include <opencv2/core.hpp>

#include "programs/godwit-eyes/detection/own_motion.hpp"

namespace godwit::eyes {

inline constexpr int place_bits = 16; // of fixed point
inline constexpr int longest_run = 16;

// A run of pixels of one row. Where they lie: that of the first one and the step to the next, in fixed point.
struct placed_run {
  int y = 0;
  int begin = 0;
  int end = 0;
  cv::Point place;
  cv::Point step;
};

// The same pixels, placed by another way.
[[nodiscard]] inline placed_run placed(const placed_run& run, const cv::Matx33d& way) {
  constexpr double one = 1 << place_bits;
  constexpr double outside = 10000; // of any picture, and not beyond 32 bits
  const auto place_at = [&](int x) {
    const cv::Point2d at = moved(way, cv::Point2d(x, run.y));
    return cv::Point(static_cast<int>(std::clamp(at.x, -outside, outside) * one),
                     static_cast<int>(std::clamp(at.y, -outside, outside) * one));
  };
  const cv::Point from = place_at(run.begin);
  const cv::Point to = place_at(run.begin + longest_run);
  return {run.y, run.begin, run.end, from, {(to.x - from.x) / longest_run, (to.y - from.y) / longest_run}};
}

// USE is called with each run of a picture of this size, row by row; WAY leads to where they lie.
template <class Use>
void for_each_run(const cv::Size& size, const cv::Matx33d& way, Use use) {
  for (int y = 0; y < size.height; ++y)
    for (int begin = 0; begin < size.width; begin += longest_run)
      use(placed({y, begin, std::min(begin + longest_run, size.width), {}, {}}, way));
}

// Calls USE with each pixel of a run (x) that lies within a picture of this size, and with where (x, y).
template <class Use>
void for_each_nearest(const placed_run& run, const cv::Size& within, Use use) {
  constexpr int half = 1 << (place_bits - 1);
  int x = run.place.x + half;
  int y = run.place.y + half;
  for (int n = run.begin; n < run.end; ++n, x += run.step.x, y += run.step.y) {
    const int column = x >> place_bits;
    const int row = y >> place_bits;
    if (static_cast<unsigned>(column) < static_cast<unsigned>(within.width) &&
        static_cast<unsigned>(row) < static_cast<unsigned>(within.height))
      use(n, column, row);
  }
}

} // namespace godwit::eyes
