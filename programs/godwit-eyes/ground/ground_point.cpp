#include "programs/godwit-eyes/ground/ground_point.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <GeographicLib/LocalCartesian.hpp>

namespace godwit::eyes {

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
