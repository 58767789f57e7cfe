// What godwitd says about its work, a line for each thing that happens, as text or JSON, to standard output or a file.
//
//   spdlog: level, form of the line ──> line_printer: bounded queue, its thread ──> standard output or file
//
// Nobody who says something waits for a reader or a disk: what the queue can not take, or the disk refuses, is counted,
// and a line in its place tells how much it was. Rotation is the system's: move the file away, then reopen().
//
// Errors: a file that can not be opened is a sentence. Thread: any.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <spdlog/formatter.h>
#include <spdlog/sinks/sink.h>
#include <tl/expected.hpp>

#include "io/link/descriptor.hpp"
#include "programs/common/line_printer.hpp"
#include "programs/godwitd/log/log_settings.hpp"

namespace godwit::daemon {

class program_log {
public:
  // STANDARD_OUTPUT is written to when no file is wanted, and stays open until the end.
  [[nodiscard]] static tl::expected<std::unique_ptr<program_log>, std::string> open(log_settings wanted,
                                                                                    int standard_output);
  program_log(const program_log&) = delete;
  program_log& operator=(const program_log&) = delete;
  ~program_log(); // what waits is written, within the printer's patience

  // PART is the actor, or the part of the program, of which it is said.
  void say(log_level level, std::string_view part, std::string_view sentence);

  // From now on into a new file of the same name. After an error it goes on into the old one. Without a file: nothing.
  [[nodiscard]] tl::expected<void, std::string> reopen();
  [[nodiscard]] const std::string& file() const { return wanted_.file; }
  // As on a terminal, where the errors on stderr stand between the lines.
  [[nodiscard]] bool is_plain() const { return wanted_.file.empty() && wanted_.format == log_format::text; }
  [[nodiscard]] std::uint64_t dropped() { return printer_->dropped(); }

private:
  program_log(log_settings wanted, io::link::descriptor file, int number);

  const log_settings wanted_;
  io::link::descriptor file_; // none: standard output
  std::unique_ptr<programs::line_printer> printer_;
  std::shared_ptr<spdlog::sinks::sink> sink_;
};

// How a line of the log looks:
//
//   plain    warning: the link to the vehicle can not be opened      (text on standard output: its reader has a clock)
//   stamped  2026-05-04T10:15:44.123Z warning vehicle_link: the link to the vehicle can not be opened     (text, file)
//   json     {"time":"2026-05-04T10:15:44.123Z","level":"warning","part":"vehicle_link","message":"the link ..."}
//
// Times are UTC, RFC 3339. Further lines of a sentence: as they are, indented, escaped. The part is the logger's name.
// Thread: one at a time; clones are independent. Source: spdlog's formatters.
enum class line_form { plain, stamped, json };

[[nodiscard]] std::unique_ptr<spdlog::formatter> make_formatter(line_form form);

} // namespace godwit::daemon
