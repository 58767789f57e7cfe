// One step of a mission: a variant, whose JSON form is the object of the alternative with its `kind` in it.
//
//   {"id": "w1", "kind": "waypoint", "at": {...}, "hold_s": 0, "accept_radius_m": 2}
//
// One item becomes none, one or several items on the vehicle. Angles are degrees clockwise from north, altitudes metres
// above the place of take-off, speeds metres a second: over ground, for fixed wings through the air. What may stand in
// a field is the business of config/schemas/item.schema.json. Two kinds belong to version 2 of the contract: `command`
// is one item of the vehicle as it is, and `jump` goes back or forth between items; so does the camera of a survey.
// Thread: plain values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/mission/place.hpp"

namespace godwit::mission {

// Straight up from where the vehicle stands.
struct takeoff {
  std::string id;
  double altitude_m = 0;

  static constexpr std::string_view kind = "takeoff";
  GODWIT_FIELDS(takeoff, "mission.takeoff", id, altitude_m);
  friend bool operator==(const takeoff&, const takeoff&) = default;
};

struct waypoint {
  std::string id;
  position at;
  double hold_s = 0;               // after arriving
  double accept_radius_m = 0;      // 0: the vehicle's own
  std::optional<double> speed_mps; // from this leg on, as a change_speed in front of it

  static constexpr std::string_view kind = "waypoint";
  GODWIT_FIELDS(waypoint, "mission.waypoint", id, at, hold_s, accept_radius_m, speed_mps);
  friend bool operator==(const waypoint&, const waypoint&) = default;
};

// Circle there, or hover, for a while.
struct loiter {
  std::string id;
  position at;
  double radius_m = 0; // negative: counter-clockwise; 0: the vehicle's own
  double duration_s = 0;

  static constexpr std::string_view kind = "loiter";
  GODWIT_FIELDS(loiter, "mission.loiter", id, at, radius_m, duration_s);
  friend bool operator==(const loiter&, const loiter&) = default;
};

// From here on, until another speed is asked for.
struct change_speed {
  std::string id;
  double mps = 0;

  static constexpr std::string_view kind = "change_speed";
  GODWIT_FIELDS(change_speed, "mission.change_speed", id, mps);
  friend bool operator==(const change_speed&, const change_speed&) = default;
};

// By one of the two.
struct camera_trigger {
  std::optional<double> distance_m; // along the line, between two pictures
  std::optional<double> interval_s;

  GODWIT_FIELDS(camera_trigger, "mission.camera_trigger", distance_m, interval_s);
  friend bool operator==(const camera_trigger&, const camera_trigger&) = default;
};

// It takes pictures on the lines, and none on the ways between them.
struct survey_camera {
  camera_trigger trigger;
  std::optional<double> gimbal_pitch_deg; // -90: straight down; absent: it is left as it is
  double turnaround_m = 0;                // so far each line is flown on, before the turn and after it

  GODWIT_FIELDS(survey_camera, "mission.survey_camera", trigger, gimbal_pitch_deg, turnaround_m);
  friend bool operator==(const survey_camera&, const survey_camera&) = default;
};

// Parallel lines over an area.
struct survey {
  std::string id;
  std::vector<vertex> polygon;
  double altitude_m = 0;
  double line_spacing_m = 0;
  std::optional<double> heading_deg; // of the lines; absent: whoever plans the flight chooses
  std::optional<survey_camera> camera = {};

  static constexpr std::string_view kind = "survey";
  GODWIT_FIELDS(survey, "mission.survey", id, polygon, altitude_m, line_spacing_m, heading_deg, camera);
  friend bool operator==(const survey&, const survey&) = default;
};

struct land {
  std::string id;
  position at;

  static constexpr std::string_view kind = "land";
  GODWIT_FIELDS(land, "mission.land", id, at);
  friend bool operator==(const land&, const land&) = default;
};

enum class return_goal {
  home // the vehicle's own return: to its home, at its own return altitude
};

constexpr auto enum_names(return_goal) { return io::names<return_goal>({{return_goal::home, "HOME"}}); }

// To the return point, and land there. Its kind is "return".
struct return_home {
  std::string id;
  std::optional<return_goal> to{}; // absent: the return point of the mission

  static constexpr std::string_view kind = "return";
  GODWIT_FIELDS(return_home, "mission.return", id, to);
  friend bool operator==(const return_home&, const return_home&) = default;
};

inline constexpr std::size_t command_params = 7;
// Of those, where it has a place.
inline constexpr std::size_t latitude_param = 4;
inline constexpr std::size_t longitude_param = 5;
inline constexpr std::size_t altitude_param = 6;

// One item of the vehicle, as it is: nothing is added to it or left out. Parameters 5 and 6 are degrees in the frames
// that have latitude and longitude.
struct command_item {
  std::string id;
  std::uint16_t command = 0;                                // MAV_CMD
  std::uint8_t frame = 0;                                   // MAV_FRAME
  std::array<std::optional<double>, command_params> params; // absent: not given
  bool autocontinue = true;

  static constexpr std::string_view kind = "command";
  GODWIT_FIELDS(command_item, "mission.command", id, command, frame, params, autocontinue);
  friend bool operator==(const command_item&, const command_item&) = default;
};

// On from the item TO, so many times; then on with the item after this one.
struct jump {
  std::string id;
  std::string to;         // the id of an item of the same mission
  std::int32_t times = 0; // -1: for ever

  static constexpr std::string_view kind = "jump";
  GODWIT_FIELDS(jump, "mission.jump", id, to, times);
  friend bool operator==(const jump&, const jump&) = default;
};

using item = std::variant<takeoff, waypoint, loiter, change_speed, survey, land, return_home, command_item, jump>;

[[nodiscard]] inline const std::string& id_of(const item& each) {
  return std::visit([](const auto& value) -> const std::string& { return value.id; }, each);
}

[[nodiscard]] inline std::string_view kind_of(const item& each) {
  return std::visit([]<class T>(const T&) { return T::kind; }, each);
}

// Version 1 of the contract does not know it.
[[nodiscard]] inline bool is_of_version_2(const item& each) {
  const auto* const area = std::get_if<survey>(&each);
  return std::holds_alternative<command_item>(each) || std::holds_alternative<jump>(each) ||
         (area != nullptr && area->camera);
}

} // namespace godwit::mission
