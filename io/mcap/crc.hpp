// CRC-32 as MCAP uses it (IEEE 802.3, zlib's crc32). Thread: pure function.
#pragma once

#include <cstdint>

#include <zlib.h>

#include "io/mcap/format.hpp"

namespace godwit::io::mcap {

// Continues `crc` (0 to start) over `bytes`.
[[nodiscard]] inline std::uint32_t crc_of(byte_view bytes, std::uint32_t crc = 0) {
  if (bytes.empty()) {
    return crc; // zlib takes a null pointer as the wish to start anew, and an empty view may have one
  }
  return static_cast<std::uint32_t>(crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

} // namespace godwit::io::mcap
