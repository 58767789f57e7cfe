#include "actors/domain/home/home.hpp"

#include <cmath>

#include "actors/domain/geo/geodesic.hpp"

namespace godwit::flight {

bool is_same_home(const home_place& one, const home_place& other) {
  const geo::point here{one.latitude, one.longitude};
  const geo::point there{other.latitude, other.longitude};
  return std::abs(one.above_sea_m - other.above_sea_m) <= same_home_height_within_m && geo::is_valid(here) &&
         geo::is_valid(there) && geo::distance_m(here, there) <= same_home_within_m;
}

double distance_m(const home_place& one, const home_place& other) {
  const geo::point here{one.latitude, one.longitude};
  const geo::point there{other.latitude, other.longitude};
  return geo::is_valid(here) && geo::is_valid(there) ? geo::distance_m(here, there) : 0;
}

bool is_moved(const home_place& now, const home_place& before) {
  return distance_m(now, before) > same_home_within_m ||
         std::abs(now.above_sea_m - before.above_sea_m) > moved_height_m;
}

home_place home_of_arming(const home_place& told, const std::optional<home_place>& before) {
  return before && is_moved(told, *before) ? *before : told;
}

} // namespace godwit::flight
