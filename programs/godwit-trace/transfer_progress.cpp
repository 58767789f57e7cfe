#include "programs/godwit-trace/transfer_progress.hpp"

#include <algorithm>
#include <string>

#include <unistd.h>

namespace godwit::trace_tool {

transfer_progress::transfer_progress(console& to) : to_(to), draws_(::isatty(STDERR_FILENO) != 0) {}

void transfer_progress::show(const vehicle_link::transfer::progress& how_far) {
  if (!draws_ || how_far.total == 0)
    return;
  const auto filled = static_cast<std::size_t>(width * how_far.done / std::max<int>(how_far.total, 1));
  to_.words.text() += "\r[" + std::string(filled, '#') + std::string(width - filled, ' ') + "] item " +
                      std::to_string(how_far.done) + " of " + std::to_string(how_far.total) + ' ';
  to_.words.flush();
  is_drawn_ = true;
}

void transfer_progress::finish() {
  if (!is_drawn_)
    return;
  to_.words.text() += "\r\033[K";
  to_.words.flush();
  is_drawn_ = false;
}

} // namespace godwit::trace_tool
