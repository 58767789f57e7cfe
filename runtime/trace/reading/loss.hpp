// What a trace does not hold, and where: whoever concludes something from a trace must know of it.
// Thread: plain values.
#pragma once

#include <cstdint>
#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::runtime {

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
