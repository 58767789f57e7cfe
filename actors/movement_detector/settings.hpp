// What can be set about the camera. Pure. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace godwit::movement_detector {

struct settings {
  std::string uri;
  // For pictures of this size; the pinhole model.
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  double focal_px = 0;
  double k1 = 0;
  double k2 = 0;
  // How the camera is mounted on the vehicle, in this order: turned right from ahead, up from level, rolled to the
  // right.
  double mount_yaw_deg = 0;
  double mount_pitch_deg = -90;
  double mount_roll_deg = 0;
  // It hangs on a gimbal that tells how it lies (MAVLink) and looks where that points; the mount is not used then.
  bool is_on_gimbal = false;
  double attitude_sd_deg = 2; // of the vehicle and the mount together
  double min_height_m = 8;    // below: heights of what stands there move like movers
  double max_off_nadir_deg = 70;
  std::string class_group = "moving"; // under which what moves goes into the map
  double min_confidence = 0.5;
  std::string record_folder; // empty: nothing is recorded
  std::int64_t record_max_mb = 0;
  std::string model; // a file (io/eyes/model_files.hpp); empty: nobody is asked what things look like
};

// What can not be, as a sentence that begins with the name of the setting; nothing: it can be used. The address of the
// camera is not looked at.
[[nodiscard]] std::optional<std::string> objection_to(const settings& configured);

} // namespace godwit::movement_detector
