// One delivery as the trace has it: which message an actor took, from whom, why, how long it had it and how that ended.
// Thread: plain values.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>

#include "io/fields/field_table.hpp"
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

// Names of actors and message types as numbers, so that millions of deliveries are told apart without comparing text.
// Numbers count from 0 in the order of their first use, and stay. Thread: one at a time.
class name_table {
public:
  std::uint32_t number(std::string_view name) {
    if (const auto found = numbers_.find(name); found != numbers_.end())
      return found->second;
    const auto made = static_cast<std::uint32_t>(names_.size());
    numbers_.emplace(names_.emplace_back(name), made);
    return made;
  }
  [[nodiscard]] const std::string& name(std::uint32_t number) const { return names_.at(number); }
  [[nodiscard]] std::size_t size() const { return names_.size(); }

private:
  std::deque<std::string> names_; // by number; the keys below are views of them
  std::unordered_map<std::string_view, std::uint32_t> numbers_;
};

// What a trace does not hold, and where: whoever concludes something from a trace must know of it.
// Thread: plain values.
enum class loss_kind {
  begin_missing, // the run's first segments are gone: the bound of the folder, or they were not given
  unreadable,    // bytes that are damaged
  cut,           // the file ends without its end: it is being written, or its writer was killed
  gap,           // segments are missing between two that are there
  dropped,       // the daemon recorded more than its trace could take
  unwritten,     // the disk refused
  unknown        // records that are no deliveries, or whose channel stood in what is unreadable
};

GODWIT_ENUM_NAMES(loss_kind, begin_missing, unreadable, cut, gap, dropped, unwritten, unknown);

struct loss {
  loss_kind kind = loss_kind::unreadable;
  std::uint64_t run = 0;
  std::string file = {};
  std::uint64_t offset = 0; // in the file; 0 for what is not about bytes
  std::uint64_t bytes = 0;
  std::uint64_t records = 0; // 0: how many is not known
  std::int64_t after_ns = 0; // the newest time read before, in this run; 0: none
  std::string what;          // a sentence without its end

  // Records in the middle of the history may be missing: neither at its begin, nor at its end, nor nothing.
  bool is_hole = false;
};

} // namespace godwit::runtime
