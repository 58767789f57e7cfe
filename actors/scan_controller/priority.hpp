// How much a point of interest is worth a look now: confidence x nearness x freshness x movement, each 0..1. Pure.
// Thread: any.
#pragma once

#include <cstdint>
#include <optional>

#include "actors/domain/geo/point.hpp"
#include "actors/scan_controller/point.hpp"

namespace godwit::scan_controller {

// Where each of them has come down to a half.
inline constexpr double half_nearness_m = 500;
inline constexpr double half_freshness_ns = 60e9;
inline constexpr double standing_worth = 0.7; // of what moves

// VEHICLE: where it is; nothing: not known, and all are equally near.
[[nodiscard]] double priority_of(const point& what, const std::optional<geo::point>& vehicle, std::int64_t now_ns);

// A goes before B. What is not above the threshold comes last; among equals the older number comes first.
struct ranked {
  bool is_above = false; // the threshold
  double priority = 0;
  std::uint64_t number = 0;
};
[[nodiscard]] bool goes_before(const ranked& a, const ranked& b);

} // namespace godwit::scan_controller
