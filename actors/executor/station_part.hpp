// The part of a station's plan that its MISSION_START asks for: from item FIRST to item LAST of the upload (FR-00089).
//
//   upload        0 take-off  1 speed  2 waypoint  3 waypoint  4 waypoint  5 return
//   start 3..4    0 take-off                       3           4                       on the ground
//   start 3..4    0           1        2           3           4                       in flight, from item 3 on
//
// What flies takes off first, as the plan says before FIRST; what stands between is left out. The plan that the station
// sees is its own, and so are the numbers. Pure; thread: plain values. Source: MAV_CMD_MISSION_START (300).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "actors/executor/state.hpp"

namespace godwit::executor {

// Each plan of a station, and each part of it that is prepared on the ground, is a mission of its own, also when it
// says the same as one before: that is flown again.
[[nodiscard]] std::string new_mission_id(std::uint32_t plan_id, std::int64_t wall_ns);

struct item_range {
  std::uint16_t first = 0; // in the upload
  std::uint16_t last = 0;
  friend bool operator==(const item_range&, const item_range&) = default;
};

// All of the station's plan. Needs one.
[[nodiscard]] item_range whole_plan(const state& s);

// What is prepared or flown of it. Needs one.
[[nodiscard]] item_range chosen_part(const state& s);

// The station's plan from WANTED.first to WANTED.last; TAKES_OFF: with the take-off before it. Its ids are those of the
// plan that it is taken from. None: stations are shown another plan than their own.
[[nodiscard]] std::optional<station_plan_taken> part_of_plan(const state& s, const item_range& wanted, bool takes_off);

// The first item of PART that was made of item PLACE of the upload, or what follows it. Its size: there is none.
[[nodiscard]] std::size_t first_item_at(const station_plan_taken& part, std::uint16_t place);

// The same as another mission.
[[nodiscard]] station_plan_taken as_new_mission(station_plan_taken what, std::int64_t wall_ns);

// "items 3 to 4 of 6"
[[nodiscard]] std::string sentence_of(const item_range& part, std::uint16_t items);

} // namespace godwit::executor
