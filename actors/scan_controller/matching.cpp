#include "actors/scan_controller/matching.hpp"

#include <cmath>

#include "actors/domain/geo/geodesic.hpp"

namespace godwit::scan_controller {
namespace {

// A degree of latitude is nowhere shorter: what lies farther apart in latitude is not near, and is not measured.
constexpr double least_m_of_degree = 110'500;

} // namespace

bool is_about(const candidate& seen, const point& known, double within_m) {
  if (seen.class_group != known.class_group)
    return false;
  if (seen.object_id && seen.object_id == known.object_id)
    return true;
  const auto& here = seen.position;
  const auto& there = known.position;
  if (std::abs(here.latitude_deg - there.latitude_deg) * least_m_of_degree > within_m)
    return false;
  return geo::distance_m({here.latitude_deg, here.longitude_deg}, {there.latitude_deg, there.longitude_deg}) <=
         within_m;
}

} // namespace godwit::scan_controller
