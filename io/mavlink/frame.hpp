// One MAVLink 2 frame: a view of one that lies somewhere, and a buffer that owns one.
//
// A view is two words and reads its parts from the bytes; it does not own them. Whoever makes a view has checked that
// the bytes are one whole frame (the scanner does, and `view_of` for a single one); the checksum is not the view's
// business. Thread: values.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>

#include "io/mavlink/wire_format.hpp"

namespace godwit::io::mavlink {

// Who speaks: MAVLink's system and component id.
struct sender {
  std::uint8_t system = 0;
  std::uint8_t component = 0;
  friend constexpr bool operator==(const sender&, const sender&) = default;
};

class frame_view {
public:
  // BEGIN is the FD of a whole frame, or of a header at least if nothing after the header is asked for.
  explicit constexpr frame_view(const std::byte* begin) : begin_(begin), size_(frame_size(begin)) {}

  [[nodiscard]] byte_view bytes() const { return {begin_, size_}; }
  [[nodiscard]] std::size_t size() const { return size_; }

  [[nodiscard]] std::uint8_t incompat() const { return byte_at(begin_, incompat_at); }
  [[nodiscard]] std::uint8_t sequence() const { return byte_at(begin_, sequence_at); }
  [[nodiscard]] std::uint8_t system() const { return byte_at(begin_, system_at); }
  [[nodiscard]] std::uint8_t component() const { return byte_at(begin_, component_at); }
  [[nodiscard]] sender from() const { return {system(), component()}; }

  [[nodiscard]] std::uint32_t id() const {
    std::uint32_t with_sender = 0; // four bytes that end with the id: one load
    std::memcpy(&with_sender, begin_ + id_at - 1, sizeof with_sender);
    return with_sender >> 8U;
  }

  // As it came: zeros at its end may be cut off, and it may be longer than the message is known to be.
  [[nodiscard]] byte_view payload() const { return {begin_ + header_size, byte_at(begin_, length_at)}; }

  [[nodiscard]] std::uint16_t crc() const {
    std::uint16_t value = 0;
    std::memcpy(&value, begin_ + header_size + byte_at(begin_, length_at), sizeof value);
    return value;
  }

  [[nodiscard]] bool is_signed() const { return (incompat() & incompat_signed) != 0; }

  // Link id, timestamp and hash; empty if the frame is not signed.
  [[nodiscard]] byte_view signature() const { return is_signed() ? bytes().last<signature_size>() : byte_view(); }

private:
  const std::byte* begin_;
  std::size_t size_;
};

// BYTES as a frame if they are exactly one by magic and length. The checksum is not looked at.
[[nodiscard]] std::optional<frame_view> view_of(byte_view bytes);

// True if the checksum of FRAME is right for a message with CRC_EXTRA.
[[nodiscard]] bool crc_matches(const frame_view& frame, std::uint8_t crc_extra);

// One frame with its memory. Never empty: `encode` makes it, complete but for the signature of a frame that is to be
// signed.
class frame_buffer {
public:
  // Header, payload without the zeros at its end (its first byte always stays), checksum. SIGNED_FLAG sets the flag
  // that announces a signature, which the checksum covers; `append_signature` must follow.
  frame_buffer(std::uint32_t id, std::uint8_t crc_extra, byte_view payload, sender from, std::uint8_t sequence,
               bool signed_flag);

  [[nodiscard]] byte_view span() const { return {bytes_.data(), size_}; }
  [[nodiscard]] std::size_t size() const { return size_; }
  // True once nothing is missing: the frame is not to be signed, or is.
  [[nodiscard]] bool is_complete() const { return size_ == frame_size(bytes_.data()); }
  // Only of a complete frame.
  [[nodiscard]] frame_view view() const;

  // Only once, and only on a frame that was made with the signed flag.
  void append_signature(std::span<const std::byte, signature_size> signature);

private:
  std::uint16_t size_ = 0;
  std::array<std::byte, max_frame_size> bytes_; // not set to zero: only the first size_ bytes are ever read
};

} // namespace godwit::io::mavlink
