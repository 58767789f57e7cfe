// Earlier pictures, each with the way of the ground from it to the newest one. Thread: one.
#pragma once

#include <deque>

#include <opencv2/core.hpp>

namespace godwit::eyes {

struct past_picture {
  cv::Mat picture;
  cv::Matx33d to_now = cv::Matx33d::eye();
  double age_s = 0;
};

using past_pictures = std::deque<past_picture>; // the newest at the back

// BEFORE_TO_NOW: how the ground moved since the last one. Who keeps them drops those that are too many or too old.
inline void add_newest(past_pictures& to, const cv::Mat& picture, double dt_s, const cv::Matx33d& before_to_now) {
  for (auto& each : to) {
    each.to_now = before_to_now * each.to_now;
    each.age_s += dt_s;
  }
  to.push_back({picture, cv::Matx33d::eye(), 0});
}

} // namespace godwit::eyes
