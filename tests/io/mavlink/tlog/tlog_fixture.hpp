// What the tests of .tlog share: a folder that goes away, logs put together by hand, and logs read into plain values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/mavlink/tlog/tlog_reader.hpp"
#include "tests/io/mavlink/mavlink_fixture.hpp"

namespace godwit::io::mavlink::test {

inline constexpr std::uint64_t some_day_us = 1'781'000'000'000'000; // in 2026

class temporary_folder {
public:
  temporary_folder();
  ~temporary_folder();
  temporary_folder(const temporary_folder&) = delete;
  temporary_folder& operator=(const temporary_folder&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
  std::filesystem::path path_;
};

struct plain_record {
  std::uint64_t timestamp_us = 0;
  std::string hex; // of the frame
  bool is_verified = true;
  bool operator==(const plain_record&) const = default;
};

struct reading {
  std::vector<plain_record> records;
  tlog_counts counts;
};

// Reads to the end, and holds the reader to its promises: right checksums, offsets that rise, an end that stays.
[[nodiscard]] reading read_all(const mcap::byte_source& source);
[[nodiscard]] reading read_bytes(byte_view bytes);
[[nodiscard]] reading read_file(const std::filesystem::path& path);

// Puts a log together.
class log_builder {
public:
  log_builder& record(std::uint64_t timestamp_us, byte_view frame) { return time(timestamp_us).raw(frame); }
  log_builder& time(std::uint64_t timestamp_us);
  log_builder& raw(byte_view bytes);
  log_builder& raw_hex(std::string_view hex) { return raw(from_hex(hex)); }
  [[nodiscard]] const byte_buffer& bytes() const { return bytes_; }

private:
  byte_buffer bytes_;
};

// A frame of an id that nobody knows.
[[nodiscard]] byte_buffer unknown_frame(std::size_t payload_size);
// FRAME with INCOMPAT as its flags and a checksum that fits.
[[nodiscard]] byte_buffer with_flags(byte_buffer frame, std::uint8_t incompat);
// A MAVLink 1 heartbeat.
[[nodiscard]] byte_buffer v1_frame();

} // namespace godwit::io::mavlink::test
