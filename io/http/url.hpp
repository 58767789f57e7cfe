// Where a service or a proxy is: "https://missions.example:8443/api/v1".
//
// No user and password in it: they would come out in logs. No query, no fragment.
//
// Errors: as values; the sentence does not repeat a URL that holds a password. Thread: any, pure. Source: RFC 3986.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/http/error.hpp"

namespace godwit::io::http {

struct url {
  bool is_tls = false;
  std::string host; // a name or an address; an IPv6 address without its brackets
  std::uint16_t port = 0;
  std::string path; // empty, or "/api/v1": without a slash at the end

  // "missions.example:8443", "[::1]:80": what CONNECT names. host_header() leaves out the port that goes without
  // saying.
  [[nodiscard]] std::string authority() const;
  [[nodiscard]] std::string host_header() const;
  [[nodiscard]] std::string origin() const; // "https://missions.example:8443"
  bool operator==(const url&) const = default;
};

[[nodiscard]] result<url> parse_url(std::string_view text);

// A literal loopback address, or "localhost". Where that name leads is checked again when it is looked up.
[[nodiscard]] bool names_this_computer(std::string_view host);
[[nodiscard]] bool is_address(std::string_view host);

} // namespace godwit::io::http
