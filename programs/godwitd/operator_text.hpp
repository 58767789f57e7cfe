// What `godwitd ctl` shows of operators, for people. Thread: pure.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace godwit::daemon {

// A row a line: when, who, what, what came of it.
[[nodiscard]] std::string audit_text(const nlohmann::json& answer);

// Who has control now.
[[nodiscard]] std::string control_text(const nlohmann::json& answer);

// The part `operators` of a status: who has control, who is logged in.
[[nodiscard]] std::string operators_line(const nlohmann::json& part);

// The part `port`: "https://0.0.0.0:8443, fingerprint 3A:5F:...".
[[nodiscard]] std::string port_line(const nlohmann::json& part);

} // namespace godwit::daemon
