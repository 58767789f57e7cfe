#include "actors/movement_detector/settings.hpp"

#include <array>

namespace godwit::movement_detector {
namespace {

struct range {
  const char* name;
  double value;
  double least;
  double most;
};

// From a field of view of 150 degrees to one of 2.
constexpr double shortest_focal = 0.13;
constexpr double longest_focal = 29;

} // namespace

std::optional<std::string> objection_to(const settings& configured) {
  const double width = configured.width_px;
  const std::array<range, 4> ranges{{{"width_px", width, 64, 8192},
                                     {"height_px", static_cast<double>(configured.height_px), 64, 8192},
                                     {"focal_px", configured.focal_px, width * shortest_focal, width * longest_focal},
                                     {"attitude_sd_deg", configured.attitude_sd_deg, 0.1, 20}}};
  for (const auto& each : ranges)
    if (!(each.value >= each.least && each.value <= each.most)) // also when it is not a number
      return std::string(each.name) + " is " + std::to_string(each.value) + "; with a camera it is from " +
             std::to_string(each.least) + " to " + std::to_string(each.most);
  const settings usual;
  if (configured.is_on_gimbal &&
      (configured.mount_yaw_deg != usual.mount_yaw_deg || configured.mount_pitch_deg != usual.mount_pitch_deg ||
       configured.mount_roll_deg != usual.mount_roll_deg))
    return "mount_yaw_deg, mount_pitch_deg and mount_roll_deg are of a camera that is fixed: leave them out with "
           "on_gimbal";
  if (configured.class_group.empty() || configured.class_group.size() > 64)
    return "class_group is a word of 1 to 64 characters";
  if (!configured.record_folder.empty() && configured.record_max_mb <= 0)
    return "record_max_mb is missing: recordings need a bound";
  return std::nullopt;
}

} // namespace godwit::movement_detector
