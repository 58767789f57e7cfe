// The places at which a vehicle turns that an operator sends around the fences: by goto, cancel and come-home alike.
//
// What is promised (flight.fence_margin_m) holds for the track that is flown: a multirotor or a rover turns up to
// turn_accept_radius_m before a corner, wind and control add to it, and turn_room_m is what the route allows for both.
// A fixed wing turns on its circle. A rover keeps to all fences whatever their altitudes. Pure; thread: plain values.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "actors/domain/geo/point.hpp"
#include "messages/flight/vehicle_class.hpp"
#include "messages/mission/document.hpp"

namespace godwit::executor {

// PX4 turns within the radius of the item, an ArduPilot multirotor or rover within its own of 2 m (WP_RADIUS).
inline constexpr double turn_accept_radius_m = 2;
inline constexpr double turn_room_m = 5;

struct way_request {
  mission::position from;
  mission::position to;
  double lowest_m = 0; // between which altitudes it flies
  double highest_m = 0;
  flight::vehicle_class vehicle = flight::vehicle_class::unknown;
  double margin_m = 10;
  double own_loiter_radius_m = 80;
};

using turns_or_reason = tl::expected<std::vector<geo::point>, std::string>;

// None: the straight way keeps the margin. The error is a sentence for people.
[[nodiscard]] turns_or_reason turns_between(const way_request& trip, const std::vector<mission::geofence>& fences);

// The same; where there is no way with the whole margin, one with less of it is better than a way through a fence.
[[nodiscard]] turns_or_reason turns_home(const way_request& trip, const std::vector<mission::geofence>& fences);

[[nodiscard]] mission::waypoint turn_at(const geo::point& place, double altitude_m, std::string id,
                                        flight::vehicle_class vehicle);

} // namespace godwit::executor
