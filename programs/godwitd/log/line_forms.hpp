// How a line of the log looks:
//
//   plain    warning: the link to the vehicle can not be opened      (text on standard output: its reader has a clock)
//   stamped  2026-05-04T10:15:44.123Z warning vehicle_link: the link to the vehicle can not be opened     (text, file)
//   json     {"time":"2026-05-04T10:15:44.123Z","level":"warning","part":"vehicle_link","message":"the link ..."}
//
// Times are UTC, RFC 3339. Further lines of a sentence: as they are, indented, escaped. The part is the logger's name.
// Thread: one at a time; clones are independent. Source: spdlog's formatters.
#pragma once

#include <memory>

#include <spdlog/formatter.h>

namespace godwit::daemon {

enum class line_form { plain, stamped, json };

[[nodiscard]] std::unique_ptr<spdlog::formatter> make_formatter(line_form form);

} // namespace godwit::daemon
