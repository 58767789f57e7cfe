// One datagram to the system, from any thread, without blocking.
//
// Asio's own sockets must not be shared between threads, so senders use the descriptor, under the lock of their link.
// Source: send(2).
#pragma once

#include <cerrno>
#include <cstddef>
#include <span>

#include <sys/socket.h>

namespace godwit::io::link {

// The error number, 0 for none. TO is null on a connected socket.
[[nodiscard]] inline int send_datagram(int descriptor, std::span<const std::byte> bytes, const sockaddr* to,
                                       socklen_t to_size) {
  for (;;) {
    if (::sendto(descriptor, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL, to, to_size) >= 0)
      return 0;
    if (errno != EINTR)
      return errno;
  }
}

} // namespace godwit::io::link
