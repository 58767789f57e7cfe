#include "tests/support/eyes/pose_of_view.hpp"

#include <GeographicLib/LocalCartesian.hpp>

namespace godwit::eyes::test {

camera_pose pose_of(const sim::camera::camera_view& view, std::int64_t at_ns,
                    const sim::camera::vector3& attitude_error) {
  camera_pose pose;
  pose.at_ns = at_ns;
  const auto q = sim::camera::quaternion_of(sim::camera::turned(view.attitude, attitude_error));
  pose.attitude = {q[0], q[1], q[2], q[3]};
  pose.rate = {view.rate.x, view.rate.y, view.rate.z};
  const GeographicLib::LocalCartesian frame(origin_latitude_deg, origin_longitude_deg);
  double up = 0;
  frame.Reverse(view.position.y, view.position.x, 0, pose.latitude_deg, pose.longitude_deg, up);
  pose.height_m = -view.position.z;
  pose.zoom = view.zoom;
  return pose;
}

camera_parameters parameters_of(const sim::camera::lens& glass) {
  camera_parameters made;
  made.width = glass.width;
  made.height = glass.height;
  made.focal_px = glass.focal_px;
  made.centre_x_px = (glass.width - 1) / 2.0;
  made.centre_y_px = (glass.height - 1) / 2.0;
  return made;
}

} // namespace godwit::eyes::test
