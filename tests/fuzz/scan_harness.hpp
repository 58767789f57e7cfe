// What must hold for any bytes that a scanner and a codec are given; the fuzzer tries bytes, and a test plants defects
// to show that they are found.
//
// An input is three bytes and a stream: the first two choose the sizes of the pieces in which the stream is fed, the
// third whether checksums are made right first, without which hardly any changed frame would get past them. Then:
//
//   - pieces of any sizes give the same frames as the whole;
//   - the frames are those that a search from byte to byte finds, where nothing was passed over unverified;
//   - a message read, written, read and written again is the same bytes, and they are those that came, with the zeros
//     at the end cut off and the surplus ignored.
//
// The scanner and the codec are passed in as types. Thread: pure.
#pragma once

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/crc.hpp"
#include "io/mavlink/ids.hpp"
#include "io/mavlink/messages.hpp"
#include "io/mavlink/scanner.hpp"

namespace godwit::io::mavlink::fuzz {

using byte_buffer = std::vector<std::byte>;
using finding = std::optional<std::string>; // what does not hold

// The codec as it is; a test passes one with a defect.
struct real_codec {
  template <message M>
  static M decode(const frame_view& frame) {
    return mavlink::decode<M>(frame);
  }
};

inline constexpr std::size_t control_size = 3;

// Makes the checksum of each frame of a known id right, going from frame to frame by their lengths.
inline void repair(byte_buffer& stream) {
  for (std::size_t at = 0; at + min_frame_size <= stream.size();) {
    const auto size = frame_size(stream.data() + at);
    if (stream[at] != magic_v2 || at + size > stream.size()) {
      ++at;
      continue;
    }
    const frame_view frame(stream.data() + at);
    if (const auto* const info = find_message(frame.id())) {
      const auto covered = header_size - 1 + frame.payload().size();
      const auto crc = frame_crc(byte_view(stream).subspan(at + 1, covered), info->crc_extra);
      std::memcpy(stream.data() + at + 1 + covered, &crc, crc_size);
    }
    at += size;
  }
}

// The plainest search there is: a byte on, wherever no good frame begins.
inline std::vector<byte_buffer> search_byte_by_byte(byte_view stream) {
  std::vector<byte_buffer> found;
  while (stream.size() >= min_frame_size) {
    const auto size = frame_size(stream.data());
    if (stream.front() == magic_v2 && size <= stream.size()) {
      const frame_view frame(stream.data());
      const auto* const info = find_message(frame.id());
      if (info != nullptr && crc_matches(frame, info->crc_extra)) {
        found.emplace_back(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(size));
        stream = stream.subspan(size);
        continue;
      }
    }
    stream = stream.subspan(1);
  }
  return found;
}

// The payload as our own encoder would send it, worked out without the codec.
inline byte_buffer canonical_payload(byte_view payload, std::size_t full_length) {
  byte_buffer result(payload.begin(), payload.end());
  result.resize(full_length);
  while (result.size() > 1 && result.back() == std::byte{0})
    result.pop_back();
  return result;
}

template <class Codec, message M>
finding check_message(const frame_view& frame) {
  const auto first = encode(Codec::template decode<M>(frame), frame.from(), frame.sequence());
  const auto second = encode(Codec::template decode<M>(first.view()), frame.from(), frame.sequence());
  if (!std::ranges::equal(first.span(), second.span()))
    return std::string(type_name<M>()) + " changes when it is read and written twice";
  const auto expected = canonical_payload(frame.payload(), layout<M>::full_length);
  if (!std::ranges::equal(first.view().payload(), expected))
    return std::string(type_name<M>()) + " is not what came";
  return std::nullopt;
}

template <class Codec>
finding check_frame(const byte_buffer& bytes) {
  const auto frame = view_of(bytes);
  if (!frame)
    return "not a whole frame";
  finding result;
  known_messages::for_each([&]<message M>() {
    if (!result && frame->id() == M::message_id)
      result = check_message<Codec, M>(*frame);
  });
  return result;
}

template <class Scanner, class NextSize>
std::vector<byte_buffer> frames_of(Scanner& scan, byte_view stream, NextSize next_size) {
  std::vector<byte_buffer> result;
  const auto sink = [&](const frame_view& frame) { result.emplace_back(frame.bytes().begin(), frame.bytes().end()); };
  while (!stream.empty()) {
    const auto size = std::min<std::size_t>(next_size(), stream.size());
    scan.feed(stream.first(size), sink);
    stream = stream.subspan(size);
  }
  scan.end_of_datagram(sink);
  return result;
}

template <class Scanner = scanner, class Codec = real_codec>
finding check(byte_view input) {
  if (input.size() < control_size)
    return std::nullopt;
  byte_buffer stream(input.begin() + control_size, input.end());
  if ((byte_at(input.data(), 2) & 1U) == 0)
    repair(stream);

  Scanner of_whole;
  const auto whole = frames_of(of_whole, stream, [&] { return stream.size(); });
  auto state = static_cast<std::uint32_t>(byte_at(input.data(), 0));
  const auto largest = 1U + byte_at(input.data(), 1);
  Scanner of_pieces;
  const auto pieces = frames_of(of_pieces, stream, [&] {
    state = state * 1664525U + 1013904223U; // a generator of two constants, so that a finding can be run again
    return 1U + (state >> 16U) % largest;
  });
  if (pieces != whole)
    return "pieces give other frames than the whole";

  const scan_counters& counters = of_whole.counters();
  const bool all_verified = counters.unknown_id == 0 && counters.unknown_flag == 0 && counters.v1_frames == 0;
  if (all_verified && whole != search_byte_by_byte(stream))
    return "not the frames that lie in the stream";
  for (const auto& frame : whole)
    if (auto found = check_frame<Codec>(frame))
      return found;
  return std::nullopt;
}

} // namespace godwit::io::mavlink::fuzz
