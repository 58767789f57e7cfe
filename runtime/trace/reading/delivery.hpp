// One delivery as the trace has it: which message an actor took, from whom, why, how long it had it and how that ended.
// Thread: plain values.
#pragma once

#include <cstdint>
#include <string_view>

#include "runtime/trace/trace_sink.hpp"

namespace godwit::runtime {

struct delivery {
  std::uint64_t run = 0;        // of the process: part of the file names
  std::uint64_t id = 0;         // 0: the message has none (the runtime's own, answers of what is no actor)
  std::uint64_t cause = 0;      // id of the message whose handler sent this one; 0: from outside
  std::int64_t began_ns = 0;    // since 1970 (UTC)
  std::int64_t duration_ns = 0; // in the handler
  // What the clocks showed the handler, less began_ns of the same clock; 0 where it has asked for no time.
  std::int64_t clock_offset_ns = 0;
  std::int64_t wall_offset_ns = 0;
  std::uint32_t actor = 0; // numbers of a name_table
  std::uint32_t sender = 0;
  std::uint32_t type = 0;
  std::uint32_t incarnation = 0;
  outcome how = outcome::handled;
  bool oversize = false;      // recorded without its message, which was longer than the trace takes
  std::string_view body = {}; // JSON; empty: there is none

  [[nodiscard]] std::int64_t ended_ns() const { return began_ns + duration_ns; }
};

} // namespace godwit::runtime
