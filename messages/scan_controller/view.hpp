// Whether anybody sees the ground. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/mission/place.hpp"

namespace godwit::scan_controller {

// Told each half second by who looks, while a mission with scanning is flown; whoever says nothing does not see.
struct view {
  bool is_seeing = false;
  std::string reason; // why not: a sentence for people
  GODWIT_FIELDS(view, "scan_controller.view", is_seeing, reason);
};

// How far the vehicle is with a survey, as the executor sees it. Thread: plain values.

// Told at each change. It is the survey that is flown, or the one flown last in this plan.
struct survey_progress {
  std::string mission_id;
  std::string item_id;          // empty: no survey of the plan has begun
  std::uint32_t generation = 0; // of the plan: another one was uploaded or started
  bool is_flying = false;       // under godwit, in the mission: neither held nor taken over nor being replaced
  bool is_at_beginning = false; // on the way to the first line, of which nothing is flown
  std::uint32_t lines = 0;
  std::uint32_t lines_done = 0;
  std::vector<mission::vertex> polygon;
  GODWIT_FIELDS(survey_progress, "scan_controller.survey_progress", mission_id, item_id, generation, is_flying,
                is_at_beginning, lines, lines_done, polygon);
};

} // namespace godwit::scan_controller
