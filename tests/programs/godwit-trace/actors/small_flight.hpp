// A trace of a short flight, small enough to be read by eye: two runs of godwitd, a crash, a replan, a pilot.
#pragma once

#include <filesystem>

#include "tests/runtime/trace/reading/written_trace.hpp"

namespace godwit::tests {

inline constexpr const char* px4_hold_disarmed = R"({"type":2,"autopilot":12,"base_mode":29,"custom_mode":50593792})";
inline constexpr const char* px4_mission_armed = R"({"type":2,"autopilot":12,"base_mode":157,"custom_mode":67371008})";

inline trace_row report_row(std::int64_t at_ms, int number, const std::string& kind, int generation = 1) {
  return {.at_ms = at_ms,
          .actor = "mission_client",
          .type = "mission_client.report_progress",
          .body = R"({"key":"k","report":{"mission_id":"m1","revision":1,"generation":)" + std::to_string(generation) +
                  R"(,"report_no":)" + std::to_string(number) + R"(,"kind":")" + kind +
                  R"(","item_id":"a","inferred":false}})",
          .id = static_cast<std::uint64_t>(1000 + at_ms),
          .cause = 0,
          .sender = "executor"};
}

// Ids: 1 is the heartbeat at the start, 7 the command to arm, which came of 6.
inline std::vector<trace_row> first_run() {
  return {
      {.at_ms = 0, .actor = "executor", .type = "runtime.durable", .body = R"({"upto":0})", .id = 100},
      {.at_ms = 1,
       .actor = "executor",
       .type = "HEARTBEAT",
       .body = px4_hold_disarmed,
       .id = 1,
       .sender = "vehicle_link"},
      {.at_ms = 2,
       .actor = "executor",
       .type = "HEARTBEAT",
       .body = px4_hold_disarmed,
       .id = 2,
       .sender = "vehicle_link"},
      {.at_ms = 10,
       .actor = "executor",
       .type = "operator.word",
       .body = R"({"verb":"start","report":0,"by":"ann","place":null,"after":""})",
       .id = 6,
       .sender = "control_handler",
       .duration_ns = 40'000},
      {.at_ms = 11,
       .actor = "vehicle_link",
       .type = "vehicle_link.send_command",
       .body = R"({"command":400,"param1":1,"param2":0})",
       .id = 7,
       .cause = 6,
       .sender = "executor"},
      {.at_ms = 12,
       .actor = "executor",
       .type = "vehicle_link.command_outcome",
       .body = R"({"command":400,"verdict":"accepted","reason":""})",
       .id = 8,
       .cause = 7,
       .sender = "vehicle_link"},
      {.at_ms = 20,
       .actor = "executor",
       .type = "HEARTBEAT",
       .body = px4_mission_armed,
       .id = 9,
       .sender = "vehicle_link"},
      report_row(21, 1, "started"),
      {.at_ms = 30,
       .actor = "executor",
       .type = "mission_client.assignment_arrived",
       .body = R"({"assignment":{"revision":2,"replace_after_item_id":"a","items":[1,2,3]}})",
       .id = 10,
       .sender = "mission_client",
       .how = "crashed"},
      {.at_ms = 31,
       .actor = "executor",
       .type = "runtime.child_event",
       .body = R"({"name":"executor","kind":"crashed","incarnation":1,"reason":"no such item"})"},
      {.at_ms = 33,
       .actor = "executor",
       .type = "mission_client.assignment_arrived",
       .body = R"({"assignment":{"revision":2,"replace_after_item_id":"a","items":[1,2,3]}})",
       .id = 10,
       .sender = "mission_client",
       .incarnation = 2},
      report_row(40, 2, "reached", 2),
  };
}

inline std::vector<trace_row> second_run() {
  return {
      {.at_ms = 500, .actor = "executor", .type = "runtime.durable", .body = R"({"upto":9})", .id = 100},
      {.at_ms = 501,
       .actor = "executor",
       .type = "failsafe.stance",
       .body = R"({"in_flight":true,"taken_over":true,"reacts":null,"latched":[],"overridden":[]})",
       .id = 20,
       .sender = "failsafe"},
      report_row(510, 3, "complete", 2),
  };
}

inline void write_flight(const std::filesystem::path& folder, const std::vector<trace_row>& first,
                         const std::vector<trace_row>& second) {
  written_trace one(folder, 1);
  one.add(first);
  one.close();
  if (second.empty())
    return;
  written_trace two(folder, 2);
  two.add(second);
  two.close();
}

inline void write_small_flight(const std::filesystem::path& folder) { write_flight(folder, first_run(), second_run()); }

} // namespace godwit::tests
