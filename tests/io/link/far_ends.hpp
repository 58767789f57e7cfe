// The other ends of links: plain sockets and pseudo-terminals, with nothing of ours in them. Each throws when the
// system refuses something, which fails the test.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/link/descriptor.hpp"

namespace godwit::io::link::testing {

// A UDP socket on 127.0.0.1.
class udp_end {
public:
  explicit udp_end(std::uint16_t port = 0); // 0: a free one
  [[nodiscard]] std::uint16_t port() const { return port_; }
  void send(std::uint16_t port, std::string_view text) const;
  // Waits for a datagram with `patience`.
  [[nodiscard]] std::optional<std::string> receive() const;
  // The port that the last datagram came from.
  [[nodiscard]] std::uint16_t last_sender() const { return last_sender_; }

private:
  descriptor socket_;
  std::uint16_t port_ = 0;
  mutable std::uint16_t last_sender_ = 0;
};

// A port of 127.0.0.1 on which nobody listens.
[[nodiscard]] std::uint16_t unused_udp_port();

// A pseudo-terminal behind a symbolic link: the line that a serial link opens.
class serial_line {
public:
  serial_line();
  ~serial_line();
  serial_line(const serial_line&) = delete;
  serial_line& operator=(const serial_line&) = delete;

  [[nodiscard]] std::string path() const { return path_.string(); }
  [[nodiscard]] std::string uri() const { return "serial://" + path() + ":57600"; }
  void unplug();  // hangs up, and the name goes
  void hang_up(); // hangs up, and the name stays and leads nowhere
  void plug_in(); // a new pseudo-terminal under the old name
  void write(std::string_view text) const;
  // Waits for so many bytes with `patience`.
  [[nodiscard]] std::string read(std::size_t bytes) const;

private:
  std::filesystem::path folder_;
  std::filesystem::path path_;
  descriptor master_;
};

// A listening TCP socket on 127.0.0.1 that takes one connection at a time.
class tcp_end {
public:
  // BACKLOG: connections that wait to be accepted; when there are more, the system does not answer new ones.
  explicit tcp_end(std::uint16_t port = 0, int backlog = 8);
  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] std::string uri() const { return "tcp://127.0.0.1:" + std::to_string(port_); }
  void accept(); // waits with `patience`
  void close() { connection_.reset(); }
  void write(std::string_view text) const;
  [[nodiscard]] std::string read(std::size_t bytes) const;

private:
  descriptor listener_;
  descriptor connection_;
  std::uint16_t port_ = 0;
};

// A TCP socket that is connected to a port of 127.0.0.1.
class tcp_caller {
public:
  explicit tcp_caller(std::uint16_t port);
  void write(std::string_view text) const;
  // Waits for so many bytes with `patience`; fewer if the other side has closed the connection.
  [[nodiscard]] std::string read(std::size_t bytes) const;
  // Waits with `patience` for the end of the connection, with nothing before it.
  [[nodiscard]] bool is_hung_up() const;
  // Without waiting.
  [[nodiscard]] bool has_bytes() const;

private:
  descriptor connection_;
};

} // namespace godwit::io::link::testing
