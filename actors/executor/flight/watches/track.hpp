// Where the vehicle was: what a report of a reached place is held against.
//
// A place is contradicted where the vehicle can not have been within what it takes for arriving, and a margin, since
// the place before was left: on the straight between two positions, or in a gap between them, in which it may have gone
// fastest_mps. A place that it only seems to have passed has the smaller margin: nobody else says that it was there.
// Without positions from before nothing is contradicted. Volatile: after a restart it begins anew. Distances in metres,
// times monotonic nanoseconds. Pure. Thread: one at a time. Source: GLOBAL_POSITION_INT (33).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "actors/domain/geo/point.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::executor {

class track {
public:
  static constexpr std::int64_t max_gap_ns = 1'500'000'000; // one position each second, and one that comes late
  static constexpr double fastest_mps = 25;                 // of what flies by missions, with the wind
  static constexpr double margin_m = 30;                    // errors of both positions, and a corner that is cut
  static constexpr double passed_margin_m = 15; // a corner that is cut: an autopilot judges by this position
  static constexpr double wing_margin_m = 150;  // a plane turns before the place

  // Another plan, or the same one anew. OWN_LOITER_RADIUS_M: where an item names none.
  void begin(const std::vector<io::mavlink::mission_item_int>& items, flight::vehicle_class vehicle,
             double own_loiter_radius_m, std::int64_t now_ns);
  void on_position(const geo::point& at, std::int64_t now_ns);
  // The vehicle has left the place before.
  void on_left(std::int64_t now_ns) { left_ns_ = now_ns; }

  // Of the places from FIRST up to and with LAST, those that it was never near to. REACHED: the vehicle itself says
  // that it has come to that one; to the others it has come as far as its next place shows.
  [[nodiscard]] std::vector<std::uint16_t> never_near(std::uint16_t first, std::uint16_t last,
                                                      std::optional<std::uint16_t> reached = {}) const;
  // How near it may have been; none: SEQUENCE is no place, or there is no position yet.
  [[nodiscard]] std::optional<double> nearest_m(std::uint16_t sequence) const;

private:
  struct place {
    std::uint16_t sequence = 0;
    geo::point at;
    double arrives_m = 0; // so near, it takes it for reached
    double nearest_m = 0;
  };

  std::vector<place> places_; // by sequence
  bool is_wing_ = false;
  std::optional<geo::point> last_;
  std::int64_t last_ns_ = 0;
  std::int64_t first_ns_ = 0; // the first position of all
  std::int64_t left_ns_ = 0;  // when the place before was left, as far as this incarnation has seen it
};

} // namespace godwit::executor
