// The MCAP container format, version 0: opcodes, sizes, and little-endian integers in byte buffers.
//
// A file is <magic><header>[data section]<data end>[summary][summary offsets]<footer><magic>; everything between the
// magics is records of <opcode: 1 byte><content length: 8 bytes><content>. Times are nanoseconds since an epoch of the
// user's choice. Thread: pure functions and values. Source: MCAP specification, https://mcap.dev/spec
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <zlib.h>

namespace godwit::io::mcap {

using byte_view = std::span<const std::byte>;
using byte_buffer = std::vector<std::byte>;
using string_map = std::map<std::string, std::string>;

enum class schema_id : std::uint16_t {};  // 0 means "no schema"
enum class channel_id : std::uint16_t {}; // 0 is a valid channel in files of others, ours start at 1

enum class opcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0A,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

inline constexpr std::array<std::byte, 8> magic{std::byte{0x89}, std::byte{'M'}, std::byte{'C'},  std::byte{'A'},
                                                std::byte{'P'},  std::byte{'0'}, std::byte{'\r'}, std::byte{'\n'}};

// Sizes of what has a fixed size, in bytes, record prefix included where it is a whole record.
inline constexpr std::size_t record_prefix_bytes = 1 + 8;
inline constexpr std::size_t message_fields_bytes = 2 + 4 + 8 + 8;
inline constexpr std::size_t chunk_header_bytes = record_prefix_bytes + 8 + 8 + 8 + 4 + 4 + 8; // no compression name
inline constexpr std::size_t message_index_header_bytes = record_prefix_bytes + 2 + 4;
inline constexpr std::size_t message_index_entry_bytes = 8 + 8;
inline constexpr std::size_t chunk_index_header_bytes = record_prefix_bytes + 4 * 8 + 4 + 8 + 4 + 8 + 8;
inline constexpr std::size_t channel_to_u64_entry_bytes = 2 + 8; // of Map<uint16, uint64>
inline constexpr std::size_t statistics_header_bytes = record_prefix_bytes + 8 + 2 + 4 * 4 + 8 + 8 + 4;
inline constexpr std::size_t summary_offset_bytes = record_prefix_bytes + 1 + 8 + 8;
inline constexpr std::size_t data_end_bytes = record_prefix_bytes + 4;
inline constexpr std::size_t footer_bytes = record_prefix_bytes + 8 + 8 + 4;

// Bounds of ours; the format itself has none.
inline constexpr std::size_t max_payload_bytes = std::size_t{1} << 20; // a trace record is some hundred bytes
inline constexpr std::size_t max_segment_bytes = std::size_t{8} << 20; // what a viewer loads without waiting

[[nodiscard]] inline byte_view bytes_of(std::string_view text) { return std::as_bytes(std::span{text}); }

template <std::unsigned_integral T>
void store(std::byte* at, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    at[i] = static_cast<std::byte>(value >> (8 * i));
  }
}

template <std::unsigned_integral T>
[[nodiscard]] T load(const std::byte* at) {
  T value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    value = static_cast<T>(value | static_cast<T>(static_cast<T>(at[i]) << (8 * i)));
  }
  return value;
}

inline void append_bytes(byte_buffer& out, byte_view bytes) { out.insert(out.end(), bytes.begin(), bytes.end()); }

template <std::unsigned_integral T>
void append_integer(byte_buffer& out, T value) {
  std::array<std::byte, sizeof(T)> encoded;
  store(encoded.data(), value);
  append_bytes(out, encoded);
}

inline void append_string(byte_buffer& out, std::string_view text) {
  append_integer(out, static_cast<std::uint32_t>(text.size()));
  append_bytes(out, bytes_of(text));
}

// Starts a record whose length is not known yet; give the returned position to end_record.
[[nodiscard]] inline std::size_t begin_record(byte_buffer& out, opcode op) {
  const std::size_t start = out.size();
  append_integer(out, static_cast<std::uint8_t>(op));
  append_integer(out, std::uint64_t{0});
  return start;
}

inline void end_record(byte_buffer& out, std::size_t start) {
  store(out.data() + start + 1, static_cast<std::uint64_t>(out.size() - start - record_prefix_bytes));
}

// CRC-32 as MCAP uses it (IEEE 802.3, zlib's crc32). Thread: pure function.

// Continues `crc` (0 to start) over `bytes`.
[[nodiscard]] inline std::uint32_t crc_of(byte_view bytes, std::uint32_t crc = 0) {
  if (bytes.empty()) {
    return crc; // zlib takes a null pointer as a request to start anew, and an empty view may have one
  }
  return static_cast<std::uint32_t>(crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

} // namespace godwit::io::mcap
