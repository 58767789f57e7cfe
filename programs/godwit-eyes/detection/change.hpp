// What moves against the ground: where the new picture differs from two earlier ones, laid over it as the ground moved.
//
// Both must differ: where something only was, one of them shows the ground. Each pixel may come from the one beside it,
// because the ground is no plane and is never laid quite right. Earlier pictures of a tenth of a second show what goes
// quickly, and little of what stands high; those of some tenths also what goes slowly, and more of all the rest.
//
// Source: three-frame difference (Collins et al. 2000, VSAM), with two pictures before instead of one on each side, so
// that nothing comes late. Memory: the pictures of `longest_s`, at most `most_pictures`. Thread: one.
#pragma once

#include <deque>

#include <opencv2/core.hpp>

namespace godwit::eyes {

// Earlier pictures, each with the way of the ground from it to the newest one. Thread: one.
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

class recent_change {
public:
  static constexpr double quick_s = 0.1; // back to the first of the two pictures; the other one is as long before it
  static constexpr double slow_s = 0.3;
  static constexpr double longest_s = 2 * slow_s + 0.15;
  static constexpr std::size_t most_pictures = 64;

  // Each picture that is compared, in order. BEFORE_TO_NOW: how the ground moved since the last one.
  void add(const cv::Mat& picture, double dt_s, const cv::Matx33d& before_to_now);
  void forget();
  // Whether there are pictures to compare the newest one with.
  [[nodiscard]] bool is_ready() const;
  // The mask, as background_model gives it, in pixels of the newest picture. GAP_S: `quick_s` or `slow_s`; LEAST: grey
  // levels that are no noise.
  [[nodiscard]] cv::Mat find(double gap_s, int least) const;

private:
  [[nodiscard]] const past_picture* of_age(double age_s) const;

  cv::Mat now_;
  past_pictures pictures_; // of each pixel the least and the most of the nine around it
};

} // namespace godwit::eyes
