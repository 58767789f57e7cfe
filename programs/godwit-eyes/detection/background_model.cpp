#include "programs/godwit-eyes/detection/background_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>

#include "programs/godwit-eyes/detection/places.hpp"

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
constexpr int least_outside = 8;   // grey levels: less is within found_squared of the least variance
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

// One row of a mode.
struct mode_row {
  float* mean;
  float* variance;
  float* age;
  void start(int x, float value) const {
    mean[x] = value;
    variance[x] = first_variance;
    age[x] = 1;
  }
  [[nodiscard]] bool is_like(int x, float value) const {
    return (value - mean[x]) * (value - mean[x]) < fits_squared * std::max(variance[x], least_variance);
  }
  // The mean follows by 1/age, the variance likewise.
  void refine(int x, float value) const {
    const float share = 1 / (age[x] + 1);
    const float deviation = value - mean[x];
    mean[x] += share * deviation;
    variance[x] =
        std::clamp(variance[x] + share * (deviation * deviation - variance[x]), least_variance, most_variance);
    age[x] = std::min(age[x] + 1, oldest);
  }
};

mode_row row_of(std::array<cv::Mat, 3>& planes, int y, int left) {
  return {planes[0].ptr<float>(y) + left, planes[1].ptr<float>(y) + left, planes[2].ptr<float>(y) + left};
}

constexpr int at_once = 4;

// The next four pixels as numbers.
cv::v_float32x4 four(const std::uint8_t* of) {
  return cv::v_cvt_f32(cv::v_reinterpret_as_s32(cv::v_load_expand_q(of)));
}

// What does not fit goes to the other mode, which takes the place of the ground when it has become older.
void learn(const mode_row& ground, const mode_row& other, int x, float value) {
  if (ground.age[x] < 1)
    return ground.start(x, value);
  if (other.age[x] > 0 && other.is_like(x, value))
    other.refine(x, value);
  else
    other.start(x, value);
  if (other.age[x] <= ground.age[x])
    return;
  ground.mean[x] = other.mean[x];
  ground.variance[x] = other.variance[x];
  ground.age[x] = other.age[x];
  other.age[x] = 0;
}

// Between four pixels, in proportion; at the border the nearest one.
float between(const cv::Mat& of, const cv::Point& place) {
  constexpr int half = 1 << (place_bits - 1);
  constexpr float share = 1.0F / (1 << place_bits);
  constexpr int below_one = (1 << place_bits) - 1;
  const cv::Point at(place.x >> place_bits, place.y >> place_bits);
  if (!cv::Rect(0, 0, of.cols - 1, of.rows - 1).contains(at))
    return of.at<float>((place.y + half) >> place_bits, (place.x + half) >> place_bits);
  const float right = static_cast<float>(place.x & below_one) * share;
  const float below = static_cast<float>(place.y & below_one) * share;
  const float* const upper = of.ptr<float>(at.y) + at.x;
  const float* const lower = of.ptr<float>(at.y + 1) + at.x;
  return (1 - below) * ((1 - right) * upper[0] + right * upper[1]) +
         below * ((1 - right) * lower[0] + right * lower[1]);
}

// One row of pixels, several at once by OpenCV's universal intrinsics: most of the picture is ground. What fits makes
// the ground surer. WIDTH: a multiple of `at_once`.
void learn_row(const mode_row& ground, const mode_row& other, const std::uint8_t* laid, const std::uint8_t* is_known,
               int width) {
  const auto all = [](float value) { return cv::v_setall_f32(value); };
  const auto one = all(1);
  for (int x = 0; x < width; x += at_once) {
    const auto known = cv::v_min(four(is_known + x), one);
    const auto mean = cv::v_load(ground.mean + x);
    const auto variance = cv::v_load(ground.variance + x);
    const auto age = cv::v_load(ground.age + x);
    const auto deviation = four(laid + x) - mean;
    const auto squared = deviation * deviation;
    const auto fits = (squared < all(fits_squared) * cv::v_max(variance, all(least_variance))) & (age >= one);
    const auto does = fits & known;
    const auto share = does / (age + one);
    const auto next = variance + share * (squared - variance);
    cv::v_store(ground.mean + x, mean + share * deviation);
    cv::v_store(ground.variance + x,
                cv::v_select(fits, cv::v_min(cv::v_max(next, all(least_variance)), all(most_variance)), variance));
    cv::v_store(ground.age + x, cv::v_min(age + does, all(oldest)));
    if (cv::v_check_all(does + one - known >= one))
      continue;
    for (int n = x; n < x + at_once; ++n)
      if (is_known[n] != 0 && (ground.age[n] < 1 || !ground.is_like(n, laid[n])))
        learn(ground, other, n, laid[n]);
  }
}

} // namespace

