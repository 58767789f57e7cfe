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

// What `godwitd ctl` shows of operators, for people. Thread: pure.

// A row a line: when, who, what, what came of it.
[[nodiscard]] std::string audit_text(const nlohmann::json& answer);

// Who has control now.
[[nodiscard]] std::string control_text(const nlohmann::json& answer);

// The part `operators` of a status: who has control, who is logged in.
[[nodiscard]] std::string operators_line(const nlohmann::json& part);

// The part `port`: "https://0.0.0.0:8443, fingerprint 3A:5F:...".
[[nodiscard]] std::string port_line(const nlohmann::json& part);

// What the running godwitd answers, before a person is shown it: every text in it is one line without effects. Names,
// reasons and sentences in it came from strangers, stations and services. Thread: pure.
[[nodiscard]] nlohmann::json shown_answer(nlohmann::json answer);

} // namespace godwit::daemon
