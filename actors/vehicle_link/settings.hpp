// What can be set about the link to the vehicle. Each has the default that suits a companion computer.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "actors/vehicle_link/message_allowlist.hpp"
#include "actors/vehicle_link/stream_keeper.hpp"
#include "actors/vehicle_link/vehicle_watch.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::vehicle_link {

// As whom we speak. Posing as a ground station (another system id, type 6) is possible and never the default: the
// autopilot would take our heartbeat for the human's, and not see that the human's link is lost. ArduPilot counts
// heartbeats for its ground-station failsafe from one configured system id only.
struct identity {
  std::uint8_t system = 0; // 0: the vehicle's own; 1 until the vehicle is known
  std::uint8_t component = static_cast<std::uint8_t>(mavlink::mav_component::onboard_computer);
  std::uint8_t type = static_cast<std::uint8_t>(mavlink::mav_type::onboard_controller);
};

inline constexpr identity ground_station_identity{255,
                                                  static_cast<std::uint8_t>(mavlink::mav_component::missionplanner),
                                                  static_cast<std::uint8_t>(mavlink::mav_type::gcs)};

// What godwit needs to know of a flight, at rates that a 57600 baud line carries beside a mission transfer.
[[nodiscard]] std::vector<wanted_stream> default_streams();
// The same, and what ground stations are promised besides (ground_port's default_rates).
[[nodiscard]] std::vector<wanted_stream> streams_for_stations();

struct settings {
  identity as;
  watch_settings watch;
  std::vector<wanted_stream> streams = default_streams();
  std::int64_t heartbeat_ms = 1'000;
  std::int64_t command_timeout_ms = 1'000;
  std::vector<std::string> deciders;   // the actors that must live for our heartbeat to go out; none: it always does
  std::int64_t alive_lasts_ms = 3'000; // since one of them has begun or answered a ping
  bool relays = false;   // what the vehicle's components say is told to listeners as it came (relay_gate.hpp)
  std::string open_line; // why anybody can speak on it, as a sentence for people; empty: not anybody can
};

} // namespace godwit::vehicle_link
