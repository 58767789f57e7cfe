// What can be set about a port for ground stations. Each has the default that suits one radio to one operator.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/domain/mission/commands/command_policy.hpp"
#include "actors/ground_port/forward_gate.hpp"
#include "actors/ground_port/mission_server/server_profile.hpp"
#include "io/mavlink/enums.hpp"
#include "messages/operator/principal.hpp"

namespace godwit::ground_port {

// As whom the port speaks: a component of the vehicle's system. Component 1 stands in for the autopilot, for stations
// that speak only to that one. It is possible only where the autopilot's own 1 is not heard: else there would be two.
struct identity {
  std::uint8_t system = 1; // the vehicle's
  std::uint8_t component = static_cast<std::uint8_t>(mavlink::mav_component::onboard_computer);
};

// Position and attitude four times a second, as a map needs them; the rest as it comes.
[[nodiscard]] std::vector<forward_rate> default_rates();

// A plan is one row of the journal: this many items are 1 MB of it.
inline constexpr int max_plan_items = 5'000;

struct settings {
  identity as;
  // The composition knows that the autopilot is on the same line, because both links have the same address.
  bool autopilot_is_on_this_line = false;
  bool forwards_telemetry = true;
  bool passes = false; // what is on the lists of passing/table.hpp goes on to the vehicle, and what it says comes back
  std::vector<std::string> also_passes; // names of what is passed by setting only
  std::vector<forward_rate> rates = default_rates();
  std::int64_t heartbeat_ms = 1'000;
  // Of a station until it is the operator's link, and of an autopilot until godwit no longer stands in for it. More
  // than one where anybody can speak: a forged heartbeat must begin nothing.
  int heartbeats_to_begin = 1;
  std::string open_line; // why anybody can speak on it, as a sentence for people; empty: not anybody can
  std::optional<operators::role> stations_are = {}; // beside operators; none: there are none
  int max_items = 1'000;                            // of one plan; more is answered with NO_SPACE
  mission::allowed_commands allowed_commands = {};  // flight.allowed_commands
};

// Why SETTINGS can not be used, as a sentence for people; nothing: they can.
[[nodiscard]] std::optional<std::string> objection_to(const settings& given);

[[nodiscard]] inline bool stands_in_for_autopilot(const identity& as) {
  return as.component == mavlink::number(mavlink::mav_component::autopilot1);
}

} // namespace godwit::ground_port
