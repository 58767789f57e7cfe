// Where the operator's port listens, and what it bears. Errors: sentences. Thread: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

namespace godwit::operator_port {

struct settings {
  std::string host;               // an address of this computer itself, without brackets
  std::uint16_t port = 0;         // 0: any free one
  std::vector<std::string> hosts; // further names under which it may be asked

  std::size_t max_clients = 32;
  std::size_t max_clients_an_address = 8;
};

// "127.0.0.1:8088", "[::1]:8088", "localhost:8088". Other addresses are refused: there is neither TLS nor anybody who
// knows who asks.
[[nodiscard]] tl::expected<settings, std::string> read_listen(std::string_view text);

// Names between spaces.
[[nodiscard]] tl::expected<std::vector<std::string>, std::string> read_hosts(const std::string& text);

} // namespace godwit::operator_port