const cv::Mat& background_model::look(const cv::Mat& now, const cv::Matx33d& before_to_now) {
  canvas_to_now_ = before_to_now * canvas_to_now_;
  const cv::Rect canvas(cv::Point(), canvas_);
  if (mean_.empty() || !has_like_scale(now.size()) ||
      ((bounds_of(now.size()) & canvas) != bounds_of(now.size()) && !shift_canvas(now.size())))
    lay_canvas(now.size());
  const cv::Rect part = part_of(now.size());
  lay_picture(now, part);
  match_brightness(part);
  const cv::Mat mean = mean_(part);
  const cv::Mat around = cv::getStructuringElement(cv::MORPH_RECT, cv::Size(3, 3));
  cv::erode(mean, lowest_, around);
  cv::dilate(mean, highest_, around);
  update(part);
  const cv::Matx33d part_to_now = canvas_to_now_ * cv::Matx33d(1, 0, part.x, 0, 1, part.y, 0, 0, 1);
  mask_ = cv::Mat::zeros(now.size(), CV_8UC1);
  for_each_run(now.size(), part_to_now.inv(), [&](const placed_run& run) {
    std::uint8_t* const mask = mask_.ptr<std::uint8_t>(run.y);
    for_each_nearest(run, found_.size(), [&](int x, int column, int row) {
      mask[x] = found_.data[static_cast<std::size_t>(row) * found_.step[0] + column];
    });
  });
  return mask_;
}

void background_model::forget() {
  mean_.release();
  shadows_.forget();
  canvas_to_now_ = cv::Matx33d::eye();
}

// Of the canvas, that the picture covers; its width is a multiple of `at_once`, as that of the canvas is.
cv::Rect background_model::part_of(const cv::Size& picture) const {
  cv::Rect part = bounds_of(picture) & cv::Rect(cv::Point(), canvas_);
  const int right = (part.br().x + at_once - 1) / at_once * at_once;
  part.x = part.x / at_once * at_once;
  part.width = right - part.x;
  return part;
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
  for (auto* const mode : {&ground_, &other_})
    for (auto& plane : *mode)
      shift(plane, by);
  shift(mean_, by);
  canvas_to_now_ = canvas_to_now_ * cv::Matx33d(1, 0, -by.x, 0, 1, -by.y, 0, 0, 1);
  return true;
}

