// The answer to `godwitd ctl status`, for people. Thread: pure.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace godwit::daemon {

// A line for each part: run, service, map, vehicle. What is not in the answer is left out.
[[nodiscard]] std::string status_text(const nlohmann::json& answer);

// Of an answer to outbox_retry that went well.
[[nodiscard]] std::string retry_text(const nlohmann::json& answer);

// Of `ctl points`: what waits for a decision first.
[[nodiscard]] std::string points_text(const nlohmann::json& answer);

} // namespace godwit::daemon
