// Whether the places of a mission lie where this vehicle may be sent: near enough to home, and not too high above it.
//
// The same for each way on which a mission, a part of one or a single place comes: a file, a service, a ground station,
// an operator. What it protects from is a mission of another place, one with latitude and longitude swapped, and
// heights above the sea that are taken for heights above home. A rover has no heights. Distances are the shortest ways
// over the ellipsoid, also across the antimeridian. Pure. Thread: any.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "actors/domain/geo/point.hpp"
#include "messages/flight/vehicle_class.hpp"
#include "messages/mission/document.hpp"

namespace godwit::mission {

struct place_limits {
  double max_distance_m = 50'000; // from home, over the ground
  double max_altitude_m = 1'000;  // above home
};

// What the places are compared with.
struct limits_origin {
  geo::point home;
  double home_altitude_m = 0; // above the place from which the mission counts altitudes
  flight::vehicle_class vehicle = flight::vehicle_class::unknown;
  std::optional<double> home_above_sea_m{}; // absent: heights above the sea are not compared
};

inline constexpr std::size_t max_places_out_of_limits = 32; // of one mission: more than anyone reads

// From item FIRST on, one sentence each: "Item 3 'w2' is 5,650 km south-east of home; at most 50 km are allowed
// (flight.max_distance_m); with latitude and longitude swapped it would be 140 m away." Items are counted from 1.
// Empty: all keep to the limits.
[[nodiscard]] std::vector<std::string> places_out_of_limits(const document& mission, std::size_t first,
                                                            const limits_origin& origin, const place_limits& limits);

// The same for one place; WHAT begins the sentence. Empty: it keeps to the limits.
[[nodiscard]] std::string why_out_of_limits(const std::string& what, const position& at, const limits_origin& origin,
                                            const place_limits& limits);

} // namespace godwit::mission
