// The whole of godwitd as one function, so that tests can link it into programs of their own. Thread: the main one,
// before any other.
#pragma once

#include "programs/godwitd/daemon.hpp"

namespace godwit::daemon {

// Returns the exit code.
[[nodiscard]] int run_program(int argc, const char* const* argv, const add_more& more = {});

} // namespace godwit::daemon
