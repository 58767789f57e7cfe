#include "programs/godwit-eyes/detection/track_filter.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "programs/godwit-eyes/detection/own_motion.hpp"

namespace godwit::eyes {

namespace {

constexpr double first_speed_deviation = 120; // pixels a second
constexpr double acceleration = 120;          // standard deviation, pixels a second squared, over one step of 1/30 s
constexpr double step_s = 1.0 / 30;

} // namespace

track_filter::track_filter(const cv::Point2d& place, double place_deviation_px)
    : state_(place.x, place.y, 0, 0), covariance_(Eigen::Matrix4d::Zero()) {
  const double variance = place_deviation_px * place_deviation_px;
  const double speed = first_speed_deviation * first_speed_deviation;
  covariance_.diagonal() << variance, variance, speed, speed;
}

void track_filter::predict(double dt_s, const cv::Matx33d& ground) {
  const cv::Point2d at = place();
  const Eigen::Matrix2d slope = slope_of(ground, at);
  const cv::Point2d carried = moved(ground, at);
  Eigen::Matrix4d carry = Eigen::Matrix4d::Zero();
  carry.topLeftCorner<2, 2>() = slope;
  carry.bottomRightCorner<2, 2>() = slope;
  Eigen::Vector2d velocity = slope * state_.tail<2>();
  state_ << carried.x, carried.y, velocity;
  covariance_ = carry * covariance_ * carry.transpose();

  Eigen::Matrix4d go = Eigen::Matrix4d::Identity();
  go(0, 2) = go(1, 3) = dt_s;
  state_ = go * state_;
  covariance_ = go * covariance_ * go.transpose();
  const double density = acceleration * acceleration * step_s;
  const double t2 = dt_s * dt_s;
  for (Eigen::Index n = 0; n < 2; ++n) {
    covariance_(n, n) += density * t2 * dt_s / 3;
    covariance_(n, n + 2) += density * t2 / 2;
    covariance_(n + 2, n) += density * t2 / 2;
    covariance_(n + 2, n + 2) += density * dt_s;
  }
}

void track_filter::update(const cv::Point2d& place, double place_deviation_px) {
  const double variance = place_deviation_px * place_deviation_px;
  const Eigen::Matrix2d expected = covariance_.topLeftCorner<2, 2>() + variance * Eigen::Matrix2d::Identity();
  const Eigen::Matrix<double, 4, 2> gain = covariance_.leftCols<2>() * expected.inverse();
  state_ += gain * (Eigen::Vector2d(place.x, place.y) - state_.head<2>());
  // Joseph's form stays symmetric and positive.
  Eigen::Matrix4d rest = Eigen::Matrix4d::Identity();
  rest.leftCols<2>() -= gain;
  covariance_ = rest * covariance_ * rest.transpose() + variance * gain * gain.transpose();
}

double track_filter::speed_deviation() const { return std::sqrt(std::max(covariance_(2, 2), covariance_(3, 3))); }

double track_filter::distance_squared(const cv::Point2d& place, double place_deviation_px) const {
  const Eigen::Matrix2d expected =
      covariance_.topLeftCorner<2, 2>() + place_deviation_px * place_deviation_px * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d off(place.x - state_[0], place.y - state_[1]);
  return off.dot(expected.inverse() * off);
}

Eigen::Matrix2d slope_of(const cv::Matx33d& ground, const cv::Point2d& at) {
  const double w = ground(2, 0) * at.x + ground(2, 1) * at.y + ground(2, 2);
  const cv::Point2d to = moved(ground, at);
  Eigen::Matrix2d slope;
  slope << (ground(0, 0) - to.x * ground(2, 0)) / w, (ground(0, 1) - to.x * ground(2, 1)) / w,
      (ground(1, 0) - to.y * ground(2, 0)) / w, (ground(1, 1) - to.y * ground(2, 1)) / w;
  return slope;
}

} // namespace godwit::eyes
