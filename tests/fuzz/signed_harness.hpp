// What must hold for any sequence of frames that a verifier judges; the fuzzer tries bytes, and a test plants defects
// to show that they are found.
//
// An input is a sequence of steps of five bytes and a frame:
//
//   what to do 1 | our clock moves by 1, in 8 s | timestamp 2, in seconds from our time | bit to flip 1 | frame
//
// Bits of the first: make the checksum right; write the timestamp; make the hash right; flip a bit of the signature
// after that; the frame is signed. Without this help hardly any changed frame would get past the signature. The frame
// is given its FD, and its length says where the next step begins. Then:
//
//   - a frame is called wrongly signed exactly if its hash, worked out in another way, is wrong;
//   - no timestamp is accepted that is not above all accepted of its stream, or outside of the bounds;
//   - none is refused without the reason that is given; while there are places for all streams, the verdict is the one
//     of the plain rules;
//   - taking the signature off changes the flag and the checksum, which is right exactly if it was, and nothing else.
//
// The verifier is passed in as a type. Thread: pure.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <tuple>

#include <openssl/evp.h>

#include "io/mavlink/signing/strip_signature.hpp"
#include "io/mavlink/signing/verifier.hpp"
#include "tests/fuzz/scan_harness.hpp"

namespace godwit::io::mavlink::fuzz {

enum signed_step : unsigned {
  repair_checksum = 1,
  write_timestamp = 2,
  repair_hash = 4,
  flip_bit = 8,
  set_signed_flag = 16,
};

inline constexpr std::size_t step_control_size = 5;
inline constexpr signing_time clock_at_start{36'093'000'000'000}; // in 2026

inline std::array<std::byte, secret_key_size> harness_key() {
  std::array<std::byte, secret_key_size> key{};
  for (std::size_t i = 0; i < key.size(); ++i)
    key[i] = static_cast<std::byte>(i);
  return key;
}

// The hash over a copy of everything in one piece.
inline signature_hash hash_in_one_piece(const frame_view& frame) {
  const auto key = harness_key();
  byte_buffer all(key.begin(), key.end());
  all.insert(all.end(), frame.bytes().begin(), frame.bytes().end() - signature_hash_size);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  EVP_Digest(all.data(), all.size(), digest.data(), nullptr, EVP_sha256(), nullptr);
  signature_hash hash;
  std::memcpy(hash.data(), digest.data(), hash.size());
  return hash;
}

inline signing_time moved(signing_time from, std::int64_t seconds) {
  const auto by = seconds * static_cast<std::int64_t>(signing_units_per_s);
  return signing_time{static_cast<std::uint64_t>(static_cast<std::int64_t>(units(from)) + by)};
}

// What the rules say of the frames so far, without the bound on streams.
class plain_rules {
public:
  finding check(const frame_view& frame, verdict found, signing_time now) {
    if (!frame.is_signed()) {
      const auto right =
          frame.id() == radio_status::message_id ? verdict::accepted_unsigned : verdict::unsigned_refused;
      return found == right ? finding() : "an unsigned frame was judged against the policy";
    }
    const auto block = signature_of(frame);
    if ((block.hash == hash_in_one_piece(frame)) != (found != verdict::bad_signature))
      return "a hash was judged wrongly";
    if (found == verdict::bad_signature)
      return std::nullopt;
    const auto stream = std::make_tuple(frame.system(), frame.component(), block.link);
    const auto last = last_.find(stream);
    const bool is_known = last != last_.end();
    const auto right = right_verdict(block.time, now, is_known ? &last->second : nullptr);
    if (found == verdict::accepted_signed && right != verdict::accepted_signed &&
        !(is_known && right == verdict::too_old))
      return "a frame was accepted against the rules";
    if (last_.size() + (is_known ? 0 : 1) <= max_signed_streams && found != right)
      return "the verdict is not the one of the rules";
    if (found == verdict::replayed && block.time > highest_)
      return "called replayed, and newer than all before";
    if (found == verdict::accepted_signed) {
      last_[stream] = block.time;
      highest_ = std::max(highest_, block.time);
    }
    return std::nullopt;
  }

private:
  static verdict right_verdict(signing_time time, signing_time now, const signing_time* last) {
    if (units(time) > units(now) + max_ahead)
      return verdict::too_new;
    if (last != nullptr)
      return time > *last ? verdict::accepted_signed : verdict::replayed;
    return units(time) + max_behind < units(now) ? verdict::too_old : verdict::accepted_signed;
  }

