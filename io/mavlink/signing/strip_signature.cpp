#include "io/mavlink/signing/strip_signature.hpp"

#include <cstring>

#include "io/mavlink/crc.hpp"

namespace godwit::io::mavlink {

namespace {

// What the signed flag adds to the checksum of a frame with a payload of LENGTH bytes: the checksum, begun with 0, of
// a frame in which nothing but this flag is set. CRC_EXTRA is one byte more after it.
std::uint16_t crc_of_flag(std::size_t length) {
  static constexpr std::array<std::byte, header_size + max_payload_size + 1> flag{std::byte{incompat_signed}};
  return crc_of(byte_view(flag).first(header_size - incompat_at + length + 1), 0);
}

} // namespace

frame_view strip_signature(const frame_view& frame, unsigned_frame_bytes& to) {
  if (!frame.is_signed())
    return frame;
  const std::size_t length = frame.payload().size();
  std::memcpy(to.data(), frame.bytes().data(), header_size + length);
  to[incompat_at] &= ~std::byte{incompat_signed};
  const auto crc = static_cast<std::uint16_t>(frame.crc() ^ crc_of_flag(length));
  std::memcpy(to.data() + header_size + length, &crc, crc_size);
  return frame_view(to.data());
}

} // namespace godwit::io::mavlink
