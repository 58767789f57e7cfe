#include "actors/domain/traffic/sky.hpp"

#include <algorithm>
#include <utility>

#include "actors/domain/geo/geodesic.hpp"

namespace godwit::traffic {

// Receiver and autopilot may both report one, the second of them late.
void sky::take(const io::mavlink::adsb_vehicle& m, const std::optional<geo::point>& here, std::int64_t now_ns) {
  auto found = aircraft_of(m, now_ns);
  if (!found) {
    ++without_place_;
    return;
  }
  const auto known = std::ranges::find(all_, found->icao, &aircraft::icao);
  if (known == all_.end())
    all_.push_back(*std::move(found));
  else if (found->seen_ns >= known->seen_ns)
    *known = *std::move(found);
  forget_old(now_ns);
  if (all_.size() <= max_aircraft)
    return;
  ++without_room_;
  all_.erase(std::ranges::max_element(all_, {}, [&](const aircraft& each) {
    return here ? geo::distance_m(*here, each.at) : -static_cast<double>(each.seen_ns);
  }));
}

void sky::forget_old(std::int64_t now_ns) {
  std::erase_if(all_, [&](const aircraft& each) { return now_ns - each.seen_ns >= forgotten_after_ns; });
}

} // namespace godwit::traffic
