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
  way_home   // what it would take of the battery
};

inline constexpr std::size_t topic_count = 16;

constexpr auto enum_names(topic) {
  return io::names<topic>({{topic::clock, "clock"},
                           {topic::link, "link"},
                           {topic::position, "position"},
                           {topic::attitude, "attitude"},
                           {topic::battery, "battery"},
                           {topic::gps, "gps"},
                           {topic::home, "home"},
                           {topic::flight, "flight"},
                           {topic::authority, "authority"},
                           {topic::progress, "progress"},
                           {topic::map, "map"},
                           {topic::health, "health"},
                           {topic::log, "log"},
                           {topic::points, "points"},
                           {topic::missions, "missions"},
                           {topic::way_home, "way_home"}});
}

struct clock_update {
  std::uint64_t beat = 0; // 1, 2, 3, ... of this incarnation of the stream
  static constexpr auto fields = io::table("telemetry_stream.clock", io::field("beat", &clock_update::beat));
};

struct position_update {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_m = 0;     // above home
  double altitude_msl_m = 0; // above mean sea level
  double ground_speed_mps = 0;
  double climb_mps = 0;
  std::optional<double> heading_deg;
  static constexpr auto fields = io::table(
      "telemetry_stream.position", io::field("latitude_deg", &position_update::latitude_deg),
      io::field("longitude_deg", &position_update::longitude_deg),
      io::field("altitude_m", &position_update::altitude_m),
      io::field("altitude_msl_m", &position_update::altitude_msl_m),
      io::field("ground_speed_mps", &position_update::ground_speed_mps),
      io::field("climb_mps", &position_update::climb_mps), io::field("heading_deg", &position_update::heading_deg));
};

struct attitude_update {
  double roll_deg = 0;
  double pitch_deg = 0;
  double yaw_deg = 0;
  static constexpr auto fields =
      io::table("telemetry_stream.attitude", io::field("roll_deg", &attitude_update::roll_deg),
                io::field("pitch_deg", &attitude_update::pitch_deg), io::field("yaw_deg", &attitude_update::yaw_deg));
};

// What the vehicle does not know is absent.
struct battery_update {
  std::optional<std::int32_t> remaining_percent;
  std::optional<double> voltage_v;
  std::optional<double> current_a;
  static constexpr auto fields =
      io::table("telemetry_stream.battery", io::field("remaining_percent", &battery_update::remaining_percent),
                io::field("voltage_v", &battery_update::voltage_v), io::field("current_a", &battery_update::current_a));
};

// What the receiver says of itself.
struct gps_update {
  std::uint8_t fix = 0;                   // GPS_FIX_TYPE: 0 none there, 1 no fix, 2 2D, 3 3D, 4 DGPS, 5 and 6 RTK
  std::optional<std::int32_t> satellites; // seen
  std::optional<double> hdop;
  std::optional<double> accuracy_m; // horizontal
  static constexpr auto fields = io::table(
      "telemetry_stream.gps", io::field("fix", &gps_update::fix), io::field("satellites", &gps_update::satellites),
      io::field("hdop", &gps_update::hdop), io::field("accuracy_m", &gps_update::accuracy_m));
};

// Where the vehicle's own return leads.
struct home_update {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_msl_m = 0; // above mean sea level
  static constexpr auto fields =
      io::table("telemetry_stream.home", io::field("latitude_deg", &home_update::latitude_deg),
                io::field("longitude_deg", &home_update::longitude_deg),
                io::field("altitude_msl_m", &home_update::altitude_msl_m));
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
  static constexpr auto fields = io::table(
      "telemetry_stream.flight", io::field("phase", &flight_update::phase), io::field("cause", &flight_update::cause),
      io::field("sentence", &flight_update::sentence), io::field("in_flight", &flight_update::in_flight),
      io::field("is_armed", &flight_update::is_armed), io::field("mode", &flight_update::mode),
      io::field("preflight_report", &flight_update::preflight_report), io::field("state", &flight_update::state));
  friend bool operator==(const flight_update&, const flight_update&) = default;
};

struct authority_update {
  std::string holder; // as executor::flight_status::authority
  static constexpr auto fields =
      io::table("telemetry_stream.authority", io::field("holder", &authority_update::holder));
  friend bool operator==(const authority_update&, const authority_update&) = default;
};

struct progress_update {
  std::string mission_id; // empty: none
  std::int32_t revision = 0;
  std::uint32_t generation = 0;
  std::uint32_t items = 0;
  std::uint32_t items_done = 0;
  std::uint32_t reports = 0;
  static constexpr auto fields =
      io::table("telemetry_stream.progress", io::field("mission_id", &progress_update::mission_id),
                io::field("revision", &progress_update::revision),
                io::field("generation", &progress_update::generation), io::field("items", &progress_update::items),
                io::field("items_done", &progress_update::items_done), io::field("reports", &progress_update::reports));
  friend bool operator==(const progress_update&, const progress_update&) = default;
};

struct log_update {
  bool is_warning = false;
  std::string part; // of whom it is said
  std::string sentence;
  static constexpr auto fields =
      io::table("telemetry_stream.log", io::field("is_warning", &log_update::is_warning),
                io::field("part", &log_update::part), io::field("sentence", &log_update::sentence));
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
  static constexpr auto fields = io::table(
      "telemetry_stream.point_of_interest", io::field("number", &point_of_interest::number),
      io::field("class_group", &point_of_interest::class_group),
      io::field("latitude_deg", &point_of_interest::latitude_deg),
      io::field("longitude_deg", &point_of_interest::longitude_deg),
      io::field("confidence", &point_of_interest::confidence), io::field("has_moved", &point_of_interest::has_moved),
      io::field("has_picture", &point_of_interest::has_picture),
      io::field("decide_until_ms", &point_of_interest::decide_until_ms), io::field("by", &point_of_interest::by));
  friend bool operator==(const point_of_interest&, const point_of_interest&) = default;
};

// While nobody looks for them none is shown: nobody can decide then.
struct points_update {
  bool is_looking = false;
  std::string mission_id;               // of all of them; empty: there was none yet
  std::vector<point_of_interest> shown; // people decide about these
  std::vector<point_of_interest> confirmed;
  std::uint32_t waiting = 0; // for their turn
  static constexpr auto fields =
      io::table("telemetry_stream.points", io::field("is_looking", &points_update::is_looking),
                io::field("mission_id", &points_update::mission_id), io::field("shown", &points_update::shown),
                io::field("confirmed", &points_update::confirmed), io::field("waiting", &points_update::waiting));
  friend bool operator==(const points_update&, const points_update&) = default;
};

} // namespace godwit::telemetry_stream
