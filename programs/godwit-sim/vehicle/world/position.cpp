#include "programs/godwit-sim/vehicle/world/position.hpp"

#include <GeographicLib/Geodesic.hpp>

#include "programs/godwit-sim/vehicle/world/angle.hpp"

namespace godwit::sim {

course between(const position& from, const position& to) {
  course found;
  double arrival_deg = 0;
  GeographicLib::Geodesic::WGS84().Inverse(from.latitude_deg, from.longitude_deg, to.latitude_deg, to.longitude_deg,
                                           found.distance_m, found.bearing_deg, arrival_deg);
  found.bearing_deg = found.distance_m > 0 ? heading_of(found.bearing_deg) : 0;
  return found;
}

position moved(const position& from, const course& by) {
  position to = from;
  GeographicLib::Geodesic::WGS84().Direct(from.latitude_deg, from.longitude_deg, by.bearing_deg, by.distance_m,
                                          to.latitude_deg, to.longitude_deg);
  return to;
}

} // namespace godwit::sim
