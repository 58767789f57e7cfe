// Bytes as hexadecimal digits. Thread: pure.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace godwit::trace_tool {

inline void append_hex(std::string& out, std::span<const std::byte> bytes) {
  constexpr char digits[] = "0123456789abcdef";
  for (const std::byte each : bytes) {
    out += digits[std::to_integer<unsigned>(each) >> 4U];
    out += digits[std::to_integer<unsigned>(each) & 0xFU];
  }
}

} // namespace godwit::trace_tool
