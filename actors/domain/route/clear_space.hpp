// Where a vehicle may be at some altitudes: in at least one inclusion fence when there are any, and in no exclusion
// fence, with a margin to the sides of all of them.
//
// A fence with a floor or a ceiling is a block of air. An exclusion that begins above or ends below the altitudes is no
// obstacle; an inclusion that does not reach over all of them is no place to be. Several inclusions count together: a
// way may go from one into the next where they overlap by more than the margin. A vehicle that is nearer to a fence
// than the margin may fly away from it: on a way that begins there the margin to that fence is the distance it has.
// Thread: pure.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "actors/domain/geo/flat_polygon.hpp"
#include "actors/domain/geo/local_projection.hpp"
#include "actors/domain/geofence/altitude_band.hpp"
#include "messages/mission/document.hpp"

namespace godwit::route {

using geo::local_point;
using geo::segment;
using geofence::altitude_band;

// Of the document's fences.
struct flat_fence {
  std::size_t index = 0;
  geo::flat_polygon area;
};

// Why a vehicle may not be somewhere.
struct obstruction {
  std::optional<std::size_t> fence; // the nearest exclusion in the way; absent: outside of all inclusions, or too near
  double distance_m = 0;            // to its sides; 0 inside of it
};

class clear_space {
public:
  clear_space(std::span<const mission::geofence> fences, const geo::local_projection& projection,
              const altitude_band& altitudes, double margin_m);

  [[nodiscard]] std::span<const flat_fence> inclusions() const { return inclusions_; }
  [[nodiscard]] std::span<const flat_fence> exclusions() const { return exclusions_; }
  [[nodiscard]] double margin_m() const { return margin_m_; }
  // There are inclusion fences, and none for these altitudes: there is nowhere to be.
  [[nodiscard]] bool is_empty() const { return has_inclusions_ && inclusions_.empty(); }

  // Nothing: it is clear there, with the whole margin, or with none.
  [[nodiscard]] std::optional<obstruction> obstruction_at(const local_point& at) const;
  [[nodiscard]] std::optional<obstruction> obstruction_at_without_margin(const local_point& at) const;

  [[nodiscard]] bool is_clear(const segment& way) const;
  // The way begins where the vehicle is, which may be nearer to fences than the margin.
  [[nodiscard]] bool is_clear_from_here(const segment& way) const;

private:
  [[nodiscard]] std::optional<obstruction> obstruction_within(const local_point& at, double margin_m) const;
  [[nodiscard]] bool is_included(const segment& way, double margin_m) const;

  std::vector<flat_fence> inclusions_;
  std::vector<flat_fence> exclusions_;
  double margin_m_;
  bool has_inclusions_ = false;
};

} // namespace godwit::route
