// Whether what is left in the battery lasts for a way: an estimate for people, on which nothing is flown.
//
//   percent left - reserve - drain x time of the way:   0 or less ──> short     5 or more ──> enough     between: as
//   before
//
// Time comes from paces that autopilots have when nobody has changed them, so that a head wind, a heavy load or a slow
// setting costs more than is said here; what is measured is the drain alone. Percent as in SYS_STATUS (-1: unknown),
// metres, seconds; time is monotonic nanoseconds. What is not finite or not known has no verdict. Thread: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "messages/flight/vehicle_class.hpp"

namespace godwit::energy {

// A way, as far as it takes time.
struct way {
  double horizontal_m = 0;
  double climb_m = 0;
  double descent_m = 0;
  bool is_landing = false; // at its end
  double wait_s = 0;       // at places on the way
};

struct pace {
  double cruise_mps = 5;
  double climb_mps = 2;
  double descent_mps = 1.5;
  double landing_s = 20;
};

// Copter and PX4: WPNAV_SPEED, MPC_XY_CRUISE 5 m/s; planes fly faster, rovers do not climb.
[[nodiscard]] pace pace_of(flight::vehicle_class what);

// None: what is not finite, or below 0.
[[nodiscard]] std::optional<double> seconds_for(const way& what, const pace& how_fast);

// From HEIGHT_M above home, DISTANCE_M away from it, by the height to which the vehicle climbs first.
[[nodiscard]] way straight_home(double distance_m, double height_m, double return_height_m);

// A gauge rises and falls by a point as the load changes: only its lows count, and the time between them.
inline constexpr std::size_t max_lows = 32;                     // the drain of the last so many points
inline constexpr std::size_t min_lows = 3;                      // two whole points between them
inline constexpr std::int64_t min_measured_ns = 20'000'000'000; // of flight
inline constexpr int max_jump_points = 20;                      // more is another battery, or a gauge that is lost
inline constexpr double max_percent_per_s = 100.0 / 60;         // an empty battery within a minute

class drain_meter {
public:
  // While the vehicle is under way.
  void on_sample(int percent, std::int64_t now_ns);
  // Measured from now on; what was measured before is forgotten.
  void begin() { *this = {}; }
  [[nodiscard]] std::optional<double> percent_per_s() const;

private:
  struct low {
    int percent = 0;
    std::int64_t at_ns = 0;
  };
  std::deque<low> lows_;
  std::optional<low> first_; // not low yet: how much of its point was gone is not known
};

// What is left above RESERVE when the way is done; none: not known.
[[nodiscard]] std::optional<double> spare_percent(int percent, int reserve_percent, const std::optional<double>& drain,
                                                  const std::optional<double>& seconds);

inline constexpr double enough_percent = 5; // so much to spare ends a warning

// Warns once when it gets short.
class shortage_watch {
public:
  // True: it has just become short. Not known: it stays as it is.
  [[nodiscard]] bool becomes_short(const std::optional<double>& spare_percent);
  void begin() { is_short_ = false; }
  [[nodiscard]] bool is_short() const { return is_short_; }

private:
  bool is_short_ = false;
};

} // namespace godwit::energy
