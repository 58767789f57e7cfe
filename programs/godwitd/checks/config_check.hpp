// `godwitd --check-config`: what would keep godwitd from starting with these settings.
//
// Looks at every file that is to be read, at the folders that are written, and at the state that is there. Writes
// nothing, connects to nobody, and runs beside a running godwitd. Errors: a sentence for each problem, with the option,
// its variable and its place in the file. Thread: one; blocks on the disk.
#pragma once

#include <string>
#include <vector>

#include "programs/godwitd/settings.hpp"

namespace godwit::daemon {

// Empty: it can be used.
[[nodiscard]] std::vector<std::string> problems_of(const daemon_settings& wanted);

} // namespace godwit::daemon
