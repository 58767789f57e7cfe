// Whether there is a flight, and whether the vehicle is in the air just now: failsafes act only there.
//
//   on the ground ──armed and in the air──> in flight ──disarmed, or for 2 s on the ground──> on the ground
//   standing      ──armed and moving──────> in flight ──disarmed──────────────────────────> standing    (rover)
//
// A landing detector can flicker: one message that says "on the ground" stops all action at once, and does not end the
// flight. One that flickers for longer, as a real PX4 was seen to touch down (on the ground, landing, on the ground, a
// second apart), has the vehicle bounce: it begins a flight again that it has not been disarmed after. A rover that has
// stopped is still on its way, but there is nothing to stop any more. While no heartbeat comes nothing is known, and so
// nothing changes. Monotonic nanoseconds. Thread: pure.
#pragma once

#include <cstdint>
#include <optional>

#include "actors/failsafe/events.hpp"

namespace godwit::failsafe {

// Five heartbeats of an autopilot, which sends one a second.
inline constexpr std::int64_t vehicle_lost_ms = 5'000;
// Landing detectors were seen to say "on the ground" for one or two messages, a second apart, in a gust.
inline constexpr std::int64_t ground_settle_ms = 2'000;
// After that it may still be said to be in the air once more.
inline constexpr std::int64_t bounces_within_ms = 3'000;

struct flight_now {
  bool link_up = false; // the autopilot is heard
  bool in_flight = false;
  bool may_act = false;      // in the air, or a rover that moves
  bool near_ground = false;  // takes off or lands
  bool begins = false;       // with this tick
  bool is_found = false;     // begins, and this incarnation has never seen it on the ground
  bool is_bounce = false;    // begins, and the one before has just ended without a disarm
  bool ends = false;         // with this tick
  bool landed_known = false; // or of no interest
};

class flight_watch {
public:
  flight_watch(bool in_flight, double moving_mps) : in_flight_(in_flight), moving_mps_(moving_mps) {}

  void on_heartbeat(vehicle_class what, bool armed, std::int64_t now_ns);
  void on_landed(landed_state how) { landed_ = how; }
  void on_speed(double mps);

  [[nodiscard]] flight_now evaluate(std::int64_t now_ns);

private:
  [[nodiscard]] bool is_in_the_air() const;
  [[nodiscard]] bool is_down(std::int64_t now_ns);

  bool in_flight_ = false;
  double moving_mps_ = 0;
  vehicle_class what_ = vehicle_class::unknown;
  bool armed_ = false;
  std::optional<std::int64_t> heartbeat_ns_;
  landed_state landed_ = landed_state::unknown;
  double speed_mps_ = 0;
  std::optional<std::int64_t> ground_since_ns_;
  bool was_down_ = false;                      // seen by this incarnation
  std::optional<std::int64_t> ended_armed_ns_; // the flight before, and it was armed ever since
};

} // namespace godwit::failsafe
