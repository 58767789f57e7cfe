// How much darker the ground is in a shadow than in the sun, learned from the pictures.
//
// Sun and sky are the same for the whole picture: all shadows darken the ground by one factor, while what is dark
// itself has any brightness. So brightness by that of the ground, of all pixels that are darker than the ground, heaps
// up at that factor where there are shadows, and nowhere where there are none. Thread: plain values. Source: Cucchiara
// et al. 2003, shadow detection by the ratio of brightness.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace godwit::eyes {

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

} // namespace godwit::eyes
