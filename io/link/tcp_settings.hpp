// How a TCP connection of a link is set: small frames go out at once (TCP_NODELAY), it does not block, and a peer that
// has vanished without a word ends the connection after `vanished_after` instead of the quarter of an hour that TCP
// allows. Thread: pure. Source: tcp(7).
#pragma once

#include <chrono>
#include <cstddef>
#include <span>

#include <boost/asio/ip/tcp.hpp>
#include <sys/types.h>

namespace godwit::io::link {

// Five heartbeats, after which a vehicle counts as lost anyway.
inline constexpr std::chrono::seconds tcp_peer_vanished_after{5};

[[nodiscard]] boost::system::error_code set_up_tcp(boost::asio::ip::tcp::socket& socket);

// As write(2), but never blocks and never raises SIGPIPE.
[[nodiscard]] ssize_t write_tcp(int stream, std::span<const std::byte> bytes);

} // namespace godwit::io::link
