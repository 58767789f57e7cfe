// Whether godwitd may be stopped or exchanged now: for the scripts of packages, and for people. Thread: the caller's.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace godwit::daemon {

// A sentence; empty: no flight is under way. Asks the godwitd that runs; where none answers the journal tells whether
// it has left a flight, which systemd goes on with at once.
[[nodiscard]] std::string why_not_restart(const nlohmann::json& configuration);

} // namespace godwit::daemon
