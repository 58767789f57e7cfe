#include "programs/godwit-eyes/detection/background_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

#include <opencv2/imgproc.hpp>

#include "programs/godwit-eyes/detection/own_motion.hpp"

namespace godwit::eyes {

namespace {

constexpr int margin = 96;            // of the canvas around the picture with which it is laid
constexpr float first_variance = 200; // of what was seen once
constexpr float least_variance = 10;
constexpr float most_variance = 1500;
constexpr float oldest = 40;       // pictures; older ones are forgotten at this rate
constexpr float fits_squared = 6;  // of a deviation to the variance: it is the same thing
constexpr float found_squared = 5; // it may be a mover
constexpr float sure_squared = 20; // it surely differs
constexpr float young = background_model::pictures_to_know;
constexpr double least_scale = 0.8;
constexpr double most_scale = 1.25;
constexpr float shadow_tolerance = 0.06F; // of the ground's brightness
constexpr float least_shadow_tolerance = 4;

std::array<cv::Point2d, 4> corners_of(const cv::Size& size) {
  const double right = size.width - 1;
  const double bottom = size.height - 1;
  return {cv::Point2d(0, 0), cv::Point2d(right, 0), cv::Point2d(right, bottom), cv::Point2d(0, bottom)};
}

void start(cv::Vec3f& mode, float value, float age) { mode = {value, first_variance, age}; }

// The mean follows by 1/age, the variance likewise.
void refine(cv::Vec3f& mode, float deviation) {
  const float share = 1 / (mode[2] + 1);
  mode[0] += share * deviation;
  mode[1] += share * (deviation * deviation - mode[1]);
  mode[1] = std::clamp(mode[1], least_variance, most_variance);
  mode[2] = std::min(mode[2] + 1, oldest);
}

bool is_like(const cv::Vec3f& mode, float deviation) {
  return deviation * deviation < fits_squared * std::max(mode[1], least_variance);
}

// Rows in the order in which none is written over before it was read. What comes in is not known: zero.
void shift(cv::Mat& of, const cv::Point& by) {
  const cv::Rect all(cv::Point(), of.size());
  const cv::Rect kept = (all + by) & all;
  const auto bytes = [&](int pixels) { return static_cast<std::size_t>(pixels) * of.elemSize(); };
  for (int n = 0; n < of.rows; ++n) {
    const int y = by.y > 0 ? of.rows - 1 - n : n;
    std::uint8_t* const row = of.ptr(y);
    if (y < kept.y || y >= kept.br().y) {
      std::memset(row, 0, bytes(of.cols));
      continue;
    }
    std::memmove(row + bytes(kept.x), of.ptr(y - by.y) + bytes(kept.x - by.x), bytes(kept.width));
    std::memset(row, 0, bytes(kept.x));
    std::memset(row + bytes(kept.br().x), 0, bytes(of.cols - kept.br().x));
  }
}

void learn(cv::Vec3f& ground, cv::Vec3f& other, float value) {
  const float to_ground = value - ground[0];
  if (is_like(ground, to_ground))
    return refine(ground, to_ground);
  const float to_other = value - other[0];
  if (other[2] > 0 && is_like(other, to_other))
    refine(other, to_other);
  else
    start(other, value, 1);
  if (other[2] > ground[2]) {
    ground = other;
    other = {0, first_variance, 0};
  }
}

} // namespace

const cv::Mat& background_model::look(const cv::Mat& now, const cv::Matx33d& before_to_now) {
  canvas_to_now_ = before_to_now * canvas_to_now_;
  const cv::Rect canvas(cv::Point(), canvas_);
  if (ground_.empty() || !has_like_scale(now.size()) ||
      ((bounds_of(now.size()) & canvas) != bounds_of(now.size()) && !shift_canvas(now.size())))
    lay_canvas(now.size());
  const cv::Rect part = bounds_of(now.size()) & cv::Rect(cv::Point(), canvas_);
  lay_picture(now, part);
  match_brightness(part);
  const cv::Mat mean = mean_(part);
  const cv::Mat around = cv::getStructuringElement(cv::MORPH_RECT, cv::Size(3, 3));
  cv::erode(mean, lowest_, around);
  cv::dilate(mean, highest_, around);
  update(part);
  const cv::Matx33d part_to_now = canvas_to_now_ * cv::Matx33d(1, 0, part.x, 0, 1, part.y, 0, 0, 1);
  cv::warpPerspective(found_, mask_, part_to_now, now.size(), cv::INTER_NEAREST);
  return mask_;
}

void background_model::forget() {
  ground_.release();
  shadows_.forget();
  canvas_to_now_ = cv::Matx33d::eye();
}

// Neither much larger nor much smaller there than it is.
bool background_model::has_like_scale(const cv::Size& picture) const {
  const cv::Matx33d to_canvas = canvas_to_now_.inv();
  const auto corners = corners_of(picture);
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const cv::Point2d& next = corners[(n + 1) % corners.size()];
    const double scale = cv::norm(moved(to_canvas, corners[n]) - moved(to_canvas, next)) / cv::norm(corners[n] - next);
    if (scale < least_scale || scale > most_scale)
      return false;
  }
  return true;
}

