#include "actors/domain/route/route.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/domain/geofence/fence.hpp"
#include "actors/domain/geofence/fence_name.hpp"
#include "actors/domain/route/corner_points.hpp"
#include "actors/domain/route/shortest_path.hpp"

namespace godwit::route {

namespace {

using failure = tl::unexpected<route_error>;

failure failed(route_errc code, std::string reason, std::optional<std::size_t> fence = std::nullopt) {
  return failure({code, std::move(reason), fence});
}

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f m", value);
  return text;
}

// "The destination ..."
std::string sentence_for(const std::string& who, const obstruction& what, double margin_m) {
  if (what.fence && what.distance_m <= 0)
    return who + " lies inside " + geofence::fence_name(*what.fence) + ", which excludes it.";
  if (what.fence)
    return who + " is " + metres(what.distance_m) + " from " + geofence::fence_name(*what.fence) + "; keep " +
           metres(margin_m) + " away from it.";
  if (what.distance_m <= 0)
    return who + " lies outside of all inclusion fences.";
  return who + " is " + metres(what.distance_m) + " from the edge of the inclusion fences; keep " + metres(margin_m) +
         " away from it.";
}

std::optional<route_error> what_is_wrong(const route_request& request, std::span<const mission::geofence> fences) {
  const auto error = [](route_errc code, std::string reason) { return route_error{code, std::move(reason), {}}; };
  const auto& altitudes = request.altitudes;
  if (!geo::is_valid(request.from) || !geo::is_valid(request.to))
    return error(route_errc::wrong_request, "A route begins and ends on Earth.");
  if (!(request.margin_m >= min_margin_m && request.margin_m <= max_margin_m))
    return error(route_errc::wrong_request, "The margin to the fences is " + metres(request.margin_m) +
                                                "; it can be from " + metres(min_margin_m) + " to " +
                                                metres(max_margin_m) + ".");
  if (!(request.turn_room_m >= 0 && request.turn_room_m <= max_margin_m))
    return error(route_errc::wrong_request, "The room to turn is " + metres(request.turn_room_m) +
                                                "; it can be up to " + metres(max_margin_m) + ".");
  if (!(std::isfinite(altitudes.lowest_m) && altitudes.highest_m >= altitudes.lowest_m))
    return error(route_errc::wrong_request, "The altitudes of a route run from the lowest to the highest.");
  const double distance = geo::distance_m(request.from, request.to);
  if (distance > max_route_m)
    return error(route_errc::too_far,
                 "The destination is " + metres(distance) + " away; the farthest is " + metres(max_route_m) + ".");
  std::size_t corners = 0;
  for (const auto& each : fences)
    if (geofence::altitudes_of(each).meets(altitudes))
      corners += each.vertices.size();
  if (corners > max_corners)
    return error(route_errc::too_many_corners, "The fences have " + std::to_string(corners) +
                                                   " corners; a route may have at most " + std::to_string(max_corners) +
                                                   ".");
  return std::nullopt;
}

std::optional<route_error> what_blocks(const clear_space& space, const local_point& start, const local_point& end) {
  if (space.is_empty())
    return route_error{route_errc::no_fence_there, "No inclusion fence reaches over the altitudes of the flight.",
                       std::nullopt};
  if (const auto found = space.obstruction_at_without_margin(start))
    return route_error{route_errc::start_is_blocked, sentence_for("The vehicle", *found, space.margin_m()),
                       found->fence};
  if (const auto found = space.obstruction_at(end))
    return route_error{route_errc::end_is_blocked, sentence_for("The destination", *found, space.margin_m()),
                       found->fence};
  return std::nullopt;
}

// Who turns early at CORNER flies to the end from somewhere within the room to turn, and keeps the margin all the way.
bool is_clear_from_around(const clear_space& space, const local_point& corner, double room_m, const local_point& end) {
  constexpr int places_around = 32; // what they leave out of the circle is half a per cent of the room
  const auto at = [&](int i) {
    const double angle = 2 * std::numbers::pi * i / places_around;
    return corner + room_m * local_point{std::cos(angle), std::sin(angle)};
  };
  for (int i = 0; room_m > 0 && i < places_around; ++i)
    if (!space.is_clear({at(i), end}))
      return false;
  return space.is_clear({corner, end});
}

// START and END are places 0 and 1, the corners follow. SPACE keeps the margin, and ROOMY the room to turn as well.
tl::expected<std::vector<local_point>, route_error> flat_route(const clear_space& space, const clear_space& roomy,
                                                               const local_point& start, const local_point& end) {
  if (space.is_clear_from_here({start, end}))
    return std::vector{start, end};
  auto corners = corner_points(roomy);
  if (corners.size() > max_points)
    return failed(route_errc::too_many_corners, "The corners of the fences give " + std::to_string(corners.size()) +
                                                    " turning points; a route may have at most " +
                                                    std::to_string(max_points) + ".");
  std::vector<local_point> places{start, end};
  places.insert(places.end(), corners.begin(), corners.end());
  const auto can_see = [&](std::size_t from, std::size_t to) {
    if (from == 0)
      return space.is_clear_from_here({places[from], places[to]});
    if (to == 1) // at the end there is nothing to turn for
      return is_clear_from_around(space, places[from], roomy.margin_m() - space.margin_m(), places[to]);
    return roomy.is_clear({places[from], places[to]});
  };
  const auto path = shortest_path(places, 0, 1, can_see);
  if (path.empty())
    return failed(route_errc::no_way, "There is no way to the destination that keeps " + metres(space.margin_m()) +
                                          " away from the fences.");
  std::vector<local_point> result;
  for (const auto i : path)
    result.push_back(places[i]);
  return result;
}

} // namespace

tl::expected<route, route_error> find_route(const route_request& request, std::span<const mission::geofence> fences) {
  if (auto wrong = what_is_wrong(request, fences))
    return failure(*std::move(wrong));
  const geo::local_projection projection(request.from);
  const clear_space space(fences, projection, request.altitudes, request.margin_m);
  const clear_space roomy(fences, projection, request.altitudes, request.margin_m + request.turn_room_m);
  const auto end = projection.to_local(request.to);
  if (auto blocked = what_blocks(space, {}, end))
    return failure(*std::move(blocked));
  const auto flat = flat_route(space, roomy, {}, end);
  if (!flat)
    return failure(flat.error());
  route found{{request.from}, 0};
  for (std::size_t i = 1; i + 1 < flat->size(); ++i)
    found.points.push_back(projection.to_globe((*flat)[i]));
  found.points.push_back(request.to);
  for (std::size_t i = 1; i < found.points.size(); ++i)
    found.length_m += geo::distance_m(found.points[i - 1], found.points[i]);
  return found;
}

} // namespace godwit::route
