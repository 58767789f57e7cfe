// The yardstick: what one writes first. Homography from the picture before, difference, threshold, components; all at
// half size, no memory but the last picture. It is not improved: the detector's figures are measured against it.
// Thread: one.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "programs/godwit-eyes/detection/detector.hpp"

namespace godwit::eyes::test {

// As one writes it first, with constants that such programs have.
struct naive_settings {
  int threshold = 22; // of the difference, after a blur
  int closing_px = 9; // diameter, at half size
};

// Within 0.01 of the best F1 at an overlap of 0.5 on sixteen tuning seeds of tier A, of thresholds 10 to 24 and
// closings of 9 to 27 pixels (docs/decisions/perception.md).
inline constexpr naive_settings tuned_naive{12, 21};

class naive_detector {
public:
  explicit naive_detector(const naive_settings& settings = {}) : settings_(settings) {}

  // Boxes in pixels of the picture.
  [[nodiscard]] std::vector<pixel_box> look(const frame_view& frame);

private:
  naive_settings settings_;
  cv::Mat before_;
};

} // namespace godwit::eyes::test
