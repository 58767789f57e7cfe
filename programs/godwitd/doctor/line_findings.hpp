// What a line to the autopilot shows in a few seconds: who is heard on it, whether frames are damaged or signed. Pure.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "io/link/uri.hpp"
#include "io/mavlink/scanner.hpp"
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

// Listens on a line for a few seconds, and sends heartbeats of an onboard computer there: some speak only when they
// hear somebody. Nothing else is sent. Thread: the caller's, which waits.

// Until PATIENCE is over, or an autopilot was heard for long enough to notice a second one. Error: a sentence, for a
// line that can never be opened.
[[nodiscard]] tl::expected<heard_line, std::string> listen_on(const io::link::uri& line, std::chrono::seconds patience);

} // namespace godwit::daemon::doctor
