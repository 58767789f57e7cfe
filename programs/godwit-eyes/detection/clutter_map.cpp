#include "programs/godwit-eyes/detection/clutter_map.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "programs/godwit-eyes/detection/own_motion.hpp"

namespace godwit::eyes {

namespace {

constexpr int cell_columns = 20;
constexpr int cell_rows = 12;
constexpr int cells_around = 2;       // cells on each side of the one of a place
constexpr double first_births = 0.04; // a second and cell: what was not seen yet is not trusted
constexpr double clutter_memory_s = 1;
constexpr double calm_births = 1.2; // a second, around a place
constexpr double few_blobs = 7;     // a picture: too few to be clutter, where they stay
constexpr double few_births = 25;   // a second, in the whole picture
constexpr double usual_step_s = 0.1;
// Noise begins in each picture anew, leaves do not: births a second rise so with the pictures a second.
constexpr double flicker_exponent = 0.8;
constexpr int longest_missed = 2; // pictures
constexpr double like_growth = 2.2;
constexpr double like_slack_px = 2;

double length(const cv::Rect2d& box) { return std::max(box.width, box.height) + like_slack_px; }

bool is_like(const cv::Rect2d& a, const cv::Rect2d& b) {
  return cv::norm(middle_of(a) - middle_of(b)) < std::max(length(a), length(b)) / 2 + like_slack_px &&
         length(a) < like_growth * length(b) && length(b) < like_growth * length(a);
}

} // namespace

void clutter_map::step(std::span<const blob> blobs, double dt_s, const cv::Matx33d& ground, const cv::Size& picture) {
  picture_ = picture;
  if (births_.empty()) {
    births_ = cv::Mat(cell_rows, cell_columns, CV_32F, cv::Scalar(first_births));
  } else {
    const cv::Matx33d to_cells(static_cast<double>(cell_columns) / picture.width, 0, -0.5, 0,
                               static_cast<double>(cell_rows) / picture.height, -0.5, 0, 0, 1);
    cv::Mat carried;
    cv::warpPerspective(births_, carried, to_cells * ground * to_cells.inv(), births_.size(), cv::INTER_LINEAR,
                        cv::BORDER_REPLICATE);
    births_ = carried;
  }
  for (auto& each : known_) {
    const cv::Point2d at = moved(ground, middle_of(each.box));
    each.box.x = at.x - each.box.width / 2;
    each.box.y = at.y - each.box.height / 2;
    ++each.missed;
  }
  const double fresh = std::min(1.0, dt_s / clutter_memory_s);
  count_ += fresh * (static_cast<double>(blobs.size()) - count_);
  births_ *= 1 - fresh;
  const double weight = std::pow(dt_s / usual_step_s, flicker_exponent) / clutter_memory_s;
  for (const auto& each : blobs)
    if (!recognize(each.box))
      births_.at<float>(cell_of(middle_of(each.box))) += static_cast<float>(weight);
  std::erase_if(known_, [](const known_blob& each) { return each.missed > longest_missed; });
}

void clutter_map::forget() {
  births_.release();
  known_.clear();
  count_ = first_count;
}

double clutter_map::births_around(const cv::Point2d& place) const {
  if (is_calm())
    return 0;
  const cv::Point cell = cell_of(place);
  const cv::Size around(2 * cells_around + 1, 2 * cells_around + 1);
  const cv::Rect cells =
      cv::Rect(cell - cv::Point(cells_around, cells_around), around) & cv::Rect(cv::Point(), births_.size());
  return cv::mean(births_(cells))[0] * around.area(); // beyond the border as before it
}

bool clutter_map::is_calm_at(const cv::Point2d& place) const { return births_around(place) < calm_births; }

bool clutter_map::is_calm() const {
  return count_ < few_blobs && (births_.empty() || cv::sum(births_)[0] < few_births);
}

// Remembers it, too.
bool clutter_map::recognize(const cv::Rect2d& box) {
  const auto like =
      std::ranges::find_if(known_, [&](const known_blob& each) { return each.missed > 0 && is_like(each.box, box); });
  if (like == known_.end()) {
    known_.push_back({box});
    return false;
  }
  *like = {box};
  return true;
}

cv::Point clutter_map::cell_of(const cv::Point2d& place) const {
  return {std::clamp(static_cast<int>(place.x * cell_columns / picture_.width), 0, cell_columns - 1),
          std::clamp(static_cast<int>(place.y * cell_rows / picture_.height), 0, cell_rows - 1)};
}

} // namespace godwit::eyes
