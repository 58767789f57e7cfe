// Where the camera was and where it looked at one moment, as far as it is known. The frames:
//
//   NED     north, east, down, at the camera
//   camera  x to the right of the picture, y to its lower edge, z into the picture
//
// Units: radians, metres, degrees for latitude and longitude. Thread: plain values.
#pragma once

#include <cstdint>

namespace godwit::eyes {

// Turns what is said in camera axes into NED. Of length 1 (within 1e-3; else the pose is refused).
struct quaternion {
  double w = 1;
  double x = 0;
  double y = 0;
  double z = 0;
};

// In camera axes.
struct angular_rate {
  double x_rad_s = 0;
  double y_rad_s = 0;
  double z_rad_s = 0;
};

struct camera_pose {
  std::int64_t at_ns = 0; // monotonic, as in frame_view
  quaternion attitude;    // of the camera: body, mount and gimbal are in it
  angular_rate rate;
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_m = 0; // of the camera, above the ground below it
  double zoom = 1;     // focal length by that of the camera's parameters
  // Standard deviations; what is not known is said generously, never as 0.
  double attitude_sd_rad = 0.02;
  double position_sd_m = 2.0; // in north and in east, each
  double height_sd_m = 2.0;
};

} // namespace godwit::eyes
