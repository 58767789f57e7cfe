// The first lines of an answer, and the answers that the server gives itself.
//
// Thread: pure. Source: RFC 9112, 4 and 6; RFC 9110, 15 (the reason phrases); RFC 9457 (problem documents).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/http/connection.hpp"
#include "io/http/message.hpp"

namespace godwit::io::http {

// What a client of the server asks, and what it is answered.
//
// Thread: plain values.
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

// "Not Found"; of a status that is not known: empty.
[[nodiscard]] std::string_view reason_phrase(unsigned status);

// Without a body, whatever the client asked.
[[nodiscard]] bool has_no_body(unsigned status);

// BODY_BYTES: none when the body ends with the connection. What a header can not have, such as the end of a line, is
// written as a question mark: data must not write headers of its own.
[[nodiscard]] std::string response_head(const server_response& what, std::optional<std::uint64_t> body_bytes,
                                        bool is_last);

// DETAIL: a sentence of ours, without quotes and backslashes.
[[nodiscard]] server_response problem_response(unsigned status, std::string_view detail);

} // namespace godwit::io::http
