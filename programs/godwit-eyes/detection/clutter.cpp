#include "programs/godwit-eyes/detection/clutter.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "programs/godwit-eyes/detection/own_motion.hpp"

namespace godwit::eyes {

namespace {

constexpr double least_way_px = 4;        // of the ground, at the middle and at each corner
constexpr double longest_reference_s = 3; // by then light and exposure change, too
constexpr int like_below = 10;            // grey levels
constexpr int unlike_from = 16;
constexpr double gain_a_s = 30; // of the evidence
constexpr int evidence_lost = 30;
constexpr int enough_evidence = 60;
constexpr int enough_in_turn = 3; // comparisons: by then it is doubted
constexpr int unlike_itself = 12;
constexpr int fewest_beside = 3; // of nine pixels
constexpr int most_evidence = 250;
constexpr int fewest_still_pixels = 12; // single ones are chance
const cv::Size between_letters(41, 11); // digits that change lie among letters that stay
const cv::Size around_it(11, 11);

// The least way of the corners and the middle.
double way_of(const cv::Matx33d& by, const cv::Size& size) {
  const double right = size.width - 1;
  const double bottom = size.height - 1;
  double least = 1e9;
  for (const auto& at : {cv::Point2d(0, 0), cv::Point2d(right, 0), cv::Point2d(0, bottom), cv::Point2d(right, bottom),
                         cv::Point2d(right / 2, bottom / 2)})
    least = std::min(least, cv::norm(moved(by, at) - at));
  return least;
}

// With what lies between letters and around them; empty: nothing. A pixel that has hardly a like one around it is
// chance.
cv::Mat marked(const cv::Mat& stays) {
  cv::Mat around;
  cv::boxFilter(stays, around, CV_16U, cv::Size(3, 3), cv::Point(-1, -1), false);
  cv::Mat dense = stays & (around >= fewest_beside * 255);
  if (cv::countNonZero(dense) < fewest_still_pixels)
    return {};
  cv::morphologyEx(dense, dense, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_RECT, between_letters));
  cv::dilate(dense, dense, cv::getStructuringElement(cv::MORPH_RECT, around_it));
  return dense;
}

} // namespace

void still_parts::step(const cv::Mat& now, double dt_s, const cv::Matx33d& before_to_now) {
  if (evidence_.size() != now.size()) {
    evidence_ = cv::Mat::zeros(now.size(), CV_8UC1);
    in_turn_ = cv::Mat::zeros(now.size(), CV_8UC1);
    doubtful_.release();
    still_.release();
    reference_.release();
  }
  reference_to_now_ = before_to_now * reference_to_now_;
  reference_age_s_ += dt_s;
  const bool has_gone = !reference_.empty() && way_of(reference_to_now_, now.size()) >= least_way_px;
  if (has_gone)
    compare(now);
  if (has_gone || reference_.empty() || reference_age_s_ > longest_reference_s) {
    now.copyTo(reference_);
    reference_to_now_ = cv::Matx33d::eye();
    reference_age_s_ = 0;
  }
}

void still_parts::compare(const cv::Mat& now) {
  cv::Mat brought;
  cv::warpPerspective(reference_, brought, reference_to_now_, now.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::Mat from_itself;
  cv::Mat from_ground;
  cv::absdiff(now, reference_, from_itself);
  cv::absdiff(now, brought, from_ground);
  const cv::Mat stays = (from_itself < like_below) & (from_ground > unlike_from);
  cv::add(evidence_, cv::Scalar(std::max(1.0, std::round(gain_a_s * reference_age_s_))), evidence_, stays);
  cv::subtract(evidence_, cv::Scalar(evidence_lost), evidence_, from_itself >= 2 * like_below);
  cv::min(evidence_, most_evidence, evidence_);
  still_ = marked(evidence_ >= enough_evidence);
  cv::add(in_turn_, cv::Scalar(1), in_turn_, stays);
  in_turn_.setTo(0, from_itself > unlike_itself);
  doubtful_ = marked(in_turn_ >= enough_in_turn);
}

void still_parts::clear(cv::Mat& mask) const {
  if (!still_.empty())
    mask.setTo(0, still_);
}

bool still_parts::may_stand(const cv::Rect2d& box) const {
  if (doubtful_.empty())
    return false;
  const cv::Rect inside = cv::Rect(box) & cv::Rect(cv::Point(), doubtful_.size());
  return !inside.empty() && 2 * cv::countNonZero(doubtful_(inside)) > inside.area();
}

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