// Whole pixels, so that nothing is interpolated. In place: these are the largest pictures of all, and fresh ones would
// have to be cleared. False: the picture is turned so far that it finds no room.
bool background_model::shift_canvas(const cv::Size& picture) {
  const cv::Rect laid = bounds_of(picture);
  if (laid.width > canvas_.width || laid.height > canvas_.height)
    return false;
  const cv::Point by((canvas_.width - laid.width) / 2 - laid.x, (canvas_.height - laid.height) / 2 - laid.y);
  for (cv::Mat* const each : {&ground_, &other_, &mean_})
    shift(*each, by);
  canvas_to_now_ = canvas_to_now_ * cv::Matx33d(1, 0, -by.x, 0, 1, -by.y, 0, 0, 1);
  return true;
}

void background_model::lay_canvas(const cv::Size& picture) {
  const cv::Matx33d new_to_now(1, 0, -margin, 0, 1, -margin, 0, 0, 1);
  const cv::Size size(picture.width + 2 * margin, picture.height + 2 * margin);
  if (ground_.empty()) {
    ground_ = cv::Mat::zeros(size, CV_32FC3);
    other_ = cv::Mat::zeros(size, CV_32FC3);
    mean_ = cv::Mat::zeros(size, CV_8UC1);
  } else {
    const cv::Matx33d old_to_new = new_to_now.inv() * canvas_to_now_;
    cv::Mat ground;
    cv::Mat other;
    cv::Mat mean;
    cv::warpPerspective(ground_, ground, old_to_new, size, cv::INTER_LINEAR);
    cv::warpPerspective(other_, other, old_to_new, size, cv::INTER_NEAREST);
    cv::warpPerspective(mean_, mean, old_to_new, size, cv::INTER_LINEAR);
    ground_ = ground;
    other_ = other;
    mean_ = mean;
  }
  canvas_ = size;
  canvas_to_now_ = new_to_now;
}

// Of the picture, on the canvas or beyond it.
cv::Rect background_model::bounds_of(const cv::Size& picture) const {
  const cv::Matx33d to_canvas = canvas_to_now_.inv();
  const auto corners = corners_of(picture);
  cv::Point2d low = moved(to_canvas, corners[0]);
  cv::Point2d high = low;
  for (const auto& corner : corners) {
    const auto at = moved(to_canvas, corner);
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
  return {cv::Point(static_cast<int>(std::floor(low.x)), static_cast<int>(std::floor(low.y))),
          cv::Point(static_cast<int>(std::ceil(high.x)) + 1, static_cast<int>(std::ceil(high.y)) + 1)};
}

void background_model::lay_picture(const cv::Mat& now, const cv::Rect& part) {
  const cv::Matx33d part_to_now = canvas_to_now_ * cv::Matx33d(1, 0, part.x, 0, 1, part.y, 0, 0, 1);
  cv::warpPerspective(now, laid_, part_to_now, part.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                      cv::BORDER_REPLICATE);
  is_known_ = cv::Mat::zeros(part.size(), CV_8UC1);
  const cv::Matx33d to_part = part_to_now.inv();
  std::array<cv::Point, 4> corners;
  std::ranges::transform(corners_of(now.size()), corners.begin(), [&](const cv::Point2d& corner) {
    const auto at = moved(to_part, corner);
    return cv::Point(static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)));
  });
  cv::fillConvexPoly(is_known_, corners.data(), 4, cv::Scalar(255));
}

