#include "actors/executor/plan/survey/line_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace godwit::executor::plan {

namespace {

using strip = std::vector<flown_line>; // one line for each row, row by row, each in the direction of the axis

bool overlap(const stretch& a, const stretch& b) { return a.from_m < b.to_m && b.from_m < a.to_m; }

std::size_t neighbours(const stretch& of, const scan_row& row) {
  return static_cast<std::size_t>(std::count_if(row.stretches.begin(), row.stretches.end(),
                                                [&](const stretch& each) { return overlap(of, each); }));
}

// The stretch of the row before that OF goes on from: the only one beside it, and OF is the only one beside that.
std::optional<std::size_t> goes_on_from(const stretch& of, const scan_row& row, const scan_row& before) {
  if (neighbours(of, before) != 1)
    return std::nullopt;
  const auto found = std::find_if(before.stretches.begin(), before.stretches.end(),
                                  [&](const stretch& each) { return overlap(of, each); });
  if (neighbours(*found, row) != 1)
    return std::nullopt;
  return static_cast<std::size_t>(found - before.stretches.begin());
}

std::vector<strip> strips_of(std::span<const scan_row> rows) {
  std::vector<strip> strips;
  std::vector<std::size_t> strip_before; // of each stretch of the row before
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<std::size_t> strip_here;
    for (const auto& each : rows[i].stretches) {
      const auto from = i > 0 ? goes_on_from(each, rows[i], rows[i - 1]) : std::nullopt;
      if (!from)
        strips.emplace_back();
      strip_here.push_back(from ? strip_before[*from] : strips.size() - 1);
      const double across_m = rows[i].across_m;
      strips[strip_here.back()].push_back({{each.from_m, across_m}, {each.to_m, across_m}});
    }
    strip_before = std::move(strip_here);
  }
  return strips;
}

// A corner of a strip to begin at.
struct entry {
  std::size_t strip = 0;
  bool at_last_row = false;
  bool at_far_end = false;
  double distance_m = std::numeric_limits<double>::infinity();
};

entry nearest_entry(const std::vector<strip>& strips, const line_point& here) {
  entry best;
  for (std::size_t i = 0; i < strips.size(); ++i)
    for (const bool at_last_row : {false, true})
      for (const bool at_far_end : {false, true}) {
        const auto& line = at_last_row ? strips[i].back() : strips[i].front();
        const auto& corner = at_far_end ? line.to : line.from;
        const double distance_m = std::hypot(corner.along_m - here.along_m, corner.across_m - here.across_m);
        if (distance_m < best.distance_m)
          best = {i, at_last_row, at_far_end, distance_m};
      }
  return best;
}

void fly(strip lines, const entry& at, std::vector<flown_line>& flown) {
  if (at.at_last_row)
    std::reverse(lines.begin(), lines.end());
  bool backwards = at.at_far_end;
  for (const auto& each : lines) {
    flown.push_back(backwards ? flown_line{each.to, each.from} : each);
    backwards = !backwards;
  }
}

} // namespace

std::vector<flown_line> lines_in_order(std::span<const scan_row> rows, const line_point& coming_from) {
  auto strips = strips_of(rows);
  std::vector<flown_line> flown;
  auto here = coming_from;
  while (!strips.empty()) {
    const auto next = nearest_entry(strips, here);
    fly(std::move(strips[next.strip]), next, flown);
    strips.erase(strips.begin() + static_cast<std::ptrdiff_t>(next.strip));
    here = flown.back().to;
  }
  return flown;
}

} // namespace godwit::executor::plan
