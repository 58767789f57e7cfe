#include "tests/support/eyes/naive_detector.hpp"

#include <utility>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace godwit::eyes::test {

namespace {

constexpr int corners = 400;
constexpr int smallest_area = 8;
constexpr double half = 2;

cv::Mat homography_between(const cv::Mat& before, const cv::Mat& now) {
  std::vector<cv::Point2f> from;
  std::vector<cv::Point2f> to;
  cv::goodFeaturesToTrack(before, from, corners, 0.01, 8);
  if (from.size() < 8)
    return {};
  std::vector<std::uint8_t> is_tracked;
  std::vector<float> error;
  cv::calcOpticalFlowPyrLK(before, now, from, to, is_tracked, error, cv::Size(21, 21), 3);
  std::vector<cv::Point2f> kept_from;
  std::vector<cv::Point2f> kept_to;
  for (std::size_t n = 0; n < from.size(); ++n)
    if (is_tracked[n] != 0) {
      kept_from.push_back(from[n]);
      kept_to.push_back(to[n]);
    }
  return kept_from.size() < 8 ? cv::Mat() : cv::findHomography(kept_from, kept_to, cv::RANSAC, 1.5);
}

std::vector<pixel_box> boxes_of(const cv::Mat& mask) {
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat middles;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, middles);
  std::vector<pixel_box> boxes;
  for (int n = 1; n < count; ++n)
    if (stats.at<int>(n, cv::CC_STAT_AREA) >= smallest_area)
      boxes.push_back({stats.at<int>(n, cv::CC_STAT_LEFT) * half, stats.at<int>(n, cv::CC_STAT_TOP) * half,
                       stats.at<int>(n, cv::CC_STAT_WIDTH) * half, stats.at<int>(n, cv::CC_STAT_HEIGHT) * half});
  return boxes;
}

} // namespace

std::vector<pixel_box> naive_detector::look(const frame_view& frame) {
  const cv::Mat full(frame.height, frame.width, CV_8UC1, const_cast<std::uint8_t*>(frame.grey), frame.stride);
  cv::Mat now;
  cv::resize(full, now, cv::Size(), 1 / half, 1 / half, cv::INTER_AREA);
  const cv::Mat before = std::exchange(before_, now);
  if (before.empty())
    return {};
  const cv::Mat way = homography_between(before, now);
  if (way.empty())
    return {};
  cv::Mat laid;
  cv::Mat known;
  cv::warpPerspective(before, laid, way, now.size());
  cv::warpPerspective(cv::Mat(before.size(), CV_8UC1, cv::Scalar(255)), known, way, now.size(), cv::INTER_NEAREST);
  cv::Mat smooth;
  cv::GaussianBlur(laid, laid, cv::Size(3, 3), 0);
  cv::GaussianBlur(now, smooth, cv::Size(3, 3), 0);
  cv::Mat mask;
  cv::absdiff(laid, smooth, mask);
  cv::threshold(mask, mask, settings_.threshold, 255, cv::THRESH_BINARY);
  mask &= known;
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_RECT, cv::Size(2, 2)));
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(settings_.closing_px, settings_.closing_px)));
  return boxes_of(mask);
}

} // namespace godwit::eyes::test
