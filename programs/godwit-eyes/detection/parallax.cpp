#include "programs/godwit-eyes/detection/parallax.hpp"

#include <algorithm>
#include <cmath>

namespace godwit::eyes {

namespace {

constexpr double highest_m = 15;
constexpr double highest_share = 1.0 / 3;
constexpr double across_share = 0.35; // of the speed: how far off the direction
constexpr double least_across_px_s = 10;
constexpr double least_fastest_px_s = 0.01; // a camera that stands

} // namespace

std::optional<still_motion> still_motion_at(const sight& from, const Eigen::Vector3d& camera_velocity,
                                            const Eigen::Vector2d& place) {
  const Eigen::Matrix3d intrinsics = from.intrinsics();
  const double x = (place.x() - intrinsics(0, 2)) / from.focal_px();
  const double y = (place.y() - intrinsics(1, 2)) / from.focal_px();
  const Eigen::Vector3d v = from.attitude().transpose() * camera_velocity;
  const double height = from.pose().height_m;
  const Eigen::Vector3d ray = from.attitude() * Eigen::Vector3d(x, y, 1);
  if (height < 1 || ray.z() < 1e-3)
    return std::nullopt;
  const double high = std::min(highest_m, highest_share * height);
  const double depth = height / ray.z(); // along the line of sight
  const Eigen::Vector2d flow(x * v.z() - v.x(), y * v.z() - v.y());
  return still_motion{from.focal_px() / depth * high / (height - high) * flow, from.focal_px() / depth};
}

bool is_like_parallax(const sight& from, const Eigen::Vector3d& camera_velocity, const Eigen::Vector2d& place,
                      const Eigen::Vector2d& velocity) {
  const auto still = still_motion_at(from, camera_velocity, place);
  if (!still)
    return false;
  const Eigen::Vector2d& flow = still->fastest_px_s;
  const double fastest = flow.norm();
  if (fastest < least_fastest_px_s)
    return false;
  const double along = velocity.dot(flow) / fastest;
  const double across = std::abs(velocity.x() * flow.y() - velocity.y() * flow.x()) / fastest;
  return along > 0 && along < fastest && across < std::max(across_share * along, least_across_px_s);
}

} // namespace godwit::eyes