  std::map<std::tuple<std::uint8_t, std::uint8_t, link_id>, signing_time> last_;
  signing_time highest_{};
};

inline finding check_stripped(const frame_view& frame) {
  unsigned_frame_bytes memory;
  const frame_view bare = strip_signature(frame, memory);
  if (bare.is_signed() || bare.size() != frame.size() - (frame.is_signed() ? signature_size : 0))
    return "the signature was not taken off";
  byte_buffer put_back(bare.bytes().begin(), bare.bytes().end());
  put_back[incompat_at] = frame.bytes()[incompat_at];
  if (!std::ranges::equal(byte_view(put_back).first(put_back.size() - crc_size),
                          frame.bytes().first(put_back.size() - crc_size)))
    return "more than the flag changed with the signature";
  for (const unsigned crc_extra : {0U, 50U, 255U})
    if (crc_matches(bare, static_cast<std::uint8_t>(crc_extra)) !=
        crc_matches(frame, static_cast<std::uint8_t>(crc_extra)))
      return "the checksum did not stay as right or wrong as it was";
  return std::nullopt;
}

// The frame of one step, made as its control bytes say.
inline byte_buffer make_frame(byte_view control, byte_view bytes, signing_time now) {
  const unsigned what = byte_at(control.data(), 0);
  byte_buffer frame(bytes.begin(), bytes.end());
  if ((what & repair_checksum) != 0)
    repair(frame);
  if (!frame_view(frame.data()).is_signed())
    return frame;
  auto* const signature = frame.data() + frame.size() - signature_size;
  if ((what & write_timestamp) != 0) {
    std::int16_t seconds = 0;
    std::memcpy(&seconds, control.data() + 2, sizeof seconds);
    store_signing_time(std::span<std::byte, signing_time_size>(signature + 1, signing_time_size),
                       moved(now, seconds / 64));
  }
  if ((what & repair_hash) != 0) {
    const auto hash = hash_in_one_piece(frame_view(frame.data()));
    std::ranges::copy(hash, signature + signature_size - signature_hash_size);
  }
  if ((what & flip_bit) != 0) {
    const unsigned bit = byte_at(control.data(), 4) % (8 * signature_size);
    signature[bit / 8] ^= std::byte{1} << (bit % 8);
  }
  return frame;
}

template <class Verifier = verifier>
finding check_signed(byte_view input) {
  replay_table streams;
  Verifier in(secret_key(harness_key()), streams);
  plain_rules rules;
  signing_time now = clock_at_start;
  while (input.size() >= step_control_size + min_frame_size) {
    const auto control = input.first(step_control_size);
    byte_buffer rest(input.begin() + step_control_size, input.end());
    rest[0] = magic_v2;
    const bool is_signed = (byte_at(control.data(), 0) & set_signed_flag) != 0;
    rest[incompat_at] = is_signed ? std::byte{incompat_signed} : std::byte{0};
    const std::size_t size = frame_size(rest.data());
    if (size > rest.size())
      return std::nullopt;
    now = moved(now, std::int64_t{8} * static_cast<std::int8_t>(byte_at(control.data(), 1)));
    const auto bytes = make_frame(control, byte_view(rest).first(size), now);
    const frame_view frame(bytes.data());
    const verdict found = in.judge(frame, now);
    if (auto wrong = rules.check(frame, found, now))
      return wrong;
    if (auto wrong = check_stripped(frame))
      return wrong;
    if (streams.streams() > max_signed_streams)
      return "the table has more streams than places";
    input = input.subspan(step_control_size + size);
  }
  return std::nullopt;
}

} // namespace godwit::io::mavlink::fuzz
