// The lines of a survey on the globe.
//
//   polygon ──projection──> plane ──turned by the heading──> scan_rows ──> lines_in_order ──> back to the globe
//
// Lines end at the edge of the area; the ways between them are straight and may lie outside where it is dented. They
// depend on the survey and on where the vehicle comes from, and on nothing else. Thread: pure.
#pragma once

#include <cstddef>
#include <vector>

#include <tl/expected.hpp>

#include "actors/domain/geo/point.hpp"
#include "actors/executor/plan/plan_error.hpp"
#include "messages/mission/item.hpp"

namespace godwit::executor::plan {

inline constexpr std::size_t max_survey_lines = 2'000; // two vehicle items each
inline constexpr double max_survey_radius_m = 50'000;  // around the first corner: what the projection is good for

struct survey_line {
  geo::point from;
  geo::point to;
};

// A survey that keeps the rules of a mission. The error is area_too_large, area_too_small or too_many_lines.
[[nodiscard]] tl::expected<std::vector<survey_line>, plan_errc> survey_lines(const mission::survey& area,
                                                                             const geo::point& coming_from);

} // namespace godwit::executor::plan
