#include "programs/godwit-eyes/detection/own_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/video/tracking.hpp>

namespace godwit::eyes {

namespace {

constexpr int columns = 20; // of the grid in which features are chosen, so that they come from everywhere
constexpr int rows = 12;
constexpr std::size_t most_a_cell = 2;
constexpr int levels = 3;
constexpr int most_failures = 2; // pictures in turn that do not fit the one before
const cv::Size window(15, 15);
constexpr int fast_threshold = 14;
constexpr int lowest_fast_threshold = 5;
constexpr std::size_t enough_corners = 160;
constexpr std::size_t fewest_corners = 80; // below, those that are weak, but stand out of what is around them
constexpr int most_weak_corners = 240;
constexpr double least_quality = 0.02; // of the best one
constexpr double weak_apart_px = 8;
constexpr int fewest_features = 12;
constexpr double inlier_px = 1.0;
constexpr double least_inlier_share = 0.25; // unrelated pictures agree in less
constexpr int fewest_inliers = 10;
constexpr double least_spread = 0.15; // share of the grid's cells with an inlier, for a homography
constexpr int consensus_rounds = 400;
constexpr double consensus_confidence = 0.999;

// The best ones of each cell.
std::vector<cv::Point2f> chosen(const std::vector<cv::KeyPoint>& found, const cv::Size& size) {
  std::vector<std::array<const cv::KeyPoint*, most_a_cell>> best(static_cast<std::size_t>(columns * rows));
  for (const auto& each : found) {
    const int column = std::min(columns - 1, static_cast<int>(each.pt.x) * columns / size.width);
    const int row = std::min(rows - 1, static_cast<int>(each.pt.y) * rows / size.height);
    const cv::KeyPoint* candidate = &each;
    for (auto& kept : best[static_cast<std::size_t>(row * columns + column)])
      if (candidate != nullptr && (kept == nullptr || candidate->response > kept->response))
        std::swap(kept, candidate);
  }
  std::vector<cv::Point2f> corners;
  for (const auto& cell : best)
    for (const auto* const each : cell)
      if (each != nullptr)
        corners.push_back(each->pt);
  return corners;
}

std::vector<cv::Point2f> corners_of(const cv::Mat& picture) {
  std::vector<cv::KeyPoint> found;
  cv::FAST(picture, found, fast_threshold);
  auto corners = chosen(found, picture.size());
  if (corners.size() < enough_corners) {
    cv::FAST(picture, found, lowest_fast_threshold);
    corners = chosen(found, picture.size());
  }
  if (corners.size() < fewest_corners)
    cv::goodFeaturesToTrack(picture, corners, most_weak_corners, least_quality, weak_apart_px);
  return corners;
}

bool is_spread(const std::vector<cv::Point2f>& points, const cv::Mat& is_inlier, const cv::Size& size) {
  std::vector<bool> seen(static_cast<std::size_t>(columns * rows));
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (is_inlier.at<std::uint8_t>(static_cast<int>(n)) == 0)
      continue;
    const int column = std::clamp(static_cast<int>(points[n].x) * columns / size.width, 0, columns - 1);
    const int row = std::clamp(static_cast<int>(points[n].y) * rows / size.height, 0, rows - 1);
    seen[static_cast<std::size_t>(row * columns + column)] = true;
  }
  return static_cast<double>(std::ranges::count(seen, true)) >= least_spread * columns * rows;
}

struct pairs {
  std::vector<cv::Point2f> from;
  std::vector<cv::Point2f> to;
};

double median_residual(const pairs& of, const cv::Mat& is_inlier, const cv::Matx33d& way) {
  std::vector<double> distances;
  for (std::size_t n = 0; n < of.from.size(); ++n)
    if (is_inlier.at<std::uint8_t>(static_cast<int>(n)) != 0)
      distances.push_back(cv::norm(moved(way, of.from[n]) - cv::Point2d(of.to[n])));
  if (distances.empty())
    return 0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

motion_found fitted(const pairs& of, const cv::Size& size) {
  motion_found found;
  found.features = static_cast<int>(of.from.size());
  if (found.features < fewest_features) {
    found.why = unusable::few_features;
    return found;
  }
  cv::Mat is_inlier;
  cv::Mat way =
      cv::findHomography(of.from, of.to, cv::USAC_MAGSAC, inlier_px, is_inlier, consensus_rounds, consensus_confidence);
  // Points in one corner tell nothing of how the others are tilted: then turn, size and shift alone.
  if (way.empty() || !is_spread(of.to, is_inlier, size)) {
    way = cv::estimateAffinePartial2D(of.from, of.to, is_inlier, cv::RANSAC, inlier_px, consensus_rounds,
                                      consensus_confidence);
    if (!way.empty())
      way.push_back(cv::Mat(cv::Matx13d(0, 0, 1)));
  }
  if (way.empty()) {
    found.why = unusable::no_homography;
    return found;
  }
  found.before_to_now = cv::Matx33d(way);
  found.inliers = cv::countNonZero(is_inlier);
  found.residual_px = median_residual(of, is_inlier, found.before_to_now);
  if (found.inliers < std::max(static_cast<double>(fewest_inliers), least_inlier_share * found.features))
    found.why = unusable::no_homography;
  return found;
}

} // namespace

motion_found own_motion::step(const cv::Mat& now, const std::optional<cv::Matx33d>& guess) {
  std::vector<cv::Mat> pyramid;
  cv::buildOpticalFlowPyramid(now, pyramid, window, levels);
  motion_found found;
  found.why = unusable::no_homography;
  if (!pyramid_.empty() && before_.size() == now.size() && !corners_.empty()) {
    std::vector<cv::Point2f> to;
    for (const auto& each : corners_)
      to.push_back(cv::Point2f(moved(guess.value_or(last_), each)));
    std::vector<std::uint8_t> is_tracked;
    std::vector<float> error;
    cv::calcOpticalFlowPyrLK(pyramid_, pyramid, corners_, to, is_tracked, error, window, levels,
                             cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 10, 0.03),
                             cv::OPTFLOW_USE_INITIAL_FLOW);
    pairs kept;
    const cv::Rect2f inside(1, 1, static_cast<float>(now.cols - 2), static_cast<float>(now.rows - 2));
    for (std::size_t n = 0; n < to.size(); ++n)
      if (is_tracked[n] != 0 && inside.contains(to[n])) {
        kept.from.push_back(corners_[n]);
        kept.to.push_back(to[n]);
      }
    found = fitted(kept, now.size());
    if (found.why != unusable::none && ++failures_ <= most_failures)
      return found; // the next picture is compared with the same one
  } else if (!pyramid_.empty() && corners_.empty()) {
    found.why = unusable::few_features;
  }
  failures_ = 0;
  last_ = found.why == unusable::none ? found.before_to_now : cv::Matx33d::eye();
  pyramid_ = std::move(pyramid);
  before_ = now;
  corners_ = corners_of(now);
  return found;
}

void own_motion::forget() {
  pyramid_.clear();
  corners_.clear();
  before_.release();
  last_ = cv::Matx33d::eye();
  failures_ = 0;
}

cv::Point2d moved(const cv::Matx33d& by, const cv::Point2d& from) {
  const double w = by(2, 0) * from.x + by(2, 1) * from.y + by(2, 2);
  return {(by(0, 0) * from.x + by(0, 1) * from.y + by(0, 2)) / w,
          (by(1, 0) * from.x + by(1, 1) * from.y + by(1, 2)) / w};
}

double corner_shift(const cv::Matx33d& by, const cv::Size& size) {
  double largest = 0;
  for (const auto& corner : {cv::Point2d(0, 0), cv::Point2d(size.width - 1, 0), cv::Point2d(0, size.height - 1),
                             cv::Point2d(size.width - 1, size.height - 1)})
    largest = std::max(largest, cv::norm(moved(by, corner) - corner));
  return largest;
}

} // namespace godwit::eyes
