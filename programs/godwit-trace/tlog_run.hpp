// The command `tlog`: prints what a .tlog holds.
//
// Broken records are passed over and counted at the end, on stderr or in the tables. Times are those of the log.
// Errors: a sentence on stderr and exit_code::failed for a file that can not be read or holds no frame; a reader of the
// output that goes away ends it in order. Blocks on the disk. Thread: one.
#pragma once

#include <string>

#include "programs/common/exit_code.hpp"
#include "programs/godwit-trace/message_printer.hpp"
#include "programs/godwit-trace/output.hpp"
#include "programs/godwit-trace/print_options.hpp"
#include "programs/godwit-trace/time_range.hpp"

namespace godwit::trace_tool {

using programs::exit_code;

struct tlog_options {
  std::string file;
  print_options print;
  print_time time = print_time::utc;
  time_range range;
};

[[nodiscard]] exit_code run_tlog(const tlog_options& options, console& to);

} // namespace godwit::trace_tool
