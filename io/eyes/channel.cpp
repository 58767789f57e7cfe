#include "io/eyes/channel.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <string>

#include <sys/socket.h>

namespace godwit::io::eyes {

send_result channel::send(const message& said) const {
  const auto bytes = encode(said);
  for (;;) {
    if (::send(socket_.number(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL) >= 0)
      return send_result::sent;
    if (errno == EINTR)
      continue;
    return errno == EAGAIN || errno == EWOULDBLOCK || errno == ENOBUFS ? send_result::no_room : send_result::closed;
  }
}

tl::expected<received, decode_error> channel::receive() {
  for (;;) {
    // MSG_TRUNC: the length that the datagram had.
    const auto count = ::recv(socket_.number(), buffer_.data(), buffer_.size(), MSG_DONTWAIT | MSG_TRUNC);
    if (count < 0 && errno == EINTR)
      continue;
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK))
      return received{};
    if (count <= 0)
      return received{{}, true};
    const auto length = static_cast<std::size_t>(count);
    if (length > buffer_.size())
      return tl::unexpected(decode_error{decode_errc::too_long, "a message is longer than may be"});
    return decode(std::span(buffer_).first(length)).map([](message&& said) { return received{std::move(said)}; });
  }
}

tl::expected<std::pair<channel, channel>, std::string> make_channel_pair() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return tl::make_unexpected(std::string("no socket pair can be made: ") + std::strerror(errno));
  return std::pair(channel(link::descriptor(ends[0])), channel(link::descriptor(ends[1])));
}

} // namespace godwit::io::eyes
