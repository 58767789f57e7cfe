#include "programs/godwit-eyes/ground/sight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <GeographicLib/LocalCartesian.hpp>

namespace godwit::eyes {

namespace {

constexpr double rotation_tolerance = 1e-3;
constexpr double most_height_m = 20000;
constexpr double most_rate_rad_s = 20;
constexpr int undistortion_rounds = 8;

bool is_within(double value, double least, double most) { return value >= least && value <= most; } // no: NaN

double age_s(const camera_pose& pose, std::int64_t at_ns) { return static_cast<double>(at_ns - pose.at_ns) * 1e-9; }

double rate_of(const camera_pose& pose) { return std::hypot(pose.rate.x_rad_s, pose.rate.y_rad_s, pose.rate.z_rad_s); }

// By the turn since the pose was measured.
Eigen::Matrix3d attitude_at(const camera_pose& pose, std::int64_t at_ns) {
  const Eigen::Quaterniond measured(pose.attitude.w, pose.attitude.x, pose.attitude.y, pose.attitude.z);
  const Eigen::Vector3d turn =
      age_s(pose, at_ns) * Eigen::Vector3d(pose.rate.x_rad_s, pose.rate.y_rad_s, pose.rate.z_rad_s);
  const double angle = turn.norm();
  const Eigen::Quaterniond since =
      angle < 1e-12 ? Eigen::Quaterniond::Identity() : Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle));
  return (measured.normalized() * since).toRotationMatrix();
}

} // namespace

pose_flaw flaw_of(const camera_pose& pose, std::int64_t at_ns) {
  const auto& q = pose.attitude;
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  const bool is_right = is_within(length, 1 - rotation_tolerance, 1 + rotation_tolerance) &&
                        is_within(rate_of(pose), 0, most_rate_rad_s) && is_within(pose.latitude_deg, -90, 90) &&
                        is_within(pose.longitude_deg, -180, 180) && is_within(pose.height_m, 0, most_height_m) &&
                        is_within(pose.zoom, 0.1, 100) && is_within(pose.attitude_sd_rad, 0, 1) &&
                        is_within(pose.position_sd_m, 0, 1000) && is_within(pose.height_sd_m, 0, 1000);
  if (!is_right || std::abs(age_s(pose, at_ns)) > longest_pose_age_s)
    return pose_flaw::not_a_pose;
  return std::abs(age_s(pose, at_ns)) * rate_of(pose) > most_carried_rad ? pose_flaw::too_old : pose_flaw::none;
}

sight::sight(const camera_parameters& camera, const camera_pose& pose, std::int64_t at_ns, int width)
    : pose_(pose), attitude_(attitude_at(pose, at_ns)) {
  const double scale = static_cast<double>(width) / camera.width;
  focal_px_ = camera.focal_px * pose.zoom * scale;
  centre_x_px_ = (camera.centre_x_px + 0.5) * scale - 0.5;
  centre_y_px_ = (camera.centre_y_px + 0.5) * scale - 0.5;
  k1_ = camera.k1;
  k2_ = camera.k2;
}

Eigen::Vector3d sight::ray(double x_px, double y_px) const {
  const double seen_x = (x_px - centre_x_px_) / focal_px_;
  const double seen_y = (y_px - centre_y_px_) / focal_px_;
  double x = seen_x;
  double y = seen_y;
  for (int n = 0; n < undistortion_rounds && (k1_ != 0 || k2_ != 0); ++n) {
    const double r2 = x * x + y * y;
    const double factor = std::max(0.1, 1 + k1_ * r2 + k2_ * r2 * r2);
    x = seen_x / factor;
    y = seen_y / factor;
  }
  return attitude_ * Eigen::Vector3d(x, y, 1);
}

double sight::off_nadir_rad(double x_px, double y_px) const {
  const Eigen::Vector3d to = ray(x_px, y_px);
  return std::atan2(std::hypot(to.x(), to.y()), to.z());
}

Eigen::Matrix3d sight::intrinsics() const {
  Eigen::Matrix3d made;
  made << focal_px_, 0, centre_x_px_, 0, focal_px_, centre_y_px_, 0, 0, 1;
  return made;
}

Eigen::Vector3d way_between(const camera_pose& from, const camera_pose& to) {
  const GeographicLib::LocalCartesian frame(from.latitude_deg, from.longitude_deg);
  double east = 0;
  double north = 0;
  double up = 0;
  frame.Forward(to.latitude_deg, to.longitude_deg, 0, east, north, up);
  return {north, east, from.height_m - to.height_m};
}

// X' = R X + t and n X = d for all X on the plane give X' = (R + t n / d) X (Hartley and Zisserman, 13.1).
Eigen::Matrix3d ground_homography(const sight& from, const sight& to) {
  const Eigen::Matrix3d turn = to.attitude().transpose() * from.attitude();
  const Eigen::Vector3d shift = -to.attitude().transpose() * way_between(from.pose(), to.pose());
  const Eigen::RowVector3d down = from.attitude().row(2);
  const double height = std::max(1.0, from.pose().height_m);
  return to.intrinsics() * (turn + shift * down / height) * from.intrinsics().inverse();
}

namespace {

constexpr double pixel_deviation = 1.0;

} // namespace

std::optional<ground_place> ground_point(const sight& from, const pixel_box& box, double limit_rad) {
  // Pixel (0, 0) has its middle at half a pixel of the box's measure.
  const double x = box.x_px + box.width_px / 2 - 0.5;
  const double y = box.y_px + box.height_px / 2 - 0.5;
  if (!(from.off_nadir_rad(x, y) <= limit_rad))
    return std::nullopt;
  const camera_pose& pose = from.pose();
  const Eigen::Vector3d to = from.ray(x, y);
  const Eigen::Vector2d along = to.head<2>() / to.z();
  const Eigen::Vector2d place = pose.height_m * along;

  // d(place) for a small turn about north, east and down: the ray changes by turn x ray.
  Eigen::Matrix<double, 2, 3> by_turn;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d change = Eigen::Vector3d::Unit(axis).cross(to);
    by_turn.col(axis) = pose.height_m * (change.head<2>() - along * change.z()) / to.z();
  }
  const double turn_variance = std::pow(pose.attitude_sd_rad, 2) + std::pow(pixel_deviation / from.focal_px(), 2);
  const Eigen::Matrix2d covariance = turn_variance * by_turn * by_turn.transpose() +
                                     std::pow(pose.position_sd_m, 2) * Eigen::Matrix2d::Identity() +
                                     std::pow(pose.height_sd_m, 2) * along * along.transpose();

  ground_place found;
  double height = 0;
  const GeographicLib::LocalCartesian frame(pose.latitude_deg, pose.longitude_deg);
  frame.Reverse(place.y(), place.x(), 0, found.latitude_deg, found.longitude_deg, height);
  found.variance_north_m2 = covariance(0, 0);
  found.variance_east_m2 = covariance(1, 1);
  found.covariance_m2 = covariance(0, 1);
  const double distance = pose.height_m * to.norm() / to.z();
  found.size_m = std::max(box.width_px, box.height_px) * distance / from.focal_px();
  return found;
}

} // namespace godwit::eyes
