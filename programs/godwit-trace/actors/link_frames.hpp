// What godwitd recorded of its links beside the trace (LINK-RUN-NUMBER.tlog), in order of time, run by run.
//
// Broken records are passed over and counted; a file that can not be read is a sentence in problems(). Memory: 64 KiB
// a link. Errors: sentences. Thread: one at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <tl/expected.hpp>

#include "io/mavlink/tlog/tlog_reader.hpp"
#include "programs/godwit-trace/actors/trace_arguments.hpp"
#include "programs/godwit-trace/name_filter.hpp"
#include "runtime/trace/reading/trace_reader.hpp"

namespace godwit::trace_tool {

// As they stand on the command line.
struct link_arguments {
  bool links = false;
  std::vector<std::string> names;
};

// TO must live as long as COMMAND.
void add_link_arguments(CLI::App& command, link_arguments& to);

struct link_file {
  std::filesystem::path path;
  std::string link; // "vehicle", "ground"
  std::uint64_t run = 0;
  std::uint64_t number = 0;
};

// Those that lie beside TRACE and are of its runs, sorted by link, run and number.
[[nodiscard]] std::vector<link_file> find_link_files(const std::vector<runtime::trace_file>& trace);

struct link_frame {
  std::uint64_t run = 0;
  std::int64_t at_ns = 0; // since 1970 UTC, to the microsecond
  const std::string* link = nullptr;
  io::mavlink::frame_view frame;
};

class link_frames {
public:
  link_frames(const std::vector<link_file>& files, runtime::time_span_ns span, name_filter wanted);

  // The oldest that was not given yet, if it is not after this moment of this run. Valid until the next call.
  [[nodiscard]] std::optional<link_frame> next_until(std::uint64_t run, std::int64_t at_ns);
  // The oldest that was not given yet.
  [[nodiscard]] std::optional<link_frame> next() { return next_until(UINT64_MAX, INT64_MAX); }

  // What could not be read; also that there is no file at all.
  [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }
  void add_problem(std::string sentence) { problems_.push_back(std::move(sentence)); }

private:
  // The files of one link, one after the other.
  struct stream {
    std::deque<link_file> files; // the first is open, if there is a reader
    std::unique_ptr<io::mcap::file_source> source;
    std::unique_ptr<io::mavlink::tlog_reader> reader;
    std::optional<link_frame> next;
    bool is_read = false; // up to `next`, or to the end
  };

  void read_on(stream& from);
  [[nodiscard]] std::optional<io::mavlink::tlog_record> next_record(stream& from);
  [[nodiscard]] bool open_first(stream& from);
  void close_first(stream& from);

  runtime::time_span_ns span_;
  name_filter wanted_;
  std::vector<stream> streams_;
  std::vector<std::string> problems_;
};

// Those beside TRACE that GIVEN asks for; none of them without --links. The error is a mistake in a name.
[[nodiscard]] tl::expected<link_frames, std::string> open_links(const link_arguments& given, const opened_trace& trace);

// On TO.words.
void report_problems(const link_frames& frames, console& to);

// One line: time, link, who sent it, name, fields.
void append_frame_line(std::string& out, const link_frame& each);
void append_frame_json_line(std::string& out, const link_frame& each);

} // namespace godwit::trace_tool
