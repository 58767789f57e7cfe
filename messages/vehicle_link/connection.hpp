// How the link to the vehicle is: what health shows, and what others hear when it changes. Times in milliseconds.
// Thread: plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::vehicle_link {

//   down ──transport up──> silent ──heartbeat──> connected ──5 missed──> lost
//    ^                        ^                      ^                     │
//    └──────transport gone────┴──────────────────────┴─────heartbeat───────┘
enum class connection_phase {
  down,      // the transport is not open
  silent,    // open, and no autopilot was heard since
  connected, // its heartbeats come
  lost       // they stopped
};

GODWIT_ENUM_NAMES(connection_phase, down, silent, connected, lost);

struct get_connection {
  static constexpr auto fields = io::table("vehicle_link.get_connection");
};

// A number that only rises, under the name of what it counts.
struct named_count {
  std::string name;
  std::uint64_t count = 0;
  GODWIT_FIELDS(named_count, "vehicle_link.named_count", name, count);
};

// An autopilot, as it names itself in its frames.
struct vehicle_name {
  std::uint8_t system = 0;
  std::uint8_t component = 0;
  GODWIT_FIELDS(vehicle_name, "vehicle_link.vehicle_name", system, component);
  friend bool operator==(const vehicle_name&, const vehicle_name&) = default;
};

// The executor: a flight is open, and with it goes the vehicle that is flown; or none is. Repeated once a second.
struct keep_vehicle {
  bool is_kept = false;
  GODWIT_FIELDS(keep_vehicle, "vehicle_link.keep_vehicle", is_kept);
};

// Who else is on the line, and what raises a doubt about who the vehicle is. Told to listeners at each change.
struct line_findings {
  std::optional<vehicle_name> vehicle; // the one that is taken for ours
  std::vector<vehicle_name> others;    // autopilots heard of late that are not it; at most max_other_autopilots
  bool is_chosen = false;              // by its system id (vehicle.system): the others do not matter
  std::string twin; // why there are two under its name, as a sentence for people; empty: there are not
  GODWIT_FIELDS(line_findings, "vehicle_link.line_findings", vehicle, others, is_chosen, twin);
  friend bool operator==(const line_findings&, const line_findings&) = default;
};

inline constexpr std::size_t max_other_autopilots = 8;

struct connection {
  connection_phase phase = connection_phase::down;
  bool connected = false;
  std::string reason;                      // sentence for people; empty when all is well
  std::int64_t last_heartbeat_age_ms = -1; // -1: none yet
  std::uint8_t system = 0;                 // of the vehicle; 0: not known yet
  std::uint8_t autopilot = 0;              // MAV_AUTOPILOT
  std::uint8_t vehicle_type = 0;           // MAV_TYPE
  std::uint8_t tx_seq = 0;                 // of the next frame out
  std::uint8_t rx_seq = 0;                 // of the last frame of the autopilot
  bool signing_enabled = false;
  bool heartbeat_held_back = false; // an actor without which nobody is in charge does not live
  std::uint64_t frames_in = 0;      // good ones
  std::uint64_t frames_out = 0;
  std::uint64_t sequence_gaps = 0; // frames of the autopilot that did not arrive
  std::uint64_t parse_errors_total = 0;
  std::vector<named_count> parse_errors; // by cause
  std::vector<named_count> kind_errors;  // bad checksums by message kind
  std::uint64_t signed_in = 0;           // of the good frames, with our key
  std::uint64_t signing_rejected = 0;
  std::vector<named_count> signing_errors; // by cause
  std::uint64_t not_accepted = 0;          // good frames that are not on the list of what we take
  std::uint64_t relayed_to_vehicle = 0;    // frames of ground stations
  std::uint64_t relayed_to_stations = 0;   // frames of the vehicle's components
  std::uint64_t relays_dropped = 0;        // of ground stations, with no vehicle there
  std::uint64_t dropped_in = 0;            // bytes that came faster than they were read
  std::uint64_t dropped_out = 0;           // frames that the link had no room for
  std::uint64_t vehicle_restarts = 0;
  std::uint64_t late_heartbeats = 0;        // sent before one that had come already, and dropped
  std::uint64_t other_autopilots = 0;       // heartbeats of autopilots that are not the vehicle
  std::uint64_t under_its_name = 0;         // frames of the vehicle's name from another peer: not taken
  std::uint64_t orders_kept_back = 0;       // decided before the vehicle changed, or before the failsafe commanded it
  std::uint64_t reconnects = 0;             // of the transport
  std::vector<std::string> missing_streams; // wanted messages that do not come
  std::optional<vehicle_name> kept = {};    // of the flight that is open: no other one is taken
  line_findings line = {};
  std::uint64_t other_programs = 0; // heartbeats under the vehicle's name that are no autopilot's: not taken
  std::int64_t heard_for_ms = -1;   // without a gap in which somebody may have acted unnoticed; -1: in such a gap
  GODWIT_FIELDS(connection, "vehicle_link.connection", phase, connected, reason, last_heartbeat_age_ms, system,
                autopilot, vehicle_type, tx_seq, rx_seq, signing_enabled, heartbeat_held_back, frames_in, frames_out,
                sequence_gaps, parse_errors_total, parse_errors, kind_errors, signed_in, signing_rejected,
                signing_errors, not_accepted, relayed_to_vehicle, relayed_to_stations, relays_dropped, dropped_in,
                dropped_out, vehicle_restarts, late_heartbeats, other_autopilots, under_its_name, orders_kept_back,
                reconnects, missing_streams, kept, line, other_programs, heard_for_ms);
};

// How a reason begins when frames come and are not believed.
inline constexpr std::string_view refused_for_signature = "frames are refused for their signature";
// In a reason: what follows is heard in place of a vehicle.
inline constexpr std::string_view heard_instead = "; heard and not accepted: ";

// Told to listeners at each change of phase, and when it turns out why nothing is heard.
struct connection_changed {
  connection_phase phase = connection_phase::down;
  std::string reason;
  GODWIT_FIELDS(connection_changed, "vehicle_link.connection_changed", phase, reason);
};

// The autopilot's heartbeat is one of a boot, or its clock since boot went back: it started again. What it held in
// memory only is gone. Times: 0 where they are not known.
struct vehicle_restarted {
  std::uint32_t boot_ms_before = 0;
  std::uint32_t boot_ms_now = 0;
  GODWIT_FIELDS(vehicle_restarted, "vehicle_link.vehicle_restarted", boot_ms_before, boot_ms_now);
};

// Frames came that are signed wrongly, or not at all where they must be. Told at most once a second.
struct signing_alert {
  std::uint64_t rejected = 0; // since the start
  std::string reason;
  GODWIT_FIELDS(signing_alert, "vehicle_link.signing_alert", rejected, reason);
};

} // namespace godwit::vehicle_link
