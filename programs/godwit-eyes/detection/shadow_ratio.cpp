#include "programs/godwit-eyes/detection/shadow_ratio.hpp"

#include <algorithm>
#include <numeric>

namespace godwit::eyes {

namespace {

constexpr float kept = 0.97F;      // of what was seen before, each picture
constexpr float fewest_seen = 600; // pixels
constexpr float least_heap = 2.0F; // of three bins around the ratio, by what they would hold if all ratios were alike
constexpr std::size_t beside = 1;  // bins on each side

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
    each *= kept;
}

} // namespace godwit::eyes
