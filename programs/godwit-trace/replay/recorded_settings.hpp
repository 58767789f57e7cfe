// The settings that a recorded godwitd ran with, out of its trace or of a file.
//
// They are without secrets, and so no service could be asked with them: addresses and files are left out. Errors:
// sentences for people. Thread: pure, but for reading the file.
#pragma once

#include <map>
#include <string>

#include <tl/expected.hpp>

#include "programs/godwitd/settings.hpp"

namespace godwit::trace_tool {

// ABOUT: what the trace says of the run. FILE, where it is not empty, takes the place of the settings in it.
[[nodiscard]] tl::expected<daemon::daemon_settings, std::string>
recorded_settings(const std::map<std::string, std::string>& about, const std::string& file);

} // namespace godwit::trace_tool
