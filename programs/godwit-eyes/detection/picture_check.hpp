// Whether a picture can be used at all, and its reduction to the size that the detector works at.
//
// Errors: a reason of `unusable`. Thread: one.
#pragma once

#include <opencv2/core.hpp>

#include "programs/godwit-eyes/detection/detector.hpp"

namespace godwit::eyes {

// bad_frame, or none.
[[nodiscard]] unusable check_frame(const frame_view& frame);

// How many pixels of the picture, in each direction, become one.
[[nodiscard]] int reduction_for(int width, int working_width);

// A mean of each block; rows and columns that do not fill a block at the right and lower edge are left out.
[[nodiscard]] cv::Mat reduced(const frame_view& frame, int reduction);

struct picture_state {
  unusable why = unusable::none; // blank, dark or blurred
  double brightness = 0;         // mean, 0..255
  double contrast = 0;           // standard deviation
  double sharpness = 0;          // the steepest edges over two pixels, by those over twelve
};

[[nodiscard]] picture_state judge(const cv::Mat& picture);

} // namespace godwit::eyes
