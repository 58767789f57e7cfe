#include "actors/scan_controller/point.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

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

double priority_of(const point& what, const std::optional<geo::point>& vehicle, std::int64_t now_ns) {
  const auto age_ns = static_cast<double>(std::max<std::int64_t>(now_ns - what.seen_ns, 0));
  const double freshness = half_freshness_ns / (half_freshness_ns + age_ns);
  const geo::point there{what.position.latitude_deg, what.position.longitude_deg};
  const double nearness = vehicle ? half_nearness_m / (half_nearness_m + geo::distance_m(*vehicle, there)) : 1;
  return what.confidence * nearness * freshness * (what.has_moved ? 1 : standing_worth);
}

bool goes_before(const ranked& a, const ranked& b) {
  return std::tuple(!a.is_above, -a.priority, a.number) < std::tuple(!b.is_above, -b.priority, b.number);
}

} // namespace godwit::scan_controller
