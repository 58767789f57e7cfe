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

constexpr auto enum_names(connection_phase) {
  return io::names<connection_phase>({{connection_phase::down, "down"},
                                      {connection_phase::silent, "silent"},
                                      {connection_phase::connected, "connected"},
                                      {connection_phase::lost, "lost"}});
}

struct get_connection {
  static constexpr auto fields = io::table("vehicle_link.get_connection");
};

// A number that only rises, under the name of what it counts.
struct named_count {
  std::string name;
  std::uint64_t count = 0;
  static constexpr auto fields = io::table("vehicle_link.named_count", io::field("name", &named_count::name),
                                           io::field("count", &named_count::count));
};

// An autopilot, as it names itself in its frames.
struct vehicle_name {
  std::uint8_t system = 0;
  std::uint8_t component = 0;
  static constexpr auto fields = io::table("vehicle_link.vehicle_name", io::field("system", &vehicle_name::system),
                                           io::field("component", &vehicle_name::component));
  friend bool operator==(const vehicle_name&, const vehicle_name&) = default;
};

// The executor: a flight is open, and with it goes the vehicle that is flown; or none is. Repeated once a second.
struct keep_vehicle {
  bool is_kept = false;
  static constexpr auto fields = io::table("vehicle_link.keep_vehicle", io::field("is_kept", &keep_vehicle::is_kept));
};

// Who else is on the line, and what raises a doubt about who the vehicle is. Told to listeners at each change.
struct line_findings {
  std::optional<vehicle_name> vehicle; // the one that is taken for ours
  std::vector<vehicle_name> others;    // autopilots heard of late that are not it; at most max_other_autopilots
  bool is_chosen = false;              // by its system id (vehicle.system): the others do not matter
  std::string twin; // why there are two under its name, as a sentence for people; empty: there are not
  static constexpr auto fields =
      io::table("vehicle_link.line_findings", io::field("vehicle", &line_findings::vehicle),
                io::field("others", &line_findings::others), io::field("is_chosen", &line_findings::is_chosen),
                io::field("twin", &line_findings::twin));
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
  static constexpr auto fields = io::table(
      "vehicle_link.connection", io::field("phase", &connection::phase), io::field("connected", &connection::connected),
      io::field("reason", &connection::reason), io::field("last_heartbeat_age_ms", &connection::last_heartbeat_age_ms),
      io::field("system", &connection::system), io::field("autopilot", &connection::autopilot),
      io::field("vehicle_type", &connection::vehicle_type), io::field("tx_seq", &connection::tx_seq),
      io::field("rx_seq", &connection::rx_seq), io::field("signing_enabled", &connection::signing_enabled),
      io::field("heartbeat_held_back", &connection::heartbeat_held_back),
      io::field("frames_in", &connection::frames_in), io::field("frames_out", &connection::frames_out),
      io::field("sequence_gaps", &connection::sequence_gaps),
      io::field("parse_errors_total", &connection::parse_errors_total),
      io::field("parse_errors", &connection::parse_errors), io::field("kind_errors", &connection::kind_errors),
      io::field("signed_in", &connection::signed_in), io::field("signing_rejected", &connection::signing_rejected),
      io::field("signing_errors", &connection::signing_errors), io::field("not_accepted", &connection::not_accepted),
      io::field("relayed_to_vehicle", &connection::relayed_to_vehicle),
      io::field("relayed_to_stations", &connection::relayed_to_stations),
      io::field("relays_dropped", &connection::relays_dropped), io::field("dropped_in", &connection::dropped_in),
      io::field("dropped_out", &connection::dropped_out), io::field("vehicle_restarts", &connection::vehicle_restarts),
      io::field("late_heartbeats", &connection::late_heartbeats),
      io::field("other_autopilots", &connection::other_autopilots),
      io::field("under_its_name", &connection::under_its_name),
      io::field("orders_kept_back", &connection::orders_kept_back), io::field("reconnects", &connection::reconnects),
      io::field("missing_streams", &connection::missing_streams), io::field("kept", &connection::kept),
      io::field("line", &connection::line), io::field("other_programs", &connection::other_programs));
};

// How a reason begins when frames come and are not believed.
inline constexpr std::string_view refused_for_signature = "frames are refused for their signature";

// Told to listeners at each change of phase, and when it turns out why nothing is heard.
struct connection_changed {
  connection_phase phase = connection_phase::down;
  std::string reason;
  static constexpr auto fields =
      io::table("vehicle_link.connection_changed", io::field("phase", &connection_changed::phase),
                io::field("reason", &connection_changed::reason));
};

// The autopilot's clock since boot went back: it started again. What it held in memory only is gone.
struct vehicle_restarted {
  std::uint32_t boot_ms_before = 0;
  std::uint32_t boot_ms_now = 0;
  static constexpr auto fields =
      io::table("vehicle_link.vehicle_restarted", io::field("boot_ms_before", &vehicle_restarted::boot_ms_before),
                io::field("boot_ms_now", &vehicle_restarted::boot_ms_now));
};

// Frames came that are signed wrongly, or not at all where they must be. Told at most once a second.
struct signing_alert {
  std::uint64_t rejected = 0; // since the start
  std::string reason;
  static constexpr auto fields =
      io::table("vehicle_link.signing_alert", io::field("rejected", &signing_alert::rejected),
                io::field("reason", &signing_alert::reason));
};

} // namespace godwit::vehicle_link