void background_model::lay_canvas(const cv::Size& picture) {
  const cv::Matx33d new_to_now(1, 0, -margin, 0, 1, -margin, 0, 0, 1);
  const cv::Size size((picture.width + 2 * margin + at_once - 1) / at_once * at_once, picture.height + 2 * margin);
  const auto old_ground = std::exchange(ground_, {});
  const auto old_other = std::exchange(other_, {});
  const cv::Mat old_mean = std::exchange(mean_, {});
  for (auto* const mode : {&ground_, &other_})
    for (auto& plane : *mode)
      plane = cv::Mat::zeros(size, CV_32FC1);
  mean_ = cv::Mat::zeros(size, CV_8UC1);
  if (!old_mean.empty())
    for_each_run(size, canvas_to_now_.inv() * new_to_now, [&](const placed_run& run) {
      for_each_nearest(run, old_mean.size(), [&](int x, int column, int row) {
        const cv::Point at = run.place + (x - run.begin) * run.step;
        for (std::size_t n = 0; n < ground_.size(); ++n) {
          ground_[n].at<float>(run.y, x) = between(old_ground[n], at); // half a pixel off, edges would differ
          other_[n].at<float>(run.y, x) = old_other[n].at<float>(row, column);
        }
        mean_.at<std::uint8_t>(run.y, x) = cv::saturate_cast<std::uint8_t>(ground_[0].at<float>(run.y, x));
      });
    });
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

// Between four pixels, in proportion.
void background_model::lay_picture(const cv::Mat& now, const cv::Rect& part) {
  laid_.create(part.size(), CV_8UC1);
  is_known_ = cv::Mat::zeros(part.size(), CV_8UC1);
  const cv::Matx33d part_to_now = canvas_to_now_ * cv::Matx33d(1, 0, part.x, 0, 1, part.y, 0, 0, 1);
  for_each_run(part.size(), part_to_now, [&](const placed_run& run) {
    constexpr int one = 256;
    constexpr int to_share = place_bits - 8;
    std::uint8_t* const laid = laid_.ptr<std::uint8_t>(run.y);
    std::uint8_t* const is_known = is_known_.ptr<std::uint8_t>(run.y);
    cv::Point at = run.place;
    for (int x = run.begin; x < run.end; ++x, at += run.step) {
      const int column = at.x >> place_bits;
      const int row = at.y >> place_bits;
      if (column < 0 || row < 0 || column >= now.cols - 1 || row >= now.rows - 1)
        continue;
      const int right = (at.x >> to_share) & (one - 1);
      const int below = (at.y >> to_share) & (one - 1);
      const std::uint8_t* const upper = now.data + static_cast<std::size_t>(row) * now.step[0] + column;
      const std::uint8_t* const lower = upper + now.step[0];
      const int value = (upper[0] * (one - right) + upper[1] * right) * (one - below) +
                        (lower[0] * (one - right) + lower[1] * right) * below;
      laid[x] = static_cast<std::uint8_t>((value + one * one / 2) / (one * one));
      is_known[x] = 255;
    }
  });
}

// One factor for the whole picture: automatic exposure. Least squares on a grid, once more without what does not fit.
void background_model::match_brightness(const cv::Rect& part) {
  constexpr int apart = 8;
  constexpr float most_difference = 18;
  const cv::Mat mean = mean_(part);
  const cv::Mat age = ground_[2](part);
  float factor = 1;
  for (int round = 0; round < 3; ++round) {
    double both = 0;
    double own = 0;
    for (int y = 0; y < part.height; y += apart)
      for (int x = 0; x < part.width; x += apart) {
        if (is_known_.at<std::uint8_t>(y, x) == 0 || age.at<float>(y, x) < young)
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

std::uint8_t background_model::found_at(float mean, float variance, int laid, int outside) {
  const auto squared = static_cast<float>(outside * outside);
  if (squared <= found_squared * variance)
    return 0;
  const bool is_sure = squared > sure_squared * variance;
  const auto value = static_cast<float>(laid);
  if (is_sure && value < mean)
    shadows_.add(value / mean);
  const auto ratio = shadows_.get();
  const bool is_shadow =
      ratio && std::abs(value - *ratio * mean) < std::max(least_shadow_tolerance, shadow_tolerance * mean);
  if (is_shadow)
    return is_sure ? mask_value::shadow_sure : mask_value::shadow_may_be;
  return is_sure ? mask_value::sure : mask_value::may_be;
}

void background_model::update(const cv::Rect& part) {
  found_ = cv::Mat::zeros(part.size(), CV_8UC1);
  const cv::Mat above = laid_ - highest_;
  const cv::Mat below = lowest_ - laid_;
  const cv::Mat outside = cv::max(above, below);
  for (int y = 0; y < part.height; ++y) {
    const std::uint8_t* const laid = laid_.ptr<std::uint8_t>(y);
    const std::uint8_t* const is_known = is_known_.ptr<std::uint8_t>(y);
    const std::uint8_t* const by = outside.ptr<std::uint8_t>(y);
    std::uint8_t* const found = found_.ptr<std::uint8_t>(y);
    const mode_row ground = row_of(ground_, y + part.y, part.x);
    for (int x = 0; x < part.width; ++x)
      if (by[x] >= least_outside && is_known[x] != 0 && ground.age[x] >= young)
        found[x] = found_at(ground.mean[x], std::max(ground.variance[x], least_variance), laid[x], by[x]);
    learn_row(ground, row_of(other_, y + part.y, part.x), laid, is_known, part.width);
  }
  ground_[0](part).convertTo(mean_(part), CV_8U);
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
