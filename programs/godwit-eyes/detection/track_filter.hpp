// Where a thing is and how it moves against the ground, from places that were measured: a Kalman filter of constant
// velocity.
//
// State: x, y, and their change a second, in pixels of the present picture. When the ground moves in the picture, the
// state is carried along by the ground's homography. Thread: plain values. Source: Bar-Shalom, Li, Kirubarajan (2001),
// white noise acceleration.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace godwit::eyes {

class track_filter {
public:
  track_filter(const cv::Point2d& place, double place_deviation_px);

  // By DT_S, with the ground's motion in this time.
  void predict(double dt_s, const cv::Matx33d& ground);
  void update(const cv::Point2d& place, double place_deviation_px);

  [[nodiscard]] cv::Point2d place() const { return {state_[0], state_[1]}; }
  [[nodiscard]] cv::Point2d velocity() const { return {state_[2], state_[3]}; } // pixels a second
  [[nodiscard]] double speed_deviation() const;                                 // of each of the two, the larger one
  // The squared distance in standard deviations of a place from where it is expected.
  [[nodiscard]] double distance_squared(const cv::Point2d& place, double place_deviation_px) const;
  [[nodiscard]] const Eigen::Matrix4d& covariance() const { return covariance_; }

private:
  Eigen::Vector4d state_;
  Eigen::Matrix4d covariance_;
};

// How the neighbourhood of a place is turned and stretched.
[[nodiscard]] Eigen::Matrix2d slope_of(const cv::Matx33d& ground, const cv::Point2d& at);

} // namespace godwit::eyes
