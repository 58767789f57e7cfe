// The shape of a MAVLink 2 frame in bytes (and of a MAVLink 1 frame, as far as it takes to skip one).
//
//   v2: FD len incompat compat seq sys comp id[3] payload[len] crc[2] (signature[13])
//   v1: FE len seq sys comp id payload[len] crc[2]
//
// Numbers are little-endian. Source: the MAVLink guide, "Packet Serialization". Thread: constants and pure functions.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace godwit::io::mavlink {

using byte_view = std::span<const std::byte>;

inline constexpr std::byte magic_v2{0xFD};
inline constexpr std::byte magic_v1{0xFE};

inline constexpr std::size_t header_size = 10; // from FD to the end of the id
inline constexpr std::size_t header_size_v1 = 6;
inline constexpr std::size_t crc_size = 2;
inline constexpr std::size_t signature_size = 13; // link id 1, timestamp 6, hash 6
inline constexpr std::size_t max_payload_size = 255;
inline constexpr std::size_t max_unsigned_frame_size = header_size + max_payload_size + crc_size; // 267
inline constexpr std::size_t max_frame_size = max_unsigned_frame_size + signature_size;           // 280
inline constexpr std::size_t min_frame_size = header_size + crc_size;                             // 12: no payload

// Where the parts of the v2 header stand.
inline constexpr std::size_t length_at = 1;
inline constexpr std::size_t incompat_at = 2;
inline constexpr std::size_t compat_at = 3;
inline constexpr std::size_t sequence_at = 4;
inline constexpr std::size_t system_at = 5;
inline constexpr std::size_t component_at = 6;
inline constexpr std::size_t id_at = 7;

inline constexpr std::uint8_t incompat_signed = 0x01; // the only incompatibility flag that is defined

// Fields are copied between wire and memory as they are, which is right on every machine that godwit runs on (x86-64,
// arm64). A big-endian one would need swaps in layout.hpp, crc.cpp and frame.hpp.
static_assert(std::endian::native == std::endian::little, "this codec copies little-endian numbers as they are");

[[nodiscard]] constexpr std::uint8_t byte_at(const std::byte* bytes, std::size_t index) {
  return std::to_integer<std::uint8_t>(bytes[index]);
}

// The size of the frame whose header begins at HEADER (at least 3 bytes of it): what the length and the signed flag
// say.
[[nodiscard]] constexpr std::size_t frame_size(const std::byte* header) {
  const bool is_signed = (byte_at(header, incompat_at) & incompat_signed) != 0;
  return min_frame_size + byte_at(header, length_at) + (is_signed ? signature_size : 0);
}

} // namespace godwit::io::mavlink
