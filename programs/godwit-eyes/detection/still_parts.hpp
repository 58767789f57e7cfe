// What stands still in the picture while the ground goes by: text and marks that a camera draws, landing gear, dirt.
//
// Whenever the ground has gone a few pixels, each pixel is compared with itself and with what the ground brings to it.
// One that stays although the ground brings something else gains, one that does not stay loses more. What a camera
// draws is exact to the pixel, also over seconds; a mover that the camera follows is not. Pixels are those of the
// reduced picture. Thread: one.
#pragma once

#include <opencv2/core.hpp>

namespace godwit::eyes {

class still_parts {
public:
  // Every picture whose motion is known. BEFORE_TO_NOW: how the ground moved since the last one.
  void step(const cv::Mat& now, double dt_s, const cv::Matx33d& before_to_now);
  // The next picture can not be compared with those before. What is known to stand still is kept.
  void lose() { reference_.release(); }
  // Takes it out of a mask; nothing changes where nothing stands still.
  void clear(cv::Mat& mask) const;

private:
  void compare(const cv::Mat& now);

  cv::Mat reference_;
  cv::Matx33d reference_to_now_ = cv::Matx33d::eye();
  double reference_age_s_ = 0;
  cv::Mat evidence_; // a byte a pixel
  cv::Mat still_;    // 255 where something stands still, and around it; empty: nothing does
};

} // namespace godwit::eyes
