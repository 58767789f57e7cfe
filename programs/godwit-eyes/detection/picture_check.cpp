#include "programs/godwit-eyes/detection/picture_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <opencv2/imgproc.hpp>

namespace godwit::eyes {

namespace {

constexpr int least_side = 64;
constexpr int most_side = 8192;
constexpr std::size_t most_stride = 65536;
constexpr double blank_contrast = 1.5;
constexpr double dark_brightness = 10;
constexpr double dark_contrast = 6; // a dark picture with lamps in it has more, and is dark all the same
constexpr double least_sharpness =
    0.25; // sharp tuning scenes have 0.31 and more, at a blur of three pixels 0.24 and less

// The step over REACH pixels that only one in a hundred is larger than; along rows, each other of them.
double large_step(const cv::Mat& picture, int reach) {
  std::array<int, 256> counts{};
  int all = 0;
  for (int y = 0; y < picture.rows; y += 2) {
    const std::uint8_t* const row = picture.ptr<std::uint8_t>(y);
    for (int x = 0; x + reach < picture.cols; ++x)
      ++counts[static_cast<std::size_t>(std::abs(row[x] - row[x + reach]))];
    all += picture.cols - reach;
  }
  int left = all / 100;
  std::size_t step = counts.size() - 1;
  while (step > 0 && left >= counts[step])
    left -= counts[step--];
  return static_cast<double>(step);
}

// Edges are steep where the picture is sharp; the steepest ones stand out of any noise.
double sharpness_of(const cv::Mat& picture) {
  cv::Mat smooth;
  cv::GaussianBlur(picture, smooth, cv::Size(3, 3), 0.8);
  return large_step(smooth, 2) / std::max(1.0, large_step(smooth, 12));
}

} // namespace

unusable check_frame(const frame_view& frame) {
  const bool has_size =
      frame.width >= least_side && frame.height >= least_side && frame.width <= most_side && frame.height <= most_side;
  const bool is_right = frame.grey != nullptr && has_size && frame.stride >= static_cast<std::size_t>(frame.width) &&
                        frame.stride <= most_stride;
  return is_right ? unusable::none : unusable::bad_frame;
}

int reduction_for(int width, int working_width) { return (width + working_width - 1) / working_width; }

cv::Mat reduced(const frame_view& frame, int reduction) {
  const int width = frame.width / reduction;
  const int height = frame.height / reduction;
  // OpenCV has no view of constant pixels; these are only read.
  const cv::Mat full(height * reduction, width * reduction, CV_8UC1, const_cast<std::uint8_t*>(frame.grey),
                     frame.stride);
  cv::Mat result;
  if (reduction == 1)
    full.copyTo(result);
  else
    cv::resize(full, result, cv::Size(width, height), 0, 0, cv::INTER_AREA);
  return result;
}

picture_state judge(const cv::Mat& picture) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(picture, mean, deviation);
  picture_state state{unusable::none, mean[0], deviation[0], sharpness_of(picture)};
  if (state.brightness < dark_brightness && state.contrast < dark_contrast)
    state.why = state.contrast < blank_contrast / 3 ? unusable::blank : unusable::dark;
  else if (state.contrast < blank_contrast)
    state.why = unusable::blank;
  else if (state.sharpness < least_sharpness)
    state.why = unusable::blurred;
  return state;
}

} // namespace godwit::eyes
