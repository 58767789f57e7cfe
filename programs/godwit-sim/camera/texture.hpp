// The ground as a square picture that repeats in both directions without a seam, at several sizes, so that it can be
// sampled from any height without flicker. Thread: const after it was made.
#pragma once

#include <cstdint>
#include <vector>

namespace godwit::sim::camera {

struct ground_style {
  double contrast = 22;   // standard deviation of the brightness
  double roughness = 0.7; // of each octave to the one twice as coarse
  int patches = 60;       // fields, yards and roads
};

class texture {
public:
  static constexpr int side_bits = 11;
  static constexpr int side = 1 << side_bits; // texels
  static constexpr int levels = 8;
  static constexpr double texel_m = 0.06;

  texture(std::uint64_t seed, const ground_style& style);

  // side >> LEVEL squared; row by row.
  [[nodiscard]] const std::uint8_t* level(int n) const { return levels_[static_cast<std::size_t>(n)].data(); }
  // Brightness at a place of level 0, without interpolation.
  [[nodiscard]] int at(int u, int v) const {
    return levels_[0][static_cast<std::size_t>((v & (side - 1)) * side + (u & (side - 1)))];
  }

private:
  std::vector<std::vector<std::uint8_t>> levels_;
};

// Smooth and periodic, of standard deviation 1, for what changes slowly: relief, clouds, large areas.
class smooth_field {
public:
  smooth_field(std::uint64_t seed, double cell_m);
  [[nodiscard]] double at(double north_m, double east_m) const;

private:
  static constexpr int side = 64; // cells
  double cell_m_;
  std::vector<float> values_;
};

} // namespace godwit::sim::camera
