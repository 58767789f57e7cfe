// The aircraft that were heard of within the last minute: at most max_aircraft, those next to our vehicle.
//
//   ADSB_VEHICLE ──take──> one for each address, the newest report of it ──no report for forgotten_after_ns──> gone
//
// Nothing of it is durable: it fills again within seconds. Times: monotonic nanoseconds. Pure. Thread: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "actors/domain/traffic/traffic.hpp"

namespace godwit::traffic {

class sky {
public:
  static constexpr std::size_t max_aircraft = 64;
  static constexpr std::int64_t forgotten_after_ns = 60'000'000'000; // an aircraft is elsewhere by then

  // HERE: where our vehicle is; absent, the one that was not heard of for longest makes room.
  void take(const io::mavlink::adsb_vehicle& m, const std::optional<geo::point>& here, std::int64_t now_ns);
  void forget_old(std::int64_t now_ns);

  [[nodiscard]] const std::vector<aircraft>& all() const { return all_; } // in no order
  [[nodiscard]] std::uint64_t without_place() const { return without_place_; }
  [[nodiscard]] std::uint64_t without_room() const { return without_room_; } // farther away than those that are kept

private:
  std::vector<aircraft> all_;
  std::uint64_t without_place_ = 0;
  std::uint64_t without_room_ = 0;
};

} // namespace godwit::traffic
