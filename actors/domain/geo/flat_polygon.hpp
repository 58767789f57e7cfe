// A polygon in the flat picture of a local projection: what lies in it, and how near something comes to its sides.
//
// The corners run counter-clockwise, whatever they did before; the last is joined to the first. What lies on a side, to
// a millimetre, is inside. Questions cost time in proportion to the corners. Thread: pure.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "actors/domain/geo/local_projection.hpp"
#include "actors/domain/geo/plane.hpp"

namespace godwit::geo {

class flat_polygon {
public:
  // At least three corners.
  explicit flat_polygon(std::vector<local_point> corners);
  flat_polygon(std::span<const point> corners, const local_projection& projection);

  [[nodiscard]] std::span<const local_point> corners() const { return corners_; }
  [[nodiscard]] segment side(std::size_t i) const { return {corners_[i], corners_[(i + 1) % corners_.size()]}; }

  [[nodiscard]] bool contains(const local_point& at) const;
  // To the nearest side, from within or without; 0 when S crosses or touches one.
  [[nodiscard]] double distance_to_sides_m(const segment& s) const;
  [[nodiscard]] double distance_to_sides_m(const local_point& at) const { return distance_to_sides_m({at, at}); }

  // Whether S comes nearer to a side than MARGIN, from within or without.
  [[nodiscard]] bool has_sides_within(double margin_m, const segment& s) const;

  // Whether any of S lies inside.
  [[nodiscard]] bool touches(const segment& s) const { return contains(s.from) || has_sides_within(edge_width_m, s); }

  // Inside, and no nearer than MARGIN to a side.
  [[nodiscard]] bool contains_with_margin(const local_point& at, double margin_m) const;
  // Between two neighbouring shares, contains_with_margin has the same answer all along S. Appended without order.
  void add_turning_shares(const segment& s, double margin_m, std::vector<double>& shares) const;

private:
  // Of the whole polygon.
  [[nodiscard]] bool is_farther_than(double margin_m, const segment& s) const;

  std::vector<local_point> corners_;
  local_point low_;
  local_point high_;
};

} // namespace godwit::geo
