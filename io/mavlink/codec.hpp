// From a message to a frame and back.
//
//   const frame_buffer frame = encode(heartbeat{.type = 18}, sender{255, 190}, sequence++);
//   if (view.id() == mission_count::message_id) use(decode<mission_count>(view));
//
// Decoding takes payloads whose zeros were cut off, whose zeros were not, and longer ones of a newer definition, of
// which it ignores the surplus. It trusts that the checksum was verified. Thread: pure.
#pragma once

#include <algorithm>
#include <array>

#include "io/mavlink/frame.hpp"
#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

enum class signing { off, on };

// The frame of MESSAGE. With signing::on it carries the signed flag, and waits for frame_buffer::append_signature.
template <message M>
[[nodiscard]] frame_buffer encode(const M& message, sender from, std::uint8_t sequence, signing sign = signing::off) {
  std::array<std::byte, layout<M>::full_length> payload;
  write_fields(message, payload.data());
  return {M::message_id, M::crc_extra, payload, from, sequence, sign == signing::on};
}

// The fields of M from PAYLOAD, whatever its length: an empty one has only zeros.
template <message M>
[[nodiscard]] M decode_payload(byte_view payload) {
  constexpr auto full = layout<M>::full_length;
  if (payload.size() >= full)
    return read_fields<M>(payload.data());
  std::array<std::byte, full> padded{};
  std::ranges::copy(payload, padded.begin());
  return read_fields<M>(padded.data());
}

// FRAME as an M. The caller has looked at its id.
template <message M>
[[nodiscard]] M decode(const frame_view& frame) {
  return decode_payload<M>(frame.payload());
}

} // namespace godwit::io::mavlink
