#include "actors/line/secret_eraser.hpp"

#include <algorithm>

namespace godwit::line {

namespace {

using namespace io::mavlink;

constexpr std::uint32_t setup_signing_id = 256;

std::uint32_t id_in(const std::array<std::byte, header_size>& header) {
  return byte_at(header.data(), id_at) | static_cast<std::uint32_t>(byte_at(header.data(), id_at + 1)) << 8U |
         static_cast<std::uint32_t>(byte_at(header.data(), id_at + 2)) << 16U;
}

} // namespace

void secret_eraser::erase(io::link::peer_id peer, bool is_datagram, std::span<std::byte> bytes) {
  if (is_datagram || peer != peer_)
    *this = {};
  peer_ = peer;
  for (auto& each : bytes)
    take(each);
}

void secret_eraser::take(std::byte& each) {
  std::ranges::rotate(newest_, newest_.begin() + 1);
  newest_.back() = each;
  const bool is_in_key = key_left_ > 0;
  const bool is_in_signature = frame_left_ > 0 && frame_left_ <= signature_;
  if (key_left_ > 0)
    --key_left_;
  if (frame_left_ > 0)
    --frame_left_;
  else if (header_left_ == 0 && each == magic_v2)
    header_left_ = header_size - 1;
  else if (header_left_ > 0 && --header_left_ == 0)
    begin_frame();
  if (newest_.front() == magic_v2 && id_in(newest_) == setup_signing_id)
    key_left_ = byte_at(newest_.data(), length_at);
  if (is_in_key || is_in_signature)
    each = std::byte{0};
}

void secret_eraser::begin_frame() {
  const bool is_signed = (byte_at(newest_.data(), incompat_at) & incompat_signed) != 0;
  signature_ = is_signed ? signature_size : 0;
  frame_left_ = frame_size(newest_.data()) - header_size;
}

} // namespace godwit::line
