// One geofence as a block of air: an area on the ground, and the altitudes at which it counts.
//
// What lies on a side (to a millimetre), on the floor or on the ceiling is inside, for fences that keep in as for those
// that keep out. No floor is no lower bound, no ceiling no upper one. The area may lie across the antimeridian or
// around a pole: its sides are straight in the projection around its first corner, whoever asks, so that two askers
// never see two fences. Errors: what is no area is refused with a sentence. Thread: pure.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "actors/domain/geo/polygon.hpp"
#include "actors/domain/geofence/altitude_band.hpp"
#include "messages/mission/document.hpp"

namespace godwit::geofence {

// As many corners as the contract of the missions service allows.
inline constexpr std::size_t max_fence_corners = 256;

class fence {
public:
  [[nodiscard]] static tl::expected<fence, std::string> build(const mission::geofence& from);

  [[nodiscard]] bool is_inclusion() const { return kind_ == mission::fence_kind::inclusion; }
  [[nodiscard]] const altitude_band& altitudes() const { return altitudes_; }

  [[nodiscard]] const geo::polygon& area() const { return area_; }

private:
  explicit fence(const mission::geofence& from);

  mission::fence_kind kind_;
  altitude_band altitudes_;
  geo::polygon area_;
};

[[nodiscard]] altitude_band altitudes_of(const mission::geofence& fence);
[[nodiscard]] std::vector<geo::point> corners_of(const mission::geofence& fence);

} // namespace godwit::geofence
