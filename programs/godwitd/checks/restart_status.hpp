// Whether the status of a running godwitd lets it be stopped or exchanged. Thread: pure.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace godwit::daemon {

// STATUS: its answer. A sentence; empty: no flight is under way.
[[nodiscard]] std::string why_not_restart_now(const nlohmann::json& status);

} // namespace godwit::daemon
