#include "actors/executor/plan/survey/scan_lines.hpp"

#include <algorithm>
#include <cmath>

namespace godwit::executor::plan {

namespace {

// Corners are written with a centimetre in their last digit: an area wider by that needs no further row.
constexpr double no_width_m = 0.01;

// Each side owns its lower end only, so that a corner counts once and the crossings come in pairs.
std::vector<double> crossings(std::span<const line_point> corners, double across_m) {
  std::vector<double> result;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& a = corners[i];
    const auto& b = corners[(i + 1) % corners.size()];
    if ((a.across_m > across_m) == (b.across_m > across_m))
      continue;
    const double share = (across_m - a.across_m) / (b.across_m - a.across_m);
    result.push_back(a.along_m + share * (b.along_m - a.along_m));
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<stretch> stretches_at(std::span<const line_point> corners, double across_m) {
  const auto ends = crossings(corners, across_m);
  std::vector<stretch> result;
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
    if (ends[i + 1] - ends[i] >= shortest_stretch_m)
      result.push_back({ends[i], ends[i + 1]});
  return result;
}

} // namespace

std::optional<std::vector<scan_row>> scan_rows(std::span<const line_point> corners, double spacing_m,
                                               std::size_t most) {
  const auto [low, high] = std::minmax_element(
      corners.begin(), corners.end(), [](const line_point& a, const line_point& b) { return a.across_m < b.across_m; });
  const double width_m = high->across_m - low->across_m;
  const double count = std::max(1.0, std::ceil((width_m - no_width_m) / spacing_m));
  if (count > static_cast<double>(most))
    return std::nullopt;
  const double first_m = low->across_m + (width_m - (count - 1) * spacing_m) / 2;
  std::vector<scan_row> rows;
  std::size_t stretches = 0;
  for (double i = 0; i < count; ++i) {
    const double across_m = first_m + i * spacing_m;
    rows.push_back({across_m, stretches_at(corners, across_m)});
    stretches += rows.back().stretches.size();
  }
  return stretches > most ? std::nullopt : std::optional(std::move(rows));
}

} // namespace godwit::executor::plan
