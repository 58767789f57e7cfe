// Parallel lines over a polygon in the plane: where each of them lies in it.
//
//   across                             The rows are SPACING apart and stand in the middle: the outermost are half a
//   ^      ____                        spacing from the edge at most, so that each point of the area is at most half a
//   │   __/____\__   row 2             spacing from a row. A row has several stretches where the area is dented.
//   │  /__________\  row 1
//   │ /__/   \_____\ row 0
//   └──────────────────> along
//
// Thread: pure.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace godwit::executor::plan {

// In metres, in axes along the lines and across them.
struct line_point {
  double along_m = 0;
  double across_m = 0;
};

// A piece of a row that lies in the area; from is less than to.
struct stretch {
  double from_m = 0; // along
  double to_m = 0;
};

struct scan_row {
  double across_m = 0;
  std::vector<stretch> stretches; // in order, none touches another
};

// What is shorter is no line: only a corner of the area.
inline constexpr double shortest_stretch_m = 0.05;

// Nothing when there would be more than MOST rows or stretches.
[[nodiscard]] std::optional<std::vector<scan_row>> scan_rows(std::span<const line_point> corners, double spacing_m,
                                                             std::size_t most);

} // namespace godwit::executor::plan
