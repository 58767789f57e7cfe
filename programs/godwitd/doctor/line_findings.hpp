// What a line to the autopilot shows in a few seconds: who is heard on it, whether frames are damaged or signed. Pure.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "io/link/uri.hpp"
#include "io/mavlink/scan_counters.hpp"
#include "programs/godwitd/doctor/finding.hpp"

namespace godwit::daemon::doctor {

// Who has sent heartbeats.
struct heard_sender {
  std::uint8_t system = 0;
  std::uint8_t component = 0;
  std::uint8_t type = 0;      // MAV_TYPE
  std::uint8_t autopilot = 0; // MAV_AUTOPILOT
  bool is_signed = false;
  std::uint64_t heartbeats = 0;
};

struct heard_line {
  std::chrono::seconds lasted{0};
  std::string why_down; // empty: the line was open
  io::mavlink::scan_counters counted;
  std::vector<heard_sender> senders;
};

struct line_expectation {
  io::link::uri line;
  std::uint8_t system = 0; // vehicle.system; 0: any
  bool has_key = false;
};

[[nodiscard]] findings judge_line(const heard_line& heard, const line_expectation& wanted);

} // namespace godwit::daemon::doctor
