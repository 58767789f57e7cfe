// Who we are on a link, as it stands on the command line: SYSTEM/COMPONENT. Thread: pure.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "io/mavlink/frame.hpp"

namespace godwit::trace_tool {

// The error is a sentence that shows the form.
[[nodiscard]] tl::expected<io::mavlink::sender, std::string> read_identity(const std::string& text);

} // namespace godwit::trace_tool