// One factor for the whole picture: automatic exposure. Least squares on a grid, once more without what does not fit.
void background_model::match_brightness(const cv::Rect& part) {
  constexpr int apart = 8;
  constexpr float most_difference = 18;
  const cv::Mat mean = mean_(part);
  const cv::Mat ground = ground_(part);
  float factor = 1;
  for (int round = 0; round < 3; ++round) {
    double both = 0;
    double own = 0;
    for (int y = 0; y < part.height; y += apart)
      for (int x = 0; x < part.width; x += apart) {
        if (is_known_.at<std::uint8_t>(y, x) == 0 || ground.at<cv::Vec3f>(y, x)[2] < young)
          continue;
        const float value = laid_.at<std::uint8_t>(y, x);
        const float known = mean.at<std::uint8_t>(y, x);
        if (round > 0 && std::abs(value * factor - known) > most_difference)
          continue;
        both += value * known;
        own += value * value;
      }
    if (own > 0)
      factor = std::clamp(static_cast<float>(both / own), 0.5F, 2.0F);
  }
  if (std::abs(factor - 1) > 0.002F)
    laid_.convertTo(laid_, CV_8U, factor);
}

std::uint8_t background_model::found_at(const cv::Vec3f& ground, int laid, int lowest, int highest) {
  const int outside = std::max({laid - highest, lowest - laid, 0});
  const float squared = static_cast<float>(outside * outside) / std::max(ground[1], least_variance);
  if (squared <= found_squared)
    return 0;
  const bool is_sure = squared > sure_squared;
  const auto value = static_cast<float>(laid);
  if (is_sure && value < ground[0])
    shadows_.add(value / ground[0]);
  const auto ratio = shadows_.get();
  const bool is_shadow =
      ratio && std::abs(value - *ratio * ground[0]) < std::max(least_shadow_tolerance, shadow_tolerance * ground[0]);
  if (is_shadow)
    return is_sure ? mask_value::shadow_sure : mask_value::shadow_may_be;
  return is_sure ? mask_value::sure : mask_value::may_be;
}

void background_model::update(const cv::Rect& part) {
  found_.create(part.size(), CV_8UC1);
  for (int y = 0; y < part.height; ++y) {
    const std::uint8_t* const laid = laid_.ptr<std::uint8_t>(y);
    const std::uint8_t* const is_known = is_known_.ptr<std::uint8_t>(y);
    const std::uint8_t* const lowest = lowest_.ptr<std::uint8_t>(y);
    const std::uint8_t* const highest = highest_.ptr<std::uint8_t>(y);
    std::uint8_t* const found = found_.ptr<std::uint8_t>(y);
    std::uint8_t* const mean = mean_.ptr<std::uint8_t>(y + part.y) + part.x;
    cv::Vec3f* const ground = ground_.ptr<cv::Vec3f>(y + part.y) + part.x;
    cv::Vec3f* const other = other_.ptr<cv::Vec3f>(y + part.y) + part.x;
    for (int x = 0; x < part.width; ++x) {
      found[x] = 0;
      if (is_known[x] == 0)
        continue;
      const float value = laid[x];
      if (ground[x][2] < 1) {
        start(ground[x], value, 1);
      } else {
        if (ground[x][2] >= young)
          found[x] = found_at(ground[x], laid[x], lowest[x], highest[x]);
        learn(ground[x], other[x], value);
      }
      mean[x] = static_cast<std::uint8_t>(ground[x][0] + 0.5F);
    }
  }
  shadows_.end_picture();
}

namespace {

constexpr float kept_share = 0.97F; // of what was seen before, each picture
constexpr float fewest_seen = 600;  // pixels
constexpr float least_heap = 2.0F;  // of three bins around the ratio, by what they would hold if all ratios were alike
constexpr std::size_t beside = 1;   // bins on each side

} // namespace

void shadow_ratio::end_picture() {
  const float all = std::accumulate(counts_.begin(), counts_.end(), 0.0F);
  found_.reset();
  std::size_t best = 0;
  float most = 0;
  for (std::size_t n = beside; n + beside < bins; ++n) {
    const float heap = counts_[n - 1] + counts_[n] + counts_[n + 1];
    if (heap > most) {
      most = heap;
      best = n;
    }
  }
  if (all >= fewest_seen && most >= least_heap * all * (2 * beside + 1) / bins) {
    float sum = 0;
    for (std::size_t n = best - beside; n <= best + beside; ++n)
      sum += counts_[n] * (darkest + bin * (static_cast<float>(n) + 0.5F));
    found_ = sum / most;
  }
  for (auto& each : counts_)
    each *= kept_share;
}

} // namespace godwit::eyes
