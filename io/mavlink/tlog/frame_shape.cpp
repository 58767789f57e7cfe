#include "io/mavlink/tlog/frame_shape.hpp"

#include "io/mavlink/crc.hpp"
#include "io/mavlink/frame.hpp"
#include "io/mavlink/ids.hpp"

namespace godwit::io::mavlink {

namespace {

constexpr std::size_t id_at_v1 = 5;

looked_at look_v1(byte_view bytes) {
  if (bytes.size() < header_size_v1)
    return {frame_shape::cut_off, 0};
  const std::size_t crc_at = header_size_v1 + byte_at(bytes.data(), length_at);
  const std::size_t size = crc_at + crc_size;
  if (bytes.size() < size)
    return {frame_shape::cut_off, size};
  const message_info* const info = find_message(byte_at(bytes.data(), id_at_v1));
  if (info == nullptr)
    return {frame_shape::unknown_id, size};
  const unsigned crc = byte_at(bytes.data(), crc_at) | unsigned{byte_at(bytes.data(), crc_at + 1)} << 8U;
  const bool is_right = frame_crc(bytes.subspan(1, crc_at - 1), info->crc_extra) == crc;
  return {is_right ? frame_shape::v1 : frame_shape::bad_checksum, size};
}

looked_at look_v2(byte_view bytes) {
  if (bytes.size() < header_size)
    return {frame_shape::cut_off, 0};
  const std::size_t size = frame_size(bytes.data());
  if (bytes.size() < size)
    return {frame_shape::cut_off, size};
  const frame_view frame(bytes.data());
  const message_info* const info = find_message(frame.id());
  if (info == nullptr)
    return {frame_shape::unknown_id, size};
  if (!crc_matches(frame, info->crc_extra))
    return {frame_shape::bad_checksum, size};
  return {(frame.incompat() & ~incompat_signed) == 0 ? frame_shape::v2 : frame_shape::unknown_flags, size};
}

} // namespace

looked_at look(byte_view bytes) {
  if (!bytes.empty() && bytes.front() == magic_v2)
    return look_v2(bytes);
  if (!bytes.empty() && bytes.front() == magic_v1)
    return look_v1(bytes);
  return {};
}

} // namespace godwit::io::mavlink
