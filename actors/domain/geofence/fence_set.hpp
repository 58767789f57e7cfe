// Whether a place, or the straight way between two, keeps to all fences of a mission: inside at least one that keeps
// in, where there are any, and inside none that keeps out. Before a flight, on routes and in flight alike.
//
// A way is judged as a whole: between two positions a fast vehicle can cut a corner that neither of them lies in. What
// was flown has one altitude at each point of the way (`breach_on`); of what is only planned all altitudes from one end
// to the other count on the whole of it, because vehicles climb differently (`excludes`, `leaves_inclusions_at`).
// A place is a way of no length. Why each rule is as it is: docs/decisions/plans.md. Thread: pure.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "actors/domain/geofence/fence.hpp"
#include "actors/domain/geofence/place.hpp"

namespace godwit::geofence {

// As many as the contract of the missions service allows.
inline constexpr std::size_t max_fences = 100;

struct breach {
  std::optional<std::size_t> exclusion; // its index; absent: outside of all inclusions

  // "it is in geofence 2, which excludes it"
  [[nodiscard]] std::string sentence() const;
  friend bool operator==(const breach&, const breach&) = default;
};

class fence_set {
public:
  // No fences: nothing is ever breached. An error names the fence and what is wrong with it.
  [[nodiscard]] static tl::expected<fence_set, std::string> build(const std::vector<mission::geofence>& from);

  [[nodiscard]] std::size_t size() const { return fences_.size(); }
  [[nodiscard]] const fence& operator[](std::size_t index) const { return fences_[index]; }

  // Without FLOOR_COUNTS the fences that keep in have no floor.
  [[nodiscard]] std::optional<breach> breach_on(const place& from, const place& to, bool floor_counts = true) const;
  [[nodiscard]] std::optional<breach> breach_at(const place& there, bool floor_counts = true) const {
    return breach_on(there, there, floor_counts);
  }

  // Whether fence INDEX keeps out and has a part in the way at these altitudes.
  [[nodiscard]] bool excludes(std::size_t index, const geo::point& from, const geo::point& to,
                              const altitude_band& altitudes) const;
  // The share of the way at which the inclusions end that reach over all of the altitudes; nothing: nowhere, or there
  // are no inclusions.
  [[nodiscard]] std::optional<double> leaves_inclusions_at(const geo::point& from, const geo::point& to,
                                                           const altitude_band& altitudes) const;

private:
  std::vector<fence> fences_;
  bool has_inclusions_ = false;
};

} // namespace godwit::geofence
