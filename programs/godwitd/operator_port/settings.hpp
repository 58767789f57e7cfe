// Where the operator's port listens, how, and what it bears. Errors: sentences. Thread: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

namespace godwit::operator_port {

struct settings {
  std::string host;                  // an address of this computer, without brackets
  std::uint16_t port = 0;            // 0: any free one
  std::vector<std::string> hosts;    // further names under which it may be asked
  bool is_local = true;              // nobody reaches it from another computer
  bool uses_tls = false;             // always where it is not local
  std::string certificate_file = {}; // in PEM, with the file of its key; empty: our own, in identity_file
  std::string key_file = {};
  std::string identity_file = {}; // made when it is not there

  std::string tiles = {}; // an MBTiles file for the page's map; empty: none
  std::string docs = {};  // the folder of the documents as pages

  // A browser opens up to seven connections for a page: three pages of one computer, and a program beside them.
  std::size_t max_clients = 48;
  std::size_t max_clients_an_address = 24;
};

// "127.0.0.1:8088", "[::1]:8088", "localhost:8088"; with TLS "0.0.0.0:8443" and others.
[[nodiscard]] tl::expected<settings, std::string> read_listen(std::string_view text);

// Nobody listens beyond this computer where nobody could log in.
[[nodiscard]] std::optional<std::string> objection_to(const settings& wanted, bool has_accounts);

// Names between spaces.
[[nodiscard]] tl::expected<std::vector<std::string>, std::string> read_hosts(const std::string& text);

} // namespace godwit::operator_port
