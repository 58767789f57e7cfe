// How the camera sees the ground at one moment: the pose carried to the picture's time, with the camera's parameters
// scaled to the picture's size. The ground is a plane, level, HEIGHT below the camera.
//
// Pixels: (0, 0) is the middle of the upper left one. Metres north, east and down from the camera. Errors are values.
// Thread: plain values.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "programs/godwit-eyes/detection/detector.hpp"
#include "programs/godwit-eyes/ground/camera.hpp"

namespace godwit::eyes {

enum class pose_flaw {
  none,
  not_a_pose, // not a number, no rotation, no place on the Earth, or from another time
  too_old     // for how fast the camera turns
};

inline constexpr double longest_pose_age_s = 1.0;
// A turn that is carried over a longer angle is not known well enough: 1 ms at 100 degrees a second are 1.7 pixels.
inline constexpr double most_carried_rad = 0.02;

[[nodiscard]] pose_flaw flaw_of(const camera_pose& pose, std::int64_t at_ns);

class sight {
public:
  // `flaw_of` is none, and the camera has no problem. WIDTH: of the picture.
  sight(const camera_parameters& camera, const camera_pose& pose, std::int64_t at_ns, int width);

  // North, east, down; not of length 1.
  [[nodiscard]] Eigen::Vector3d ray(double x_px, double y_px) const;
  [[nodiscard]] double off_nadir_rad(double x_px, double y_px) const;
  [[nodiscard]] const camera_pose& pose() const { return pose_; }
  [[nodiscard]] double focal_px() const { return focal_px_; }
  // Without distortion.
  [[nodiscard]] Eigen::Matrix3d intrinsics() const;
  [[nodiscard]] const Eigen::Matrix3d& attitude() const { return attitude_; } // from camera axes to NED

private:
  camera_pose pose_;
  Eigen::Matrix3d attitude_;
  double focal_px_;
  double centre_x_px_;
  double centre_y_px_;
  double k1_;
  double k2_;
};

// From where one camera was to where the other was; metres north, east, down.
[[nodiscard]] Eigen::Vector3d way_between(const camera_pose& from, const camera_pose& to);

// How the ground moves in the picture from one sight to the other, in pixels of the picture.
[[nodiscard]] Eigen::Matrix3d ground_homography(const sight& from, const sight& to);

// Where on the Earth a pixel looks, and how sure that is.
//
// The ground is taken for level; a hill as high as a tenth of the camera's height moves the point by a tenth of its
// distance. The covariance holds what the pose says of itself: attitude (the same in all three axes), position, height,
// and one pixel. Error of the distance at an angle T off the nadir from an attitude error D: height * D / cos^2(T).
// Thread: pure.

// Of the middle of BOX; nothing: it looks more than LIMIT off the nadir.
[[nodiscard]] std::optional<ground_place> ground_point(const sight& from, const pixel_box& box, double limit_rad);

} // namespace godwit::eyes
