// Reads a file of frames as a link would: scans, judges the signatures, decodes, and describes what it found.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tests/peers/mavlink/described_frame.hpp"

namespace godwit::io::mavlink::peers {

// A description of every frame in BYTES that holds one of our messages.
[[nodiscard]] std::vector<described_frame> read_frames(std::span<const std::byte> bytes);

} // namespace godwit::io::mavlink::peers
