// One item as vehicles and ground stations know it: a MAVLink command with seven parameters, positions in degrees.
//
// NaN: not given. Parameters are counted from 1, as MAVLink does. Thread: plain values. Source: MAVLink's common.xml,
// MISSION_ITEM_INT and MAV_CMD.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "messages/mission/document.hpp"

namespace godwit::mission {

struct vehicle_item {
  std::size_t number = 0; // its place in the source, from 0 on
  std::uint16_t command = 0;
  std::uint8_t frame = 0;
  std::array<double, 7> params{};
  bool autocontinue = true;
  std::string place{};                      // where it stands in a file: "line 7" or a JSON pointer
  std::optional<std::size_t> jump_number{}; // by which a DO_JUMP names it; absent: its number

  [[nodiscard]] double param(std::size_t from_1) const { return params.at(from_1 - 1); }
  [[nodiscard]] double latitude() const { return params[4]; }
  [[nodiscard]] double longitude() const { return params[5]; }
  [[nodiscard]] double altitude_m() const { return params[6]; }
  // 0/0 is how MAVLink says "here".
  [[nodiscard]] bool has_place() const {
    return std::isfinite(latitude()) && std::isfinite(longitude()) && (latitude() != 0 || longitude() != 0);
  }
};

inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

// The commands that a mission has kinds of items for or a pattern is made of, and the frames of their positions.
namespace command {
inline constexpr std::uint16_t waypoint = 16;
inline constexpr std::uint16_t loiter_time = 19;
inline constexpr std::uint16_t return_to_launch = 20;
inline constexpr std::uint16_t land = 21;
inline constexpr std::uint16_t takeoff = 22;
inline constexpr std::uint16_t loiter_to_alt = 31;
inline constexpr std::uint16_t vtol_land = 85;
inline constexpr std::uint16_t jump = 177;
inline constexpr std::uint16_t change_speed = 178;
inline constexpr std::uint16_t land_start = 189;
inline constexpr std::uint16_t trigger_distance = 206;
inline constexpr std::uint16_t stop_capture = 2001;
inline constexpr std::uint16_t stop_video = 2501;
} // namespace command

namespace frame {
inline constexpr std::uint8_t global = 0; // altitude above mean sea level
inline constexpr std::uint8_t mission = 2;
inline constexpr std::uint8_t global_relative = 3; // altitude above home
inline constexpr std::uint8_t global_int = 5;
inline constexpr std::uint8_t global_relative_int = 6;
} // namespace frame

// "NAV_WAYPOINT", or "command 12345".
[[nodiscard]] std::string command_name(std::uint16_t id);

// The home that a file was planned for; nothing for 0/0, which ground stations write when they have none.
[[nodiscard]] std::optional<planned_home> home_at(double latitude, double longitude, double above_sea_m);

// A number as people write it: 25, 0.5.
[[nodiscard]] std::string number_text(double value);

} // namespace godwit::mission
