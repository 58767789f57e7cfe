// Which word of an operator a station's order is: DO_REPOSITION and DO_PAUSE_CONTINUE.
//
// Asked in this order, the first that applies decides:
//
//   DO_PAUSE_CONTINUE with 0, 1, anything else            pause, resume, DENIED
//   DO_REPOSITION
//     as COMMAND_LONG                                     COMMAND_INT_ONLY: a float is off by about a metre
//     a frame that is not 0, 3, 5 or 6                    UNSUPPORTED_MAV_FRAME; the height of the terrain is not known
//     a speed that is not -1 or NaN                       DENIED: a command changes no speed
//     a radius or a yaw that is not 0 or NaN              DENIED: nor these
//     a place that is absent or not on earth              DENIED
//     an altitude that is not finite                      DENIED
//     above the sea (0, 5), and home's altitude unknown   TEMPORARILY_REJECTED
//     otherwise                                           go_to
//
// The flags of DO_REPOSITION are not looked at: the executor chooses the mode. Each refusal has a sentence for people,
// short enough for one STATUSTEXT (50 characters). Thread: pure. Source: MAV_CMD_DO_REPOSITION (192),
// MAV_CMD_DO_PAUSE_CONTINUE (193).
#pragma once

#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "actors/ground_port/vehicle_role/order.hpp"
#include "messages/operator/types.hpp"

namespace godwit::ground_port {

namespace mavlink = io::mavlink;

struct word_refusal {
  mavlink::mav_result result = mavlink::mav_result::denied;
  std::string text;
};

// HOME_ALTITUDE_M: above mean sea level; none: the vehicle has not told it. WHAT is one of the two commands.
[[nodiscard]] tl::expected<operators::command, word_refusal> read_word(const vehicle_role::order& what,
                                                                       std::optional<double> home_altitude_m);

// Without what else the command needs.
[[nodiscard]] operators::command said_by(const vehicle_role::order& what, operators::command_kind which);

// What is said about the order begins with this: "Go to", "Pause", "Continue".
[[nodiscard]] std::string name_for_people(const vehicle_role::order& what);

} // namespace godwit::ground_port
