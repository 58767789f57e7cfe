// A camera: how it maps directions to pixels, where it is and where it points. Thread: pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace godwit::eyes {

// What is known of a camera before the flight: the pinhole model with two terms of radial distortion (Brown 1966), for
// pictures of one size. Lengths in pixels of such a picture. Thread: plain values.
struct camera_parameters {
  int width = 0;
  int height = 0;
  double focal_px = 0; // at zoom 1
  double centre_x_px = 0;
  double centre_y_px = 0;
  double k1 = 0;
  double k2 = 0;
};

// The camera of which only the horizontal field of view is known (degrees).
[[nodiscard]] camera_parameters camera_from_field_of_view(int width, int height, double horizontal_deg);

// What is wrong with them, as a sentence that names the place ("focal_px is 0 ..."); nothing: they can be used.
[[nodiscard]] std::optional<std::string> problem_of(const camera_parameters& camera);

// Where the camera was and where it looked at one moment, as far as it is known. The frames:
//
//   NED     north, east, down, at the camera
//   camera  x to the right of the picture, y to its lower edge, z into the picture
//
// Units: radians, metres, degrees for latitude and longitude. Thread: plain values.

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
