// What the ground looks like, pixel by pixel, and so what does not belong to it.
//
// Each pixel of a canvas, which lies still on the ground, has two Gaussians with an age: one for what is seen there
// mostly, and one for what may take its place. A brightness that fits the first one makes it older and surer; one that
// does not goes to the second, which takes over when it has become older. So what passes leaves no trace, and what
// stays becomes ground. The canvas is shifted when the picture leaves it, and laid anew when the picture is turned or
// its size there differs by a quarter.
//
// Source: Yi, Yun, Kim, Chang, Choi, "Detection of Moving Objects with Non-stationary Cameras in 5.8ms", CVPRW 2013:
// dual-mode single Gaussian model with age. Different from it: the blocks are the pixels of the reduced picture, and
// models are not mixed from frame to frame but stay in their canvas, so that they do not blur. Thread: one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <opencv2/core.hpp>

namespace godwit::eyes {

// How much darker the ground is in a shadow than in the sun, learned from the pictures.
//
// Sun and sky are the same for the whole picture: all shadows darken the ground by one factor, while what is dark
// itself has any brightness. So brightness by that of the ground, of all pixels that are darker than the ground, heaps
// up at that factor where there are shadows, and nowhere where there are none. Thread: plain values. Source: Cucchiara
// et al. 2003, shadow detection by the ratio of brightness.
class shadow_ratio {
public:
  static constexpr float darkest = 0.35F;
  static constexpr float lightest = 0.85F;

  // RATIO: of a pixel that surely differs from the ground and is darker.
  void add(float ratio) {
    if (ratio >= darkest && ratio < lightest)
      ++counts_[static_cast<std::size_t>((ratio - darkest) / bin)];
  }
  // Once for each picture: older ones are forgotten slowly, and the ratio is looked for.
  void end_picture();
  void forget() { *this = {}; }
  // Nothing: there are no shadows, or not enough was seen.
  [[nodiscard]] std::optional<float> get() const { return found_; }

private:
  static constexpr std::size_t bins = 25;
  static constexpr float bin = (lightest - darkest) / bins;
  std::array<float, bins + 1> counts_{}; // one more: rounding
  std::optional<float> found_;
};

namespace mask_value {
inline constexpr std::uint8_t shadow_may_be = 100; // as dark as the ground is in a shadow
inline constexpr std::uint8_t may_be = 128;        // a mover
inline constexpr std::uint8_t shadow_sure = 240;
inline constexpr std::uint8_t sure = 255; // surely differs
} // namespace mask_value

class background_model {
public:
  // That have seen a place before anything is found there: ground that is younger tells nothing.
  static constexpr int pictures_to_know = 3;

  // The mask, in the picture's pixels: 0 ground or not known; else `mask_value`.
  // BEFORE_TO_NOW: how the ground moved since the last picture.
  [[nodiscard]] const cv::Mat& look(const cv::Mat& now, const cv::Matx33d& before_to_now);
  void forget();

private:
  void lay_canvas(const cv::Size& picture);
  [[nodiscard]] bool has_like_scale(const cv::Size& picture) const;
  [[nodiscard]] bool shift_canvas(const cv::Size& picture);
  [[nodiscard]] cv::Rect bounds_of(const cv::Size& picture) const;
  [[nodiscard]] cv::Rect part_of(const cv::Size& picture) const;
  void lay_picture(const cv::Mat& now, const cv::Rect& part);
  void match_brightness(const cv::Rect& part);
  void update(const cv::Rect& part);
  [[nodiscard]] std::uint8_t found_at(float mean, float variance, int laid, int outside);

  cv::Matx33d canvas_to_now_ = cv::Matx33d::eye();
  cv::Size canvas_;
  std::array<cv::Mat, 3> ground_; // mean, variance, age in pictures (0: nothing is known)
  std::array<cv::Mat, 3> other_;  // the same, of what may become ground
  cv::Mat mean_;                  // of the ground, as bytes
  shadow_ratio shadows_;
  // Of the part of the canvas that the picture covers:
  cv::Mat laid_;             // the picture
  cv::Mat is_known_;         // where it is
  cv::Mat lowest_, highest_; // of mean_, around each pixel
  cv::Mat found_;
  cv::Mat mask_;
};

} // namespace godwit::eyes
