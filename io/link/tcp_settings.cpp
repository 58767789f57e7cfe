#include "io/link/tcp_settings.hpp"

#include <netinet/tcp.h>
#include <sys/socket.h>

namespace godwit::io::link {

boost::system::error_code set_up_tcp(boost::asio::ip::tcp::socket& socket) {
  using unacknowledged_for = boost::asio::detail::socket_option::integer<IPPROTO_TCP, TCP_USER_TIMEOUT>;
  using first_probe_after = boost::asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPIDLE>;
  using next_probe_after = boost::asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPINTVL>;
  using std::chrono::milliseconds;
  boost::system::error_code error;
  socket.non_blocking(true, error);
  if (!error)
    socket.set_option(boost::asio::ip::tcp::no_delay(true), error);
  if (!error)
    socket.set_option(unacknowledged_for(static_cast<int>(milliseconds(tcp_peer_vanished_after).count())), error);
  // Probes find a peer that vanished while we had nothing to send; how many is for TCP_USER_TIMEOUT to say.
  if (!error)
    socket.set_option(boost::asio::socket_base::keep_alive(true), error);
  if (!error)
    socket.set_option(first_probe_after(1), error);
  if (!error)
    socket.set_option(next_probe_after(1), error);
  return error;
}

ssize_t write_tcp(int stream, std::span<const std::byte> bytes) {
  return ::send(stream, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

} // namespace godwit::io::link
