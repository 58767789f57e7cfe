#include "programs/godwit-eyes/detection/parallax.hpp"

#include <algorithm>
#include <cmath>

namespace godwit::eyes {

namespace {

constexpr double highest_m = 15;
constexpr double highest_share = 1.0 / 3;
constexpr double across_share = 0.35; // of the speed: how far off the direction
constexpr double least_across_px_s = 10;

} // namespace

bool is_like_parallax(const sight& from, const Eigen::Vector3d& camera_velocity, const Eigen::Vector2d& place,
                      const Eigen::Vector2d& velocity) {
  const Eigen::Matrix3d intrinsics = from.intrinsics();
  const double x = (place.x() - intrinsics(0, 2)) / from.focal_px();
  const double y = (place.y() - intrinsics(1, 2)) / from.focal_px();
  const Eigen::Vector3d v = from.attitude().transpose() * camera_velocity;
  const Eigen::Vector2d flow(x * v.z() - v.x(), y * v.z() - v.y());
  const double length = flow.norm();
  const double height = from.pose().height_m;
  const Eigen::Vector3d ray = from.attitude() * Eigen::Vector3d(x, y, 1);
  if (length < 1e-3 || height < 1 || ray.z() < 1e-3)
    return false;
  const double high = std::min(highest_m, highest_share * height);
  const double depth = height / ray.z(); // along the line of sight
  const double fastest = from.focal_px() * length / depth * high / (height - high);
  const double along = velocity.dot(flow) / length;
  const double across = std::abs(velocity.x() * flow.y() - velocity.y() * flow.x()) / length;
  return along > 0 && along < fastest && across < std::max(across_share * along, least_across_px_s);
}

} // namespace godwit::eyes
