// From a mask to boxes around what may be one thing each. Thread: pure.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace godwit::eyes {

// What a blob differs from.
enum class blob_source {
  background, // what was there over the last seconds: finds also what is slow, and errs where the ground is no plane
  difference, // two pictures of the last tenths of a second
  slow_difference, // two pictures of some tenths of a second: finds what goes slowly, and more of what stands high
};

struct blob {
  cv::Rect2d box; // in pixels of the mask; without the shadow
  int pixels = 0; // of the mask, before its holes were closed
  int sure = 0;   // of these, the ones that surely differ
  int lit = 0;    // of these, the ones that are not as dark as the ground in a shadow
  blob_source from = blob_source::background;
};

struct blobs_found {
  std::vector<blob> blobs; // at most `most_blobs`, the largest
  double changed_share = 0;
};

inline constexpr std::size_t most_blobs = 200;

[[nodiscard]] inline cv::Point2d middle_of(const cv::Rect2d& box) {
  return {box.x + box.width / 2, box.y + box.height / 2};
}

// MASK as background_model gives it; of a difference it has mostly the edges of a thing.
[[nodiscard]] blobs_found find_blobs(const cv::Mat& mask, blob_source from = blob_source::background);

} // namespace godwit::eyes
