// How godwitd's actors are supervised: without an essential one the process ends, so that the service manager starts a
// new one. Thread: constants.
#pragma once

#include "runtime/supervision/policy.hpp"

namespace godwit::daemon {

inline constexpr runtime::child_policy essential{.essential = true, .restart = {}};
inline constexpr runtime::child_policy replaceable{};

} // namespace godwit::daemon
