// What was in view during a pass, as areas that can be asked one by one. Thread: pure.
#pragma once

#include <variant>
#include <vector>

#include "actors/domain/geo/bounding_box.hpp"
#include "actors/domain/geo/polygon.hpp"
#include "messages/mapobjects_store/pass.hpp"

namespace godwit::mapobjects_store {

struct circle_area {
  geo::point centre;
  double radius_m = 0;
};

using view_area = std::variant<circle_area, geo::polygon>;

// Input that was checked.
[[nodiscard]] std::vector<view_area> areas_of(const pass_end& pass);

[[nodiscard]] bool contains(const view_area& area, const geo::point& at);
[[nodiscard]] std::vector<geo::bounding_box> boxes_of(const view_area& area);

} // namespace godwit::mapobjects_store
