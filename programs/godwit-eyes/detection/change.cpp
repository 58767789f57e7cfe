#include "programs/godwit-eyes/detection/change.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "programs/godwit-eyes/detection/background_model.hpp"
#include "programs/godwit-eyes/detection/places.hpp"

namespace godwit::eyes {

namespace {

constexpr double age_slack = 0.4; // of the age that is looked for
constexpr int sure_by = 2;        // times the noise

} // namespace

void recent_change::add(const cv::Mat& picture, double dt_s, const cv::Matx33d& before_to_now) {
  now_ = picture;
  std::array<cv::Mat, 2> range;
  cv::erode(picture, range[0], cv::Mat());
  cv::dilate(picture, range[1], cv::Mat());
  cv::Mat ranges;
  cv::merge(range.data(), range.size(), ranges);
  add_newest(pictures_, ranges, dt_s, before_to_now);
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

namespace {

// By how many grey levels each pixel of a run lies outside of what the earlier picture has around the place where the
// ground was; 0 where that one does not reach. The nearest pixel is as good as one between pixels: those around it
// count as well. Whether one is more than LEAST.
bool add_differences(const placed_run& run, const std::uint8_t* now, const cv::Mat& ranges, int least,
                     std::uint8_t* differs) {
  bool is_any = false;
  for_each_nearest(run, ranges.size(), [&](int x, int column, int row) {
    const std::uint8_t* const range = ranges.data + static_cast<std::size_t>(row) * ranges.step[0] + 2 * column;
    const int by = std::max({range[0] - now[x], now[x] - range[1], 0});
    differs[x - run.begin] = static_cast<std::uint8_t>(by);
    is_any = is_any || by > least;
  });
  return is_any;
}

} // namespace

cv::Mat recent_change::find(double gap_s, int least) const {
  cv::Mat mask = cv::Mat::zeros(now_.size(), CV_8UC1);
  const past_picture* const first = of_age(gap_s);
  const past_picture* const second = of_age(2 * gap_s);
  if (first == nullptr || second == nullptr || first == second)
    return mask;
  const cv::Matx33d to_second = second->to_now.inv();
  for_each_run(now_.size(), first->to_now.inv(), [&](const placed_run& run) {
    const std::uint8_t* const now = now_.ptr<std::uint8_t>(run.y);
    std::array<std::uint8_t, longest_run> to_first{};
    if (!add_differences(run, now, first->picture, least, to_first.data()))
      return; // most of the picture
    std::array<std::uint8_t, longest_run> to_both{};
    add_differences(placed(run, to_second), now, second->picture, least, to_both.data());
    for (int x = run.begin; x < run.end; ++x) {
      const auto n = static_cast<std::size_t>(x - run.begin);
      const int by = std::min(to_first[n], to_both[n]);
      if (by > least)
        mask.at<std::uint8_t>(run.y, x) = by > sure_by * least ? mask_value::sure : mask_value::may_be;
    }
  });
  return mask;
}

} // namespace godwit::eyes
