// What the vehicle tells about itself without being spoken to: each streamed message, made from the state of the world.
//
// Thread: one at a time. Source: the messages' definitions; values of fields that mean nothing here as recorded.
#pragma once

#include <cmath>
#include <cstdint>

#include "io/mavlink/frame_meaning.hpp"
#include "io/mavlink/messages.hpp"
#include "programs/godwit-sim/vehicle/autopilot/mode_table.hpp"
#include "programs/godwit-sim/vehicle/autopilot/names.hpp"
#include "programs/godwit-sim/vehicle/autopilot/outlet.hpp"
#include "programs/godwit-sim/vehicle/autopilot/traits.hpp"
#include "programs/godwit-sim/vehicle/autopilot/world_clock.hpp"
#include "programs/godwit-sim/vehicle/flight/flight.hpp"
#include "programs/godwit-sim/vehicle/world/battery.hpp"

namespace godwit::sim {

// How the autopilot is: what a HEARTBEAT tells and what follows from it. Thread: values.
struct condition {
  const flight_mode* mode = nullptr;
  const flight_mode* intended = nullptr; // by people; a failsafe of its own changes MODE alone
  bool is_armed = false;
  bool has_position = true; // from satellites
  bool is_booting = false;
  bool is_ready = true;        // has been up for as long as it needs before it flies
  bool has_estimate = true;    // its estimator knows where it is: some time after a start, and while it has a position
  bool is_plan_armable = true; // by its own checks
  bool is_battery_empty = false;
  bool is_home_fixed = false;        // by a command: arming moves it no longer
  bool beats_at_mode_change = false; // a HEARTBEAT at once, besides those of each second
  bool has_payload = false;          // a gripper, and a camera whose pictures it reports
  std::int32_t pictures = 0;         // since it started
  std::int64_t started_world_ns = 0; // its own clock is 0 then

  [[nodiscard]] bool is_in(mode_kind kind) const { return mode->kind == kind; }
  [[nodiscard]] std::int64_t up_ns(std::int64_t world_ns) const { return world_ns - started_world_ns; }
};

class telemetry {
public:
  // All of them outlive it.
  telemetry(const traits& vehicle_traits, const flight& craft, const battery& power, const condition& state,
            outlet& out)
      : traits_(vehicle_traits), craft_(craft), power_(power), state_(state), out_(out) {}

  // False: no such message is known here. One that can not be told now, a position that is not known for example, is
  // known and not sent.
  [[nodiscard]] bool send(std::uint32_t id, std::int64_t world_ns);
  [[nodiscard]] bool knows(std::uint32_t id) const;

  [[nodiscard]] mavlink::mav_landed_state landed_state() const;
  // Satellites were lost at this place.
  void freeze_position(const position& where) { frozen_ = where; }
  void restart() { pings_ = 0; }

private:
  [[nodiscard]] mavlink::heartbeat beat() const;
  [[nodiscard]] mavlink::sys_status status() const;
  [[nodiscard]] mavlink::gps_raw_int satellites(std::int64_t up_ns) const;
  [[nodiscard]] mavlink::global_position_int place(std::int64_t up_ns) const;
  [[nodiscard]] mavlink::attitude angles(std::int64_t up_ns) const;
  [[nodiscard]] mavlink::vfr_hud hud() const;
  [[nodiscard]] mavlink::battery_status charge() const;
  [[nodiscard]] mavlink::home_position home(std::int64_t up_ns) const;
  [[nodiscard]] mavlink::autopilot_version version() const;
  [[nodiscard]] std::uint16_t estimator_flags() const;
  [[nodiscard]] bool is_landing() const;

  const traits& traits_;
  const flight& craft_;
  const battery& power_;
  const condition& state_;
  outlet& out_;
  position frozen_;
  std::uint32_t pings_ = 0;
};

// Units of MAVLink's integers. Thread: pure.
[[nodiscard]] inline std::int32_t e7(double degrees) {
  return static_cast<std::int32_t>(std::lround(degrees * io::mavlink::units_of(io::mavlink::coordinate_kind::global)));
}

} // namespace godwit::sim
