#include "programs/godwit-eyes/detection/blobs.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

#include "programs/godwit-eyes/detection/background_model.hpp"

namespace godwit::eyes {

namespace {

constexpr int closing = 7;          // pixels across which parts belong together
constexpr int closing_of_edges = 9; // likewise, of a difference
constexpr int fewest_pixels = 6;
constexpr int fewest_sure = 2;
constexpr std::uint8_t sure_from = 200;
constexpr double least_lit_share = 0.25; // of a mover, when the rest is its shadow

struct bounds {
  int left = 1 << 20;
  int right = -1;
  int top = 1 << 20;
  int bottom = -1;
  int pixels = 0;
  void add(int x, int y) {
    left = std::min(left, x);
    right = std::max(right, x);
    top = std::min(top, y);
    bottom = std::max(bottom, y);
    ++pixels;
  }
  [[nodiscard]] cv::Rect2d box() const { return cv::Rect2d(left, top, right - left + 1, bottom - top + 1); }
};

// What is in the mask as `dense`, and where of it lies as dark as a shadow.
struct labelled {
  const cv::Mat& dense;
  const cv::Mat& shade;
  const cv::Mat& labels;
};

// The box of what was in the mask before its holes were closed. A mover's own shadow is left out of its box where
// enough of it is none, and with the shadow one pixel around it: its edge is half lit, also where it meets the mover,
// whose pixels are mixed with it there. To give that one back to the mover made boxes worse
// (docs/decisions/perception.md).
blob counted(const labelled& in, const cv::Rect& around, int label) {
  blob made;
  bounds all;
  bounds lit;
  for (int y = around.y; y < around.br().y; ++y) {
    const std::uint8_t* const row = in.dense.ptr<std::uint8_t>(y);
    const std::uint8_t* const shade_row = in.shade.empty() ? nullptr : in.shade.ptr<std::uint8_t>(y);
    const std::uint16_t* const label_row = in.labels.ptr<std::uint16_t>(y);
    for (int x = around.x; x < around.br().x; ++x) {
      if (label_row[x] != label || row[x] == 0)
        continue;
      made.sure += row[x] >= sure_from ? 1 : 0;
      all.add(x, y);
      if (shade_row == nullptr || shade_row[x] == 0)
        lit.add(x, y);
    }
  }
  made.pixels = all.pixels;
  made.lit = lit.pixels;
  const bool is_lit = lit.pixels >= fewest_pixels && lit.pixels >= least_lit_share * all.pixels;
  made.box = is_lit ? lit.box() : all.box();
  return made;
}

// Where the mask is as dark as a shadow; empty: nowhere.
cv::Mat shade_of(const cv::Mat& mask) {
  cv::Mat shade = (mask == mask_value::shadow_may_be) | (mask == mask_value::shadow_sure);
  cv::medianBlur(shade, shade, 3); // what matches by chance stands alone
  if (cv::countNonZero(shade) == 0)
    return {};
  cv::dilate(shade, shade, cv::Mat()); // the edge of a shadow is half lit
  return shade;
}

} // namespace

blobs_found find_blobs(const cv::Mat& mask, blob_source from) {
  blobs_found found;
  // A single pixel is noise: at least three of nine.
  cv::Mat dense;
  cv::medianBlur(mask, dense, 3);
  cv::max(dense, mask & (dense > 0), dense);
  found.changed_share = static_cast<double>(cv::countNonZero(dense)) / static_cast<double>(mask.total());
  cv::Mat closed;
  const int across = from == blob_source::background ? closing : closing_of_edges;
  cv::morphologyEx(dense > 0, closed, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_RECT, cv::Size(across, across)));
  const cv::Mat shade = from == blob_source::background ? shade_of(mask) : cv::Mat();
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat middles;
  const int count = cv::connectedComponentsWithStats(closed, labels, stats, middles, 8, CV_16U);
  for (int n = 1; n < count; ++n) {
    const cv::Rect around(stats.at<int>(n, cv::CC_STAT_LEFT), stats.at<int>(n, cv::CC_STAT_TOP),
                          stats.at<int>(n, cv::CC_STAT_WIDTH), stats.at<int>(n, cv::CC_STAT_HEIGHT));
    blob made = counted({dense, shade, labels}, around, n);
    made.from = from;
    if (made.pixels >= fewest_pixels && made.sure >= fewest_sure)
      found.blobs.push_back(made);
  }
  std::ranges::stable_sort(found.blobs, [](const blob& a, const blob& b) { return a.pixels > b.pixels; });
  if (found.blobs.size() > most_blobs)
    found.blobs.resize(most_blobs);
  return found;
}

} // namespace godwit::eyes
