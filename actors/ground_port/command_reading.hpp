// Which word of an operator a station's order is: DO_REPOSITION and DO_PAUSE_CONTINUE.
//
// Asked in this order, the first that applies decides:
//
//   DO_PAUSE_CONTINUE with 0, 1, anything else            pause, resume, DENIED
//   DO_REPOSITION
//     as COMMAND_LONG, an ArduPilot                       UNSUPPORTED, as it answers itself
//     as COMMAND_LONG, any other but a PX4                COMMAND_INT_ONLY: a float is off by about a metre
//     a PX4, neither place nor altitude                   pause: so QGroundControl pauses it
//     a PX4, no place, the altitude at which it is        pause: what QGroundControl sends after it when its slider of
//                                                         the altitude was left alone
//     a PX4, no place                                     go_to where it is, at this altitude
//     a PX4, no altitude                                  go_to there at the altitude that it has
//     a frame that is not 0, 3, 5 or 6                    UNSUPPORTED_MAV_FRAME; the height of the terrain is not known
//     a speed that is not -1 or NaN                       DENIED: a command changes no speed
//     a radius or a yaw that is not 0 or NaN              DENIED: nor these
//     a place that is absent or not on earth              DENIED
//     an altitude that is not finite                      DENIED
//     above the sea (0, 5), and home's altitude unknown   TEMPORARILY_REJECTED
//     otherwise                                           go_to
//
// A PX4 counts the altitude of COMMAND_LONG above the sea. Absent is NaN, and in integers INT32_MAX. The flags of
// DO_REPOSITION are not looked at: the executor chooses the mode. Each refusal has a sentence for people,
// short enough for one STATUSTEXT (50 characters). Thread: pure. Source: MAV_CMD_DO_REPOSITION (192),
// MAV_CMD_DO_PAUSE_CONTINUE (193).
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "actors/ground_port/vehicle_role/order.hpp"
#include "io/mavlink/enums/vehicle.hpp"
#include "messages/mission/place.hpp"
#include "messages/operator/types.hpp"

namespace godwit::ground_port {

namespace mavlink = io::mavlink;

struct word_refusal {
  mavlink::mav_result result = mavlink::mav_result::denied;
  std::string text;
};

// What the vehicle has told, as far as an order is read by it.
struct told_by_vehicle {
  mavlink::mav_autopilot autopilot = mavlink::mav_autopilot::generic;
  std::optional<double> home_altitude_m = {}; // above mean sea level
  std::optional<mission::position> here = {}; // its altitude above home
  std::optional<double> held_from_m = {};     // the altitude above home at which a station asked for the last hold
};

// WHAT is one of the two commands.
[[nodiscard]] tl::expected<operators::command, word_refusal> read_word(const vehicle_role::order& what,
                                                                       const told_by_vehicle& told);

// A PX4 is to hold where it is. A vehicle that is about to hold still climbs or sinks: an altitude between that at
// which the hold was asked for and the present one is no other altitude, either.
[[nodiscard]] bool is_pause_by_reposition(const vehicle_role::order& what, const told_by_vehicle& told);

// Without what else the command needs.
[[nodiscard]] operators::command command_from(const vehicle_role::order& what, operators::command_kind which);

// What is said about the order begins with this: "Go to", "Pause", "Continue".
[[nodiscard]] std::string name_for_people(const vehicle_role::order& what);

// Integers that stations send as floats. Thread: pure.

// VALUE as an integer, if it is one from LEAST to MOST. Compared as floats, so that no conversion overflows.
[[nodiscard]] inline std::optional<std::int64_t> integer_in(float value, std::int64_t least, std::int64_t most) {
  if (!std::isfinite(value) || std::trunc(value) != value || value < static_cast<float>(least) ||
      value > static_cast<float>(most))
    return std::nullopt;
  return static_cast<std::int64_t>(value);
}

[[nodiscard]] inline std::optional<std::uint32_t> message_id_in(float value) {
  constexpr std::int64_t most = (1 << 24) - 1; // what a frame has room for, and a float holds exactly
  const auto id = integer_in(value, 0, most);
  return id ? std::optional(static_cast<std::uint32_t>(*id)) : std::nullopt;
}

} // namespace godwit::ground_port
