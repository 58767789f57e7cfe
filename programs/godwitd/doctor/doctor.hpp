// `godwitd doctor`: looks at this computer, the configuration and the line to the autopilot, and prints what would keep
// a flight from going well, each with a remedy. Sends heartbeats on the line, and nothing else; a godwitd that runs
// with the same control socket keeps its line. Thread: the caller's, for some seconds.
#pragma once

#include <chrono>

#include <nlohmann/json.hpp>

#include "programs/godwitd/doctor/finding.hpp"
#include "runtime/process.hpp"

namespace godwit::daemon::doctor {

// CONFIGURATION: as configuration.hpp gives it. Disk, clock, camera and serial port: what needs no line to be opened.
[[nodiscard]] findings examine_host(const nlohmann::json& configuration);
// The configuration, the host, and the line.
[[nodiscard]] findings examine(const nlohmann::json& configuration, std::chrono::seconds patience);
// Lines for people.
[[nodiscard]] std::string text_of(const findings& all);
// {"ok": false, "findings": [{"grade": "problem", "subject": "line", "sentence": "...", "remedy": "..."}]}
[[nodiscard]] nlohmann::json json_of(const findings& all);
[[nodiscard]] bool has_problem(const findings& all);

} // namespace godwit::daemon::doctor
