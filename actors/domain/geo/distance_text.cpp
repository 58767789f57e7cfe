#include "actors/domain/geo/distance_text.hpp"

#include <array>
#include <cmath>

#include "runtime/assert.hpp"

namespace godwit::geo {

namespace {

double rounded_to(double value, double step) { return std::round(value / step) * step; }

} // namespace

std::string grouped(double value) {
  GODWIT_ASSERT(std::isfinite(value), "geo: a number that is written is one");
  auto text = std::to_string(std::llround(std::abs(value)));
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3)
    text.insert(static_cast<std::size_t>(at), 1, ',');
  return std::llround(value) < 0 ? '-' + text : text;
}

std::string distance_text(double metres) {
  GODWIT_ASSERT(std::isfinite(metres) && metres >= 0, "geo: a distance is a number from 0 on");
  if (metres < 99.5)
    return grouped(metres) + " m";
  if (metres < 995)
    return grouped(rounded_to(metres, 10)) + " m";
  if (metres >= 99'950)
    return grouped(rounded_to(metres / 1000, metres < 999'500 ? 1 : metres < 9'995'000 ? 10 : 100)) + " km";
  const auto tenths = std::llround(metres / 100);
  const auto rest = tenths % 10;
  return std::to_string(tenths / 10) + (rest == 0 ? "" : '.' + std::to_string(rest)) + " km";
}

std::string_view direction_text(double bearing_deg) {
  GODWIT_ASSERT(std::isfinite(bearing_deg), "geo: a bearing is a number");
  static constexpr std::array<std::string_view, 8> names{"north", "north-east", "east", "south-east",
                                                         "south", "south-west", "west", "north-west"};
  const auto from_north = bearing_deg - 360 * std::floor(bearing_deg / 360);
  return names.at(static_cast<std::size_t>(std::lround(from_north / 45)) % names.size());
}

} // namespace godwit::geo
