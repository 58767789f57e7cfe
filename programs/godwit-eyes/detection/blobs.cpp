#include "programs/godwit-eyes/detection/blobs.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace godwit::eyes {

namespace {

constexpr int closing = 7; // pixels across which parts belong together
constexpr int fewest_pixels = 6;
constexpr int fewest_sure = 2;
constexpr std::uint8_t sure_from = 200;

// The box of what was in the mask before its holes were closed.
blob counted(const cv::Mat& mask, const cv::Mat& labels, const cv::Rect& around, int label) {
  blob made;
  int left = around.br().x;
  int right = around.x - 1;
  int top = around.br().y;
  int bottom = around.y - 1;
  for (int y = around.y; y < around.br().y; ++y) {
    const std::uint8_t* const row = mask.ptr<std::uint8_t>(y);
    const auto* const label_row = labels.ptr<std::int32_t>(y);
    for (int x = around.x; x < around.br().x; ++x) {
      if (label_row[x] != label || row[x] == 0)
        continue;
      ++made.pixels;
      made.sure += row[x] >= sure_from ? 1 : 0;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  made.box = cv::Rect2d(left, top, right - left + 1, bottom - top + 1);
  return made;
}

} // namespace

blobs_found find_blobs(const cv::Mat& mask) {
  blobs_found found;
  // A single pixel is noise: at least three of nine.
  cv::Mat dense;
  cv::medianBlur(mask, dense, 3);
  cv::max(dense, mask & (dense > 0), dense);
  found.changed_share = static_cast<double>(cv::countNonZero(dense)) / static_cast<double>(mask.total());
  cv::Mat closed;
  cv::morphologyEx(dense > 0, closed, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_RECT, cv::Size(closing, closing)));
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat middles;
  const int count = cv::connectedComponentsWithStats(closed, labels, stats, middles, 8, CV_32S);
  for (int n = 1; n < count; ++n) {
    const cv::Rect around(stats.at<int>(n, cv::CC_STAT_LEFT), stats.at<int>(n, cv::CC_STAT_TOP),
                          stats.at<int>(n, cv::CC_STAT_WIDTH), stats.at<int>(n, cv::CC_STAT_HEIGHT));
    const blob made = counted(dense, labels, around, n);
    if (made.pixels >= fewest_pixels && made.sure >= fewest_sure)
      found.blobs.push_back(made);
  }
  std::ranges::stable_sort(found.blobs, [](const blob& a, const blob& b) { return a.pixels > b.pixels; });
  if (found.blobs.size() > most_blobs)
    found.blobs.resize(most_blobs);
  return found;
}

} // namespace godwit::eyes
