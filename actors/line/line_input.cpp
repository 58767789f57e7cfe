#include "actors/line/line_input.hpp"

#include <algorithm>
#include <charconv>

#include "io/fields/hex_text.hpp"
#include "io/mavlink/ids.hpp"
#include "io/mavlink/scanner.hpp"
#include "runtime/define_message.hpp"
#include "runtime/overloaded.hpp"

GODWIT_DEFINE_MESSAGES(godwit::line, line_input, line_drops);

namespace godwit::line {

line_input line_input::of(const line_news& news) {
  line_input result;
  std::visit(runtime::overloaded{[&](const io::link::link_status& status) {
                                   result.is_status = true;
                                   result.phase = status.phase;
                                   result.reason = status.reason;
                                   result.reconnects = status.reconnects;
                                 },
                                 [&](const io::link::arrival& came) {
                                   result.peer = came.peer;
                                   result.is_datagram = came.is_datagram;
                                   result.bytes = io::hex_of(came.bytes);
                                 }},
             news);
  return result;
}

line_news line_input::news() const {
  if (is_status)
    return io::link::link_status{phase, reason, reconnects};
  io::link::arrival result{peer, is_datagram, {}};
  for (std::size_t at = 0; at + 2 <= bytes.size(); at += 2) {
    std::uint8_t byte = 0;
    (void)std::from_chars(bytes.data() + at, bytes.data() + at + 2, byte, 16);
    result.bytes.push_back(std::byte{byte});
  }
  return result;
}

namespace {

using namespace io::mavlink;

constexpr std::uint32_t setup_signing_id = 256;

std::uint32_t id_in(const std::array<std::byte, header_size>& header) {
  return byte_at(header.data(), id_at) | static_cast<std::uint32_t>(byte_at(header.data(), id_at + 1)) << 8U |
         static_cast<std::uint32_t>(byte_at(header.data(), id_at + 2)) << 16U;
}

// Of a known message. In the middle of a frame that hardly ever stands there.
bool begins_with_header(std::span<const std::byte> bytes) {
  return bytes.size() >= header_size && bytes.front() == magic_v2 &&
         find_message(frame_view(bytes.data()).id()) != nullptr;
}

} // namespace

secret_eraser::followed& secret_eraser::find(io::link::peer_id peer) {
  const auto found = std::ranges::find(peers_, peer, &followed::peer);
  if (found != peers_.end())
    return *found;
  if (peers_.size() == max_peers)
    peers_.erase(peers_.begin());
  return peers_.emplace_back(followed{.peer = peer});
}

void secret_eraser::erase(io::link::peer_id peer, bool is_datagram, std::span<std::byte> bytes) {
  auto& in = find(peer);
  const bool begins_anew = begins_with_whole_frame(bytes) || (in.key_left == 0 && begins_with_header(bytes));
  if (is_datagram && begins_anew)
    in = {.peer = peer};
  for (auto& each : bytes)
    take(in, each);
}

void secret_eraser::take(followed& in, std::byte& each) {
  std::ranges::rotate(in.newest, in.newest.begin() + 1);
  in.newest.back() = each;
  const bool is_in_key = in.key_left > 0;
  const bool is_in_signature = in.frame_left > 0 && in.frame_left <= in.signature;
  if (in.key_left > 0)
    --in.key_left;
  if (in.frame_left > 0)
    --in.frame_left;
  else if (in.header_left == 0 && each == magic_v2)
    in.header_left = header_size - 1;
  else if (in.header_left > 0 && --in.header_left == 0)
    begin_frame(in);
  if (in.newest.front() == magic_v2 && id_in(in.newest) == setup_signing_id)
    in.key_left = byte_at(in.newest.data(), length_at);
  if (is_in_key || is_in_signature)
    each = std::byte{0};
}

void secret_eraser::begin_frame(followed& in) {
  const bool is_signed = (byte_at(in.newest.data(), incompat_at) & incompat_signed) != 0;
  in.signature = is_signed ? signature_size : 0;
  in.frame_left = frame_size(in.newest.data()) - header_size;
}

} // namespace godwit::line
