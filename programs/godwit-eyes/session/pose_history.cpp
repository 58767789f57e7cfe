#include "programs/godwit-eyes/session/pose_history.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>

namespace godwit::eyes {

void pose_history::add(const io::eyes::pose& said) {
  if (!poses_.empty() && said.at_ns <= poses_.back().at_ns)
    return;
  camera_pose result;
  result.at_ns = said.at_ns;
  result.attitude = {said.w, said.x, said.y, said.z};
  result.rate = {said.rate_x_rad_s, said.rate_y_rad_s, said.rate_z_rad_s};
  result.latitude_deg = said.latitude_deg;
  result.longitude_deg = said.longitude_deg;
  result.height_m = said.height_m;
  result.attitude_sd_rad = said.attitude_sd_rad;
  result.position_sd_m = said.position_sd_m;
  result.height_sd_m = said.height_sd_m;
  poses_.push_back(result);
  if (poses_.size() > max_poses)
    poses_.pop_front();
}

std::optional<camera_pose> pose_history::at(std::int64_t time_ns) const {
  const auto later = std::ranges::lower_bound(poses_, time_ns, {}, &camera_pose::at_ns);
  const camera_pose* nearest = later == poses_.end() ? nullptr : &*later;
  if (later != poses_.begin()) {
    const auto& earlier = *std::prev(later);
    if (nearest == nullptr || time_ns - earlier.at_ns <= nearest->at_ns - time_ns)
      nearest = &earlier;
  }
  if (nearest == nullptr || std::abs(time_ns - nearest->at_ns) > max_age_ns)
    return std::nullopt;
  return *nearest;
}

} // namespace godwit::eyes
