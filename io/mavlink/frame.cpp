#include "io/mavlink/frame.hpp"

#include <cassert>

#include "io/mavlink/crc.hpp"

namespace godwit::io::mavlink {

namespace {

// The length of PAYLOAD without the zeros at its end; the first byte stays also when it is zero.
std::size_t trimmed_length(byte_view payload) {
  std::size_t length = payload.size();
  while (length > 1 && payload[length - 1] == std::byte{0})
    --length;
  return length;
}

} // namespace

std::optional<frame_view> view_of(byte_view bytes) {
  if (bytes.size() < min_frame_size || bytes.front() != magic_v2 || bytes.size() != frame_size(bytes.data()))
    return std::nullopt;
  return frame_view(bytes.data());
}

bool crc_matches(const frame_view& frame, std::uint8_t crc_extra) {
  const auto covered = header_size + frame.payload().size() - 1;
  return frame_crc(frame.bytes().subspan(1, covered), crc_extra) == frame.crc();
}

frame_buffer::frame_buffer(std::uint32_t id, std::uint8_t crc_extra, byte_view payload, sender from,
                           std::uint8_t sequence, bool signed_flag) {
  const auto length = trimmed_length(payload);
  const std::array<std::uint8_t, header_size> header{std::to_integer<std::uint8_t>(magic_v2),
                                                     static_cast<std::uint8_t>(length),
                                                     signed_flag ? incompat_signed : std::uint8_t{0},
                                                     0,
                                                     sequence,
                                                     from.system,
                                                     from.component,
                                                     static_cast<std::uint8_t>(id),
                                                     static_cast<std::uint8_t>(id >> 8U),
                                                     static_cast<std::uint8_t>(id >> 16U)};
  std::memcpy(bytes_.data(), header.data(), header_size);
  if (length != 0)
    std::memcpy(bytes_.data() + header_size, payload.data(), length);
  const auto crc = frame_crc({bytes_.data() + 1, header_size - 1 + length}, crc_extra);
  std::memcpy(bytes_.data() + header_size + length, &crc, crc_size);
  size_ = static_cast<std::uint16_t>(min_frame_size + length);
}

frame_view frame_buffer::view() const {
  assert(is_complete());
  return frame_view(bytes_.data());
}

void frame_buffer::append_signature(std::span<const std::byte, signature_size> signature) {
  assert(size_ + signature_size == frame_size(bytes_.data()));
  std::memcpy(bytes_.data() + size_, signature.data(), signature_size);
  size_ = static_cast<std::uint16_t>(size_ + signature_size);
}

} // namespace godwit::io::mavlink
