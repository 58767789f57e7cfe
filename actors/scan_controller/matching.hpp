// Which point of interest a candidate is about: of the same class group, and the same object of the map or near enough.
// Pure. Thread: any.
#pragma once

#include <algorithm>
#include <vector>

#include "actors/scan_controller/point.hpp"
#include "messages/scan_controller/candidate.hpp"

namespace godwit::scan_controller {

[[nodiscard]] bool is_about(const candidate& seen, const point& known, double within_m);

[[nodiscard]] inline const point& point_of(const point& each) { return each; }
template <class Phase>
[[nodiscard]] const point& point_of(const Phase& each) {
  return each.what;
}

// Null: none in the list.
template <class Listed>
[[nodiscard]] const Listed* find_match(const std::vector<Listed>& list, const candidate& seen, double within_m) {
  const auto found =
      std::ranges::find_if(list, [&](const Listed& each) { return is_about(seen, point_of(each), within_m); });
  return found == list.end() ? nullptr : &*found;
}

} // namespace godwit::scan_controller
