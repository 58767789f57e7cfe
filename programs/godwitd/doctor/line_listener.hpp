// Listens on a line for a few seconds, and sends heartbeats of an onboard computer there: some speak only when they
// hear somebody. Nothing else is sent. Thread: the caller's, which waits.
#pragma once

#include <chrono>

#include <tl/expected.hpp>

#include "programs/godwitd/doctor/line_findings.hpp"

namespace godwit::daemon::doctor {

// Until PATIENCE is over, or an autopilot was heard for long enough to notice a second one. Error: a sentence, for a
// line that can never be opened.
[[nodiscard]] tl::expected<heard_line, std::string> listen_on(const io::link::uri& line, std::chrono::seconds patience);

} // namespace godwit::daemon::doctor
