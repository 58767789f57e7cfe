// What the flight would say of the camera of a generated picture: its true pose on the Earth, with errors where asked
// for.
#pragma once

#include "programs/godwit-eyes/ground/camera.hpp"
#include "programs/godwit-sim/camera/view.hpp"

namespace godwit::eyes::test {

inline constexpr double origin_latitude_deg = 47.3;
inline constexpr double origin_longitude_deg = 8.5;

// ATTITUDE_ERROR: a rotation in camera axes, in radians.
[[nodiscard]] camera_pose pose_of(const sim::camera::camera_view& view, std::int64_t at_ns,
                                  const sim::camera::vector3& attitude_error = {});
[[nodiscard]] camera_parameters parameters_of(const sim::camera::lens& glass);

} // namespace godwit::eyes::test
