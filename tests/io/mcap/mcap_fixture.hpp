// What the MCAP tests share: a folder that goes away, a small recording, and a file read into plain values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/mcap/channel_registry.hpp"
#include "io/mcap/segment_writer.hpp"
#include "tests/support/strict_mcap_reader.hpp"

namespace godwit::io::mcap::test {

class temporary_folder {
public:
  temporary_folder();
  ~temporary_folder();
  temporary_folder(const temporary_folder&) = delete;
  temporary_folder& operator=(const temporary_folder&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

// Throws the error's text.
void require(const result<void>& outcome);

// A message as the tests compare it.
struct seen_message {
  std::string topic;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::string payload;
  bool operator==(const seen_message&) const = default;
};

enum class ending { complete, truncated, error };

struct reading {
  std::vector<seen_message> messages;
  std::vector<std::string> schemas;
  std::vector<std::string> metadata;
  statistics_record statistics;
  std::string library;
  ending end = ending::error;
  truncated torn; // when `end` is truncated
  error failure;  // when `end` is error
};

[[nodiscard]] reading read_all(const byte_source& source, read_limits limits = {});
[[nodiscard]] reading read_all(byte_view bytes, read_limits limits = {});
[[nodiscard]] reading read_file(const std::filesystem::path& path);

[[nodiscard]] byte_buffer load_bytes(const std::filesystem::path& path);
void store_bytes(const std::filesystem::path& path, byte_view bytes);

// Two topics under one JSON Schema, for recordings whose payloads are {"n":...,"text":"..."}.
struct two_channels {
  channel_registry registry;
  channel_id even{};
  channel_id odd{};
  two_channels();
  [[nodiscard]] channel_id of(std::uint32_t n) const { return n % 2 == 0 ? even : odd; }
};

[[nodiscard]] std::string schema_text();
[[nodiscard]] std::string payload_of(std::uint32_t n);
// What a reader should see of write_numbered(..., n).
[[nodiscard]] seen_message numbered(std::uint32_t n);
[[nodiscard]] result<void> write_numbered(segment_writer& writer, const two_channels& channels, std::uint32_t n);

// Three chunks of four messages, metadata after the second; closed or left without its end.
inline constexpr std::uint32_t small_recording_messages = 12;
void write_small_recording(const std::filesystem::path& path, bool closed);

} // namespace godwit::io::mcap::test
