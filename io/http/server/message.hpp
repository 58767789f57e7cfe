// What a client of the server asks, and what it is answered.
//
// Thread: plain values.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/http/client_place.hpp"
#include "io/http/message.hpp"

namespace godwit::io::http {

inline constexpr std::string_view problem_type = "application/problem+json";

struct server_request {
  std::string method; // "GET": as it came
  std::string target; // path and query, as they came
  std::vector<header> headers;
  std::string body;
  std::string from = {};                  // address of the client; of both an IPv4 address is one also over IPv6
  std::string to = {};                    // address of this computer that it has asked
  std::weak_ptr<client_place> place = {}; // of its connection

  [[nodiscard]] std::string_view find(std::string_view name) const { return find_header(headers, name); }
};

struct server_response {
  unsigned status = 200;
  std::string content_type = "application/json"; // empty: not said
  std::string body = {};                         // none with 204 and 304
  std::vector<header> headers = {};              // further ones; not those of length and connection
};

} // namespace godwit::io::http
