#include "programs/godwitd/link_log/link_log_options.hpp"

#include <algorithm>

namespace godwit::daemon {

link_log_options share_of(runtime::trace_options& trace) {
  constexpr std::uint64_t eighths = 8;
  constexpr std::uint64_t fewest_files = 2;
  link_log_options result;
  result.folder = trace.folder;
  result.flush = trace.flush;
  result.total_bytes = trace.total_bytes / eighths;
  result.segment_bytes = std::min(trace.segment_bytes, result.total_bytes / fewest_files);
  trace.total_bytes -= 2 * result.total_bytes;
  trace.segment_bytes = std::min(trace.segment_bytes, trace.total_bytes / fewest_files);
  return result;
}

} // namespace godwit::daemon
