#include "actors/scan_controller/priority.hpp"

#include <algorithm>
#include <tuple>

#include "actors/domain/geo/geodesic.hpp"

namespace godwit::scan_controller {

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
