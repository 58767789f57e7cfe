// A broker for tests that does, byte for byte, what its script says, on a free port of 127.0.0.1: one connection after
// the other. It cuts the connection when the script returns, and every call of a script returns when it is destroyed.
//
// Errors: one that can not listen throws. Thread: the script runs in one of its own.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "tests/support/mqtt_bytes.hpp"

namespace godwit::tests::mqtt {

class peer_end {
public:
  explicit peer_end(int socket) : socket_(socket) {}

  // None: the publisher is gone.
  [[nodiscard]] std::optional<raw_packet> read();
  // False: the same.
  bool write(std::string_view bytes) const;
  // Reads on until the publisher closes, and gives its last packet.
  [[nodiscard]] std::optional<raw_packet> last();

private:
  int socket_;
  std::string bytes_;
  std::vector<raw_packet> packets_;
};

class peer {
public:
  // CONNECTION: 1, 2, 3, ...
  using script = std::function<void(peer_end& end, int connection)>;

  explicit peer(script what);
  peer(const peer&) = delete;
  peer& operator=(const peer&) = delete;
  ~peer();

  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] int connections() const { return connections_; }

private:
  void run();

  script script_;
  int listening_ = -1;
  std::uint16_t port_ = 0;
  std::atomic<int> connection_{-1};
  std::atomic<int> connections_{0};
  std::atomic<bool> is_ending_{false};
  std::thread thread_;
};

} // namespace godwit::tests::mqtt
