// Bytes as hexadecimal digits, small letters. Thread: pure.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace godwit::io {

inline void append_hex(std::string& out, std::span<const std::byte> bytes) {
  constexpr char digits[] = "0123456789abcdef";
  for (const std::byte each : bytes) {
    out += digits[std::to_integer<unsigned>(each) >> 4U];
    out += digits[std::to_integer<unsigned>(each) & 0xFU];
  }
}

[[nodiscard]] inline std::string hex_of(std::span<const std::byte> bytes) {
  std::string result;
  append_hex(result, bytes);
  return result;
}

} // namespace godwit::io
