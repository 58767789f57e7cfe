// From a mask to boxes around what may be one thing each. Thread: pure.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace godwit::eyes {

struct blob {
  cv::Rect2d box; // in pixels of the mask; without the shadow
  int pixels = 0; // of the mask, before its holes were closed
  int sure = 0;   // of these, the ones that surely differ
  int lit = 0;    // of these, the ones that are not as dark as the ground in a shadow
};

struct blobs_found {
  std::vector<blob> blobs; // at most `most_blobs`, the largest
  double changed_share = 0;
};

inline constexpr std::size_t most_blobs = 200;

// MASK as background_model gives it.
[[nodiscard]] blobs_found find_blobs(const cv::Mat& mask);

} // namespace godwit::eyes
