// What is uploaded to a vehicle for a mission or the rest of it, and the way that it will fly. Thread: plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/executor/progress/plan_map.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "messages/mission/place.hpp"

namespace godwit::executor::plan {

inline constexpr std::size_t max_plan_items = 5'000; // of the vehicle: some minutes of upload on a slow radio

enum class leg_kind {
  climb, // from the ground, and so below the floor of a fence
  cruise,
  circle, // one chord of a polygon around a circle
  descent // to the ground
};

// A straight piece of the way. Metres above the place that the mission counts from.
struct leg {
  leg_kind kind = leg_kind::cruise;
  mission::position from;
  mission::position to;
  std::uint32_t item_index = 0; // of the mission: for which it is flown
  double times = 1;             // that it is flown, by the rounds of jumps; of an endless one a single round counts
};

// A survey in a plan: for each line two places, its beginning and its end, and what belongs to its camera.
struct planned_survey {
  std::uint32_t item_index = 0;   // in the mission
  std::uint32_t lines_before = 0; // flown by an earlier plan, and left out
  std::uint16_t first_line_sequence = 0;
  std::uint16_t line_count = 0; // in this plan
  std::uint16_t items_per_line = 2;
  std::uint16_t items_after_line = 0; // of those, so many come after its end

  GODWIT_FIELDS(planned_survey, "executor.planned_survey", item_index, lines_before, first_line_sequence, line_count,
                items_per_line, items_after_line);
};

struct flight_plan {
  std::vector<io::mavlink::mission_item_int> items; // from sequence 0 on, home included where the vehicle keeps it
  progress::plan_map map;
  std::optional<std::uint16_t> landing_sequence; // of DO_LAND_START
  std::vector<planned_survey> surveys;
  std::vector<leg> legs;
  double waits_s = 0; // that it waits at its places, in all rounds; of endless waits none counts
  mission::position ends_at;
  bool ends_on_ground = false;    // nothing more is flown without a take-off
  std::vector<std::string> notes; // what people should know of it, a sentence each
};

// How many lines of the survey are behind a vehicle that is on its way to SEQUENCE, those of earlier plans included. A
// line that was begun counts as not flown: who goes on flies it from its last picture on.
[[nodiscard]] std::uint32_t lines_done_at(const planned_survey& survey, std::uint16_t sequence);

} // namespace godwit::executor::plan
