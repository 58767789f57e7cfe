// Whether a thing that is followed has really gone: it looks in this picture as it looked in an earlier one, at the
// place to which it was followed, and at none where something still could have come to lie.
//
// Blobs of leaves, edges and lights that come and go can be joined to a straight way by chance; their look does not
// come along. What stands high goes over the ground in the picture when the camera passes it, along one line, and sways
// a little: where that explains the way, or the look is found there as well, nothing is proved. Pixels are those of the
// reduced picture. Memory: the last `most_pictures` pictures. Thread: one.
#pragma once

#include <opencv2/core.hpp>

#include "programs/godwit-eyes/detection/change.hpp"
#include "programs/godwit-eyes/detection/tracker.hpp"

namespace godwit::eyes {

// How something still can move over the ground in the picture.
struct still_reach {
  cv::Point2d fastest_px_s; // the highest that is thought of, by parallax; lower things are slower, in this direction
  double sway_px = 0;       // from where it was at first
};

class motion_proof {
public:
  static constexpr std::size_t most_pictures = 24; // what goes slowly needs 0.8 s to get out of its own sway

  // Each picture that is compared, in order; BEFORE_TO_NOW: how the ground moved since the last one.
  void add(const cv::Mat& picture, double dt_s, const cv::Matx33d& before_to_now);
  void forget() { pictures_.clear(); }
  // WHO was seen in the newest picture.
  [[nodiscard]] bool has_moved(const track& who, const still_reach& still) const;

private:
  past_pictures pictures_;
};

} // namespace godwit::eyes
