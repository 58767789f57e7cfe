#include "actors/domain/geo/hilbert.hpp"

#include <algorithm>
#include <utility>

namespace godwit::geo {

namespace {

constexpr std::uint32_t whole = 0xffffffff;

// SHARE of the way along an axis.
std::uint32_t cell_of(double share) {
  return static_cast<std::uint32_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(whole));
}

} // namespace

std::uint64_t hilbert_place(const point& at) {
  auto x = cell_of((at.longitude_deg + 180) / 360);
  auto y = cell_of((at.latitude_deg + 90) / 180);
  std::uint64_t place = 0;
  for (std::uint32_t bit = 0x80000000; bit != 0; bit >>= 1) {
    const bool east = (x & bit) != 0;
    const bool north = (y & bit) != 0;
    place = (place << 2) | (east ? (north ? 2U : 3U) : (north ? 1U : 0U));
    if (!north) { // the two lower quadrants are turned
      if (east) {
        x = whole - x;
        y = whole - y;
      }
      std::swap(x, y);
    }
  }
  return place;
}

} // namespace godwit::geo
