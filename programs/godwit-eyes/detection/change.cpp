#include "programs/godwit-eyes/detection/change.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "programs/godwit-eyes/detection/background_model.hpp"

namespace godwit::eyes {

namespace {

constexpr double age_slack = 0.4; // of the age that is looked for
constexpr int sure_by = 2;        // times the noise

} // namespace

void recent_change::add(const cv::Mat& picture, double dt_s, const cv::Matx33d& before_to_now) {
  add_newest(pictures_, picture, dt_s, before_to_now);
  while (pictures_.size() > most_pictures || pictures_.front().age_s > longest_s)
    pictures_.pop_front();
}

void recent_change::forget() { pictures_.clear(); }

bool recent_change::is_ready() const {
  const past_picture* const first = of_age(quick_s);
  const past_picture* const second = of_age(2 * quick_s);
  return first != nullptr && second != nullptr && first != second;
}

// The nearest; at ten pictures a second or fewer there may be none that is near.
const past_picture* recent_change::of_age(double age_s) const {
  const past_picture* best = nullptr;
  for (const auto& each : pictures_)
    if (each.age_s >= age_s * (1 - age_slack) &&
        (best == nullptr || std::abs(each.age_s - age_s) < std::abs(best->age_s - age_s)))
      best = &each;
  return best;
}

// By how many grey levels; 0 where the earlier picture does not reach.
cv::Mat recent_change::difference_to(const past_picture& from) const {
  const cv::Mat& now = pictures_.back().picture;
  cv::Mat laid;
  cv::warpPerspective(from.picture, laid, from.to_now, now.size(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, 0);
  cv::Mat highest;
  cv::Mat lowest;
  cv::dilate(laid, highest, cv::Mat());
  cv::erode(laid, lowest, cv::Mat());
  const cv::Mat above = now - highest;
  const cv::Mat below = lowest - now;
  cv::Mat differs = cv::max(above, below);
  differs.setTo(0, lowest == 0);
  return differs;
}

cv::Mat recent_change::find(double gap_s, int least) const {
  const past_picture* const first = of_age(gap_s);
  const past_picture* const second = of_age(2 * gap_s);
  if (first == nullptr || second == nullptr || first == second)
    return cv::Mat::zeros(pictures_.back().picture.size(), CV_8UC1);
  const cv::Mat differs = cv::min(difference_to(*first), difference_to(*second));
  cv::Mat mask = (differs > least) & cv::Scalar(mask_value::may_be);
  mask.setTo(mask_value::sure, differs > sure_by * least);
  return mask;
}

} // namespace godwit::eyes
