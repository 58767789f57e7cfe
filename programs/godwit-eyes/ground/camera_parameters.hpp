// What is known of a camera before the flight: the pinhole model with two terms of radial distortion (Brown 1966), for
// pictures of one size. Lengths in pixels of such a picture. Thread: plain values.
#pragma once

#include <optional>
#include <string>

namespace godwit::eyes {

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

} // namespace godwit::eyes
