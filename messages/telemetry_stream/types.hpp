// What the stream of telemetry shows: a topic, and for each topic its newest value as a whole. Times are milliseconds
// since 1970 (UTC). Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::telemetry_stream {

enum class topic {
  clock,     // once a second: the stream is alive; everybody hears it
  link,      // to the vehicle
  position,  // of the vehicle
  attitude,  // of the vehicle
  battery,   // of the vehicle
  gps,       // of the vehicle
  home,      // of the vehicle
  flight,    // phase, mode, armed
  authority, // who has the vehicle
  progress,  // of the mission
  map,       // how much of it there is
  health,    // of all parts
  log,       // a line of godwitd's log
  points,    // of interest
  missions,  // that are known
  way_home,  // what it would take of the battery
  traffic    // other aircraft
};

inline constexpr std::size_t topic_count = 17;

GODWIT_ENUM_NAMES(topic, clock, link, position, attitude, battery, gps, home, flight, authority, progress, map, health,
                  log, points, missions, way_home, traffic);

struct clock_update {
  std::uint64_t beat = 0; // 1, 2, 3, ... of this incarnation of the stream
  GODWIT_FIELDS(clock_update, "telemetry_stream.clock", beat);
};

struct position_update {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_m = 0;     // above home
  double altitude_msl_m = 0; // above mean sea level
  double ground_speed_mps = 0;
  double climb_mps = 0;
  std::optional<double> heading_deg;
  GODWIT_FIELDS(position_update, "telemetry_stream.position", latitude_deg, longitude_deg, altitude_m, altitude_msl_m,
                ground_speed_mps, climb_mps, heading_deg);
};

struct attitude_update {
  double roll_deg = 0;
  double pitch_deg = 0;
  double yaw_deg = 0;
  GODWIT_FIELDS(attitude_update, "telemetry_stream.attitude", roll_deg, pitch_deg, yaw_deg);
};

// What the vehicle does not know is absent.
struct battery_update {
  std::optional<std::int32_t> remaining_percent;
  std::optional<double> voltage_v;
  std::optional<double> current_a;
  GODWIT_FIELDS(battery_update, "telemetry_stream.battery", remaining_percent, voltage_v, current_a);
};

// What the receiver says of itself.
struct gps_update {
  std::uint8_t fix = 0;                   // GPS_FIX_TYPE: 0 none there, 1 no fix, 2 2D, 3 3D, 4 DGPS, 5 and 6 RTK
  std::optional<std::int32_t> satellites; // seen
  std::optional<double> hdop;
  std::optional<double> accuracy_m; // horizontal
  GODWIT_FIELDS(gps_update, "telemetry_stream.gps", fix, satellites, hdop, accuracy_m);
};

// Where the vehicle's own return leads.
struct home_update {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_msl_m = 0; // above mean sea level
  GODWIT_FIELDS(home_update, "telemetry_stream.home", latitude_deg, longitude_deg, altitude_msl_m);
  friend bool operator==(const home_update&, const home_update&) = default;
};

struct flight_update {
  std::string phase;
  std::string cause; // of a pause
  std::string sentence;
  bool in_flight = false;
  bool is_armed = false;
  std::string mode;
  std::uint32_t preflight_report = 0; // that waits for an acknowledgement; 0: none
  std::string state;                  // as executor::flight_status: what a command is meant for
  GODWIT_FIELDS(flight_update, "telemetry_stream.flight", phase, cause, sentence, in_flight, is_armed, mode,
                preflight_report, state);
  friend bool operator==(const flight_update&, const flight_update&) = default;
};

struct authority_update {
  std::string holder; // as executor::flight_status::authority
  GODWIT_FIELDS(authority_update, "telemetry_stream.authority", holder);
  friend bool operator==(const authority_update&, const authority_update&) = default;
};

struct progress_update {
  std::string mission_id; // empty: none
  std::int32_t revision = 0;
  std::uint32_t generation = 0;
  std::uint32_t items = 0;
  std::uint32_t items_done = 0;
  std::uint32_t reports = 0;
  GODWIT_FIELDS(progress_update, "telemetry_stream.progress", mission_id, revision, generation, items, items_done,
                reports);
  friend bool operator==(const progress_update&, const progress_update&) = default;
};

struct log_update {
  bool is_warning = false;
  std::string part; // of whom it is said
  std::string sentence;
  GODWIT_FIELDS(log_update, "telemetry_stream.log", is_warning, part, sentence);
};

struct point_of_interest {
  std::uint64_t number = 0; // by which a person decides
  std::string class_group;
  double latitude_deg = 0;
  double longitude_deg = 0;
  double confidence = 0; // 0..1
  bool has_moved = false;
  bool has_picture = false;         // the camera has shown it: GET /api/v1/points/N/picture
  std::int64_t decide_until_ms = 0; // of one that is shown
  std::string by;                   // of one that is confirmed: who did
  GODWIT_FIELDS(point_of_interest, "telemetry_stream.point_of_interest", number, class_group, latitude_deg,
                longitude_deg, confidence, has_moved, has_picture, decide_until_ms, by);
  friend bool operator==(const point_of_interest&, const point_of_interest&) = default;
};

// While nobody looks for them none is shown: nobody can decide then.
struct points_update {
  bool is_looking = false;
  std::string mission_id;               // of all of them; empty: there was none yet
  std::vector<point_of_interest> shown; // people decide about these
  std::vector<point_of_interest> confirmed;
  std::uint32_t waiting = 0; // for their turn
  GODWIT_FIELDS(points_update, "telemetry_stream.points", is_looking, mission_id, shown, confirmed, waiting);
  friend bool operator==(const points_update&, const points_update&) = default;
};

} // namespace godwit::telemetry_stream
