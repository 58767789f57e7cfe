// A way from where the vehicle is to where it shall go that keeps clear of the fences, with a margin; or the reason why
// there is none.
//
//   fences ──> clear_space ──> corner_points ──┐
//   from, to ──────────────────────────────────┴──> who sees whom ──> shortest_path ──> route
//
// A vehicle cuts the corners of a route: it turns up to `turn_room_m` before each and flies straight to the next. So
// between two corners the way keeps the margin and that room, and on the last leg the margin holds for whoever comes to
// it from anywhere within that room of its beginning.
//
// All of it is reckoned in a local projection around the start (actors/domain/geo/local_projection.hpp). Straight there
// and straight on the ellipsoid differ by less than half a metre at 50 km, which is the farthest that is taken: the
// margin has room for that. The vehicle may start nearer to a fence than the margin, and then flies away from it; it is
// not led out of a fence that it has broken: what happens then is not for a route to decide. The altitude is the same
// all the way. The fences keep the rules of a mission. The work grows with the square of the places to turn at, each
// time with the corners; max_corners and max_points bound it. Thread: pure.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "actors/domain/geo/point.hpp"
#include "actors/domain/route/clear_space.hpp"
#include "messages/mission/document.hpp"

namespace godwit::route {

inline constexpr double min_margin_m = 0.5;     // less than positions are known to is no margin
inline constexpr double max_margin_m = 1'000;   // more leaves no way anywhere
inline constexpr double max_route_m = 50'000;   // as the crow flies: what the projection is good for
inline constexpr std::size_t max_corners = 512; // of all fences together that matter at the altitudes
inline constexpr std::size_t max_points = 1024; // at which a way may turn; sharp corners give several

struct route_request {
  geo::point from;
  geo::point to;
  altitude_band altitudes; // between which the vehicle flies
  double margin_m = 10;
  double turn_room_m = 0; // from 0 to max_margin_m
};

struct route {
  std::vector<geo::point> points; // from the start to the end, both included
  double length_m = 0;            // on the ellipsoid
};

enum class route_errc {
  wrong_request,    // a margin, a room to turn or a place that can not be
  too_far,          // beyond max_route_m
  too_many_corners, // beyond max_corners or max_points
  no_fence_there,   // no inclusion fence reaches over the altitudes
  start_is_blocked, // inside an exclusion, or outside of all inclusions
  end_is_blocked,   // the same, or nearer than the margin
  no_way            // both are clear, and fences lie between them all around
};

struct route_error {
  route_errc code{};
  std::string reason;               // a sentence for people
  std::optional<std::size_t> fence; // in the way: its place in the list
};

[[nodiscard]] tl::expected<route, route_error> find_route(const route_request& request,
                                                          std::span<const mission::geofence> fences);

} // namespace godwit::route
