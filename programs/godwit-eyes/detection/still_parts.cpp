#include "programs/godwit-eyes/detection/still_parts.hpp"

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
constexpr int most_evidence = 250;
constexpr int fewest_pixels = 12;       // single ones are chance
const cv::Size between_letters(41, 11); // digits that change lie among letters that stay
const cv::Size around_it(13, 13);

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

} // namespace

void still_parts::step(const cv::Mat& now, double dt_s, const cv::Matx33d& before_to_now) {
  if (evidence_.size() != now.size()) {
    evidence_ = cv::Mat::zeros(now.size(), CV_8UC1);
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
  still_ = evidence_ >= enough_evidence;
  if (cv::countNonZero(still_) < fewest_pixels)
    return still_.release();
  cv::morphologyEx(still_, still_, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_RECT, between_letters));
  cv::dilate(still_, still_, cv::getStructuringElement(cv::MORPH_RECT, around_it));
}

void still_parts::clear(cv::Mat& mask) const {
  if (!still_.empty())
    mask.setTo(0, still_);
}

} // namespace godwit::eyes
