// Where the camera was of late, so that a picture finds the pose of its own time. Thread: one at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "io/eyes/messages.hpp"
#include "programs/godwit-eyes/ground/camera_pose.hpp"

namespace godwit::eyes {

class pose_history {
public:
  static constexpr std::size_t max_poses = 128; // at 10 a second, twelve seconds
  static constexpr std::int64_t max_age_ns = 2'000'000'000;

  // One that is not newer than the last is left out.
  void add(const io::eyes::pose& said);
  // The nearest to that time; none is nearer than max_age_ns: nothing. How old it may be is for the detector to judge.
  [[nodiscard]] std::optional<camera_pose> at(std::int64_t time_ns) const;

private:
  std::deque<camera_pose> poses_; // oldest first
};

} // namespace godwit::eyes
