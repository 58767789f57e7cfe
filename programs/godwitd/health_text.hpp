// The health of all parts in words, for the log and for the service manager. Thread: pure.
#pragma once

#include <string>
#include <vector>

#include "runtime/health_board.hpp"

namespace godwit::daemon {

// "all is well", or the worst of it: "red: journal: the disk is full; and 2 more".
[[nodiscard]] std::string health_in_a_line(const std::vector<runtime::health_entry>& now);

struct health_change {
  std::string part;
  runtime::health_colour colour = runtime::health_colour::green;
  std::string sentence; // "journal is red: the disk is full", "journal is well again"
};

// What has another colour than BEFORE. Of a part that nobody had heard of, only what is wrong with it.
[[nodiscard]] std::vector<health_change> health_changes(const std::vector<runtime::health_entry>& before,
                                                        const std::vector<runtime::health_entry>& now);

} // namespace godwit::daemon
