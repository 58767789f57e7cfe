// What somebody who is not the vehicle may send under its name. Thread: pure.
#pragma once

#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages.hpp"
#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"

namespace godwit::drill {

// As the vehicle would show that a pilot flies it: a PX4 in POSCTL, or an ArduPilot in a mode that a pilot flies in.
[[nodiscard]] inline io::mavlink::heartbeat piloted(sim::personality who) {
  using namespace io::mavlink;
  heartbeat result;
  result.type = number(mav_type::quadrotor);
  result.autopilot = number(who == sim::personality::px4 ? mav_autopilot::px4 : mav_autopilot::ardupilotmega);
  result.base_mode = 0x81;
  result.custom_mode = pilot_mode(who);
  result.system_status = number(mav_state::active);
  return result;
}

// The n-th position of an autopilot that has just started.
[[nodiscard]] inline io::mavlink::global_position_int just_started(std::uint32_t n) { return {.time_boot_ms = 10 * n}; }

// Far outside of any fence.
[[nodiscard]] inline io::mavlink::global_position_int far_away() {
  return {.time_boot_ms = 900'000, .lat = 100'000'000, .lon = 100'000'000, .alt = 9'000'000, .relative_alt = 9'000'000};
}

} // namespace godwit::drill
