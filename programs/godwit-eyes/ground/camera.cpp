#include "programs/godwit-eyes/ground/camera.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace godwit::eyes {

namespace {

struct range {
  const char* name;
  double value;
  double least;
  double most;
};

constexpr double max_side_px = 8192;

} // namespace

camera_parameters camera_from_field_of_view(int width, int height, double horizontal_deg) {
  camera_parameters made;
  made.width = width;
  made.height = height;
  made.focal_px = width / (2 * std::tan(horizontal_deg * std::numbers::pi / 360));
  made.centre_x_px = (width - 1) / 2.0;
  made.centre_y_px = (height - 1) / 2.0;
  return made;
}

std::optional<std::string> problem_of(const camera_parameters& camera) {
  const double width = camera.width;
  const double height = camera.height;
  // Focal lengths from a field of view of 150 degrees to one of 2; a centre in the middle half of the picture.
  const std::array<range, 7> ranges{{{"width", width, 64, max_side_px},
                                     {"height", height, 64, max_side_px},
                                     {"focal_px", camera.focal_px, width * 0.13, width * 29},
                                     {"centre_x_px", camera.centre_x_px, width * 0.25, width * 0.75},
                                     {"centre_y_px", camera.centre_y_px, height * 0.25, height * 0.75},
                                     {"k1", camera.k1, -1, 1},
                                     {"k2", camera.k2, -1, 1}}};
  for (const auto& each : ranges)
    if (!(each.value >= each.least && each.value <= each.most)) // also when it is not a number
      return std::string(each.name) + " is " + std::to_string(each.value) + ", and must be from " +
             std::to_string(each.least) + " to " + std::to_string(each.most);
  return std::nullopt;
}

} // namespace godwit::eyes
