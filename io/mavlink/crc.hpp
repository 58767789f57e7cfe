// CRC-16/MCRF4XX, the checksum of MAVLink (called X.25 there): polynomial 0x1021 reflected, begins with 0xFFFF, result
// not inverted. The check value of "123456789" is 0x6F91.
//
// `crc_of_byte` and `crc_of_text` are the definition, used at compile time for CRC_EXTRA. `crc_of` gives the same
// sixteen bytes at a step, for frames. Source: the catalogue of parametrised CRC algorithms. Thread: pure.
#pragma once

#include <cstdint>
#include <string_view>

#include "io/mavlink/wire_format.hpp"

namespace godwit::io::mavlink {

inline constexpr std::uint16_t crc_init = 0xFFFF;

[[nodiscard]] constexpr std::uint16_t crc_of_byte(std::uint16_t crc, std::uint8_t byte) {
  constexpr std::uint16_t reflected_polynomial = 0x8408;
  crc = static_cast<std::uint16_t>(crc ^ byte);
  for (int bit = 0; bit < 8; ++bit)
    crc = static_cast<std::uint16_t>((crc >> 1U) ^ ((crc & 1U) != 0 ? reflected_polynomial : 0U));
  return crc;
}

[[nodiscard]] constexpr std::uint16_t crc_of_text(std::uint16_t crc, std::string_view text) {
  for (const char each : text)
    crc = crc_of_byte(crc, static_cast<std::uint8_t>(each));
  return crc;
}

// Continues CRC over BYTES.
[[nodiscard]] std::uint16_t crc_of(byte_view bytes, std::uint16_t crc = crc_init);

// The checksum of a frame: over what stands after its FD, the payload included, and then over CRC_EXTRA.
[[nodiscard]] std::uint16_t frame_crc(byte_view after_magic, std::uint8_t crc_extra);

} // namespace godwit::io::mavlink
