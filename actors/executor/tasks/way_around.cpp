#include "actors/executor/tasks/way_around.hpp"

#include <utility>

#include "actors/domain/route/route.hpp"

namespace godwit::executor {
namespace {

using flight::vehicle_class;

std::vector<mission::geofence> without_altitudes(std::vector<mission::geofence> fences) {
  for (auto& each : fences) {
    each.floor_m.reset();
    each.ceiling_m.reset();
  }
  return fences;
}

} // namespace

turns_or_reason turns_between(const way_request& trip, const std::vector<mission::geofence>& fences) {
  route::route_request request;
  request.from = {trip.from.latitude, trip.from.longitude};
  request.to = {trip.to.latitude, trip.to.longitude};
  request.altitudes = {trip.lowest_m, trip.highest_m};
  request.margin_m = trip.margin_m;
  request.turn_room_m = trip.vehicle == vehicle_class::fixed_wing ? trip.own_loiter_radius_m : turn_room_m;
  const auto way =
      route::find_route(request, trip.vehicle == vehicle_class::rover ? without_altitudes(fences) : fences);
  if (!way)
    return tl::make_unexpected(way.error().reason);
  return std::vector(way->points.begin() + 1, way->points.end() - 1);
}

turns_or_reason turns_home(const way_request& trip, const std::vector<mission::geofence>& fences) {
  auto narrower = trip;
  const auto whole = turns_between(trip, fences);
  if (whole)
    return whole;
  for (const double margin_m : {trip.margin_m / 2, trip.margin_m / 4, route::min_margin_m}) {
    narrower.margin_m = margin_m;
    if (auto found = turns_between(narrower, fences))
      return found;
  }
  return whole;
}

mission::waypoint turn_at(const geo::point& place, double altitude_m, std::string id, flight::vehicle_class vehicle) {
  mission::waypoint result;
  result.id = std::move(id);
  result.at = {place.latitude_deg, place.longitude_deg, altitude_m};
  result.accept_radius_m = vehicle == vehicle_class::fixed_wing ? 0 : turn_accept_radius_m;
  return result;
}

} // namespace godwit::executor
