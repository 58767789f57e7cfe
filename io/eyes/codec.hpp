// A message between the daemon and its eyes as bytes: one datagram each.
//
//   'g' 'e' | version u8 | kind u8 | length of the body u32, little-endian | body: JSON by the field table
//
// JSON, because a person who looks at the socket with strace can read it, and the fields and their checks are written
// once; there are some fifty small messages a second (docs/decisions/0055-detector-in-its-own-process.md). Errors:
// whatever arrives, a value with what is wrong; never a crash, and nothing is allocated beyond a few times the bytes
// that came. Thread: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <tl/expected.hpp>

#include "io/eyes/messages.hpp"

namespace godwit::io::eyes {

inline constexpr std::uint8_t protocol_version = 1;
inline constexpr std::size_t head_bytes = 8;
inline constexpr std::size_t max_datagram_bytes = 64 * 1024;

enum class decode_errc {
  too_short,
  too_long,
  no_message,    // it does not begin as one
  wrong_version, // the two programs are of different builds
  wrong_length,
  unknown_kind,
  unreadable, // the body is no such message
  impossible  // it is one, with values that can not be
};

struct decode_error {
  decode_errc code = decode_errc::no_message;
  std::string what; // a sentence without a full stop
};

// A message that is too long for a datagram is a broken invariant: all lists and texts have bounds (`clipped`).
[[nodiscard]] std::string encode(const message& said);

[[nodiscard]] tl::expected<message, decode_error> decode(std::span<const std::byte> datagram);

// What can not be in a message, as a sentence; empty: nothing.
[[nodiscard]] std::string problem_of(const message& said);

// TEXT as it may stand in a message: not too long, and cut between characters.
[[nodiscard]] std::string clipped(std::string text);

} // namespace godwit::io::eyes
