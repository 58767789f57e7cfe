// Traces for tests of what reads them: written as godwitd writes them, by the writer of the segments, out of plain
// rows.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "io/fields/json_text.hpp"
#include "io/mcap/rotating_writer.hpp"
#include "runtime/trace/reading/trace_reader.hpp"

namespace godwit::tests {

inline constexpr std::int64_t trace_begin_ns = 1'795'000'000'000'000'000; // in November 2026

// A new folder that is removed at the end.
class trace_folder {
public:
  trace_folder() {
    std::string name = (std::filesystem::temp_directory_path() / "godwit-trace-XXXXXX").string();
    EXPECT_NE(::mkdtemp(name.data()), nullptr);
    path_ = name;
  }
  ~trace_folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  trace_folder(const trace_folder&) = delete;
  trace_folder& operator=(const trace_folder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

struct trace_row {
  std::int64_t at_ms = 0; // since trace_begin_ns
  std::string actor;
  std::string type;
  std::string body = "{}";
  std::uint64_t id = 0;
  std::uint64_t cause = 0;
  std::string sender = "outside";
  std::uint32_t incarnation = 1;
  std::string how = "handled";
  std::int64_t duration_ns = 1'000;
};

class written_trace {
public:
  explicit written_trace(std::filesystem::path folder, std::uint64_t run = 1, std::uint64_t segment_bytes = 8U << 20U) {
    io::mcap::rotating_writer_options options;
    options.segments.folder = std::move(folder);
    options.segments.segment_bytes = segment_bytes;
    options.run = run;
    options.run_info = {{"run", std::to_string(run)}};
    EXPECT_TRUE(writer_.open(options));
  }

  void add(const trace_row& row) {
    const auto topic = '/' + row.actor + '/' + row.type;
    if (!channels_.contains(topic)) {
      const auto schema = writer_.add_schema(row.type, "jsonschema", io::mcap::bytes_of("{}"));
      channels_[topic] = *writer_.add_channel(*schema, topic, "json");
    }
    std::string text = R"({"id":)" + std::to_string(row.id) + R"(,"cause":)" + std::to_string(row.cause) +
                       R"(,"actor":)" + quoted(row.actor) + R"(,"incarnation":)" + std::to_string(row.incarnation) +
                       R"(,"sender":)" + quoted(row.sender) + R"(,"duration_ns":)" + std::to_string(row.duration_ns) +
                       R"(,"outcome":)" + quoted(row.how) +
                       (row.body.empty() ? R"(,"oversize":true})" : R"(,"message":)" + row.body + "}");
    const auto at_ns = static_cast<std::uint64_t>(trace_begin_ns + row.at_ms * 1'000'000);
    EXPECT_TRUE(writer_.write({channels_[topic], sequence_++, at_ns, at_ns, io::mcap::bytes_of(text)}));
  }
  void add(const std::vector<trace_row>& rows) {
    for (const auto& each : rows)
      add(each);
  }
  void flush() { EXPECT_TRUE(writer_.flush()); }
  void close() { EXPECT_TRUE(writer_.close()); }

private:
  static std::string quoted(const std::string& text) {
    std::string result;
    io::append_json_string(result, text);
    return result;
  }

  io::mcap::rotating_writer writer_;
  std::map<std::string, io::mcap::channel_id> channels_;
  std::uint32_t sequence_ = 0;
};

} // namespace godwit::tests
