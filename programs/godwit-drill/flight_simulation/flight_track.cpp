#include "programs/godwit-drill/flight_simulation/flight_track.hpp"

#include <algorithm>

#include "actors/domain/geo/geodesic.hpp"

namespace godwit::drill {

void flight_track::look(const sim::vehicle& vehicle, std::int64_t now_ns) {
  next_look_ns_ = now_ns + look_every_ns;
  const auto seen = vehicle.describe().where;
  const bool stands = !places_.empty() && places_.back().latitude_deg == seen.latitude_deg &&
                      places_.back().longitude_deg == seen.longitude_deg;
  if (!stands)
    places_.push_back({now_ns, seen.latitude_deg, seen.longitude_deg});
}

bool flight_track::was_near(const mission::position& where, double metres, std::int64_t upto_ns) const {
  return std::ranges::any_of(places_, [&](const place& each) {
    return each.at_ns <= upto_ns && geo::distance_m(geo::point{each.latitude_deg, each.longitude_deg},
                                                    geo::point{where.latitude, where.longitude}) <= metres;
  });
}

} // namespace godwit::drill
