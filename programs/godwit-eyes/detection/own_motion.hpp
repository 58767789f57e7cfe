// How the ground moved in the picture since the one before, told from many small features: a homography, because the
// ground is taken for a plane. What does not lie on it, and what moves, is left out by RANSAC.
//
// A known turn of the camera is the first guess of the search, so that fast pans are followed. Pixels are those of the
// pictures given. Source: FAST (Rosten and Drummond 2006), pyramidal Lucas-Kanade (Bouguet 2000), RANSAC; all OpenCV's.
// Thread: one.
#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "programs/godwit-eyes/detection/detector.hpp"

namespace godwit::eyes {

struct motion_found {
  unusable why = unusable::none; // few_features, no_homography
  cv::Matx33d before_to_now = cv::Matx33d::eye();
  int features = 0;
  int inliers = 0;
  double residual_px = 0; // median of the inliers
};

class own_motion {
public:
  // The first picture, or one after `forget`: no_homography.
  // One that fails leaves the picture before in place for the next, twice: a blow or a spoilt picture is passed over.
  [[nodiscard]] motion_found step(const cv::Mat& now, const std::optional<cv::Matx33d>& guess);
  void forget();
  [[nodiscard]] bool is_waiting() const { return failures_ > 0; }

private:
  std::vector<cv::Mat> pyramid_; // of the picture before
  cv::Mat before_;
  std::vector<cv::Point2f> corners_;      // of the picture before
  cv::Matx33d last_ = cv::Matx33d::eye(); // how the ground moved last: the guess where there is no better one
  int failures_ = 0;
};

// Where a point goes; W is taken as positive.
[[nodiscard]] cv::Point2d moved(const cv::Matx33d& by, const cv::Point2d& from);
// The largest way of a corner of a picture of this size.
[[nodiscard]] double corner_shift(const cv::Matx33d& by, const cv::Size& size);

} // namespace godwit::eyes
