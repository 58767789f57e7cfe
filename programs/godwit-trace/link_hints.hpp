// What a user may want to be told while nothing useful arrives: once each, a sentence that says what to try.
//
//   after 5 s     no byte                         is the sender sending here, is the line right
//                 bytes, and no frame             not MAVLink, or another baud rate
//   after 2 s     only MAVLink 1                  how to switch the autopilot to MAVLink 2
//
// Thread: a value; time comes from outside. Source: the parameters are those of ArduPilot and PX4.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "io/link/uri.hpp"
#include "io/mavlink/scan_counters.hpp"

namespace godwit::trace_tool {

class link_hints {
public:
  static constexpr std::chrono::seconds silent_after{5};
  static constexpr std::chrono::seconds v1_after{2};
  static constexpr std::uint64_t v1_frames_enough = 2; // one could be chance

  link_hints(const io::link::uri& where, bool has_heartbeat) : where_(where), has_heartbeat_(has_heartbeat) {}

  // ELAPSED since the beginning.
  [[nodiscard]] std::optional<std::string> due(std::chrono::milliseconds elapsed,
                                               const io::mavlink::scan_counters& heard);

private:
  io::link::uri where_;
  bool has_heartbeat_;
  bool told_v1_ = false;
  bool told_silence_ = false;
};

} // namespace godwit::trace_tool
