// One geofence as a volume: an area on the ground, and the heights between which it counts.
//
// What lies on a side, on the floor or on the ceiling is inside, for fences that keep in as for those that keep out.
// Altitudes are metres above the place of take-off; no floor is no lower bound, no ceiling no upper one. The area may
// lie across the antimeridian: it is measured in a flat picture around its first corner. Errors: what is no area is
// refused with a sentence. Thread: pure.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "actors/domain/geo/local_projection.hpp"
#include "actors/domain/geo/polygon.hpp"
#include "messages/mission/document.hpp"

namespace godwit::failsafe {

// As many corners as the contract of the missions service allows.
inline constexpr std::size_t max_fence_corners = 256;

// Where the vehicle is: on the ground, and above the place of take-off.
struct place {
  geo::point at;
  double altitude_m = 0;
};

class fence {
public:
  [[nodiscard]] static tl::expected<fence, std::string> build(const mission::geofence& from);

  [[nodiscard]] mission::fence_kind kind() const { return kind_; }
  [[nodiscard]] bool contains(const place& there, bool floor_counts) const;

  // The straight way between two places, as this fence sees it.
  class leg {
  public:
    // Adds the shares of the way, from 0 to 1, at which it passes a side, the floor or the ceiling. A share too many
    // does no harm: between two of them the way is all inside or all outside.
    void add_cuts(std::vector<double>& shares) const;
    [[nodiscard]] bool is_inside(double share, bool floor_counts) const;

  private:
    friend class fence;
    leg(const fence& of, const place& from, const place& to);
    [[nodiscard]] bool is_far() const;
    void add_side_cuts(const geo::local_point& p, const geo::local_point& q, std::vector<double>& shares) const;
    void add_height_cut(std::optional<double> height_m, std::vector<double>& shares) const;

    const fence* fence_;
    place from_;
    place to_;
    geo::local_point start_;
    geo::local_point way_; // from start to end
  };

  [[nodiscard]] leg leg_between(const place& from, const place& to) const { return {*this, from, to}; }

private:
  fence(const mission::geofence& from, const std::vector<geo::point>& corners);
  [[nodiscard]] bool holds_height(double altitude_m, bool floor_counts) const;

  mission::fence_kind kind_;
  std::optional<double> floor_m_;
  std::optional<double> ceiling_m_;
  geo::polygon area_;
  geo::local_projection picture_; // around the first corner
  std::vector<geo::local_point> corners_;
};

} // namespace godwit::failsafe
