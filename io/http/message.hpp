// What is asked of a service, and what it answers.
//
// Thread: plain values.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace godwit::io::http {

enum class method { get, post, put, remove }; // remove: DELETE, which is a macro on some systems

struct header {
  std::string name;
  std::string value;
  bool operator==(const header&) const = default;
};

// The value of the first one of that name, in any case; none: empty.
[[nodiscard]] std::string_view find_header(const std::vector<header>& all, std::string_view name);

// What a sink says to the bytes it was given.
//   more     the next ones as soon as they come
//   pause    enough for now: nothing is read until client::resume(), so that the service has to wait. What was read
//            with these bytes still comes: at most read_piece_bytes.
//   cancel   nothing more; the request ends as cancelled
enum class body_flow { more, pause, cancel };
using body_sink = std::function<body_flow(std::span<const std::byte> bytes)>;

struct request {
  http::method method = http::method::get;
  std::string target = "/"; // path and query, below the path of the base URL; percent-encoded by the caller
  std::string body;
  std::string content_type = "application/json"; // of the body; not sent without one
  // Made before the first try and the same in each. Sent as the header Idempotency-Key. Not empty: a second delivery
  // does no harm, so a POST may be sent again when a kept connection turns out to be dead.
  std::string idempotency_key;
  std::string accept = "application/json";
  // Not empty: a 2xx answer of another type is an error, and nothing of it reaches the sink.
  std::string expected_content_type;
  // The answer may come compressed (content_coding.hpp); body, sink and bounds are about what it is unpacked. For large
  // answers: a secret beside what an attacker chooses must not be compressed with it.
  bool accepts_compressed = false;
  std::vector<header> headers; // further ones; not those that the client writes itself

  // None: what the settings say.
  std::optional<std::size_t> max_body_bytes; // of the answer
  std::optional<std::chrono::milliseconds> read_timeout;
  std::optional<std::chrono::milliseconds> total_timeout;

  // Sees the head of a 2xx answer before its body comes. Called in the client's thread.
  std::function<void(const struct response& head)> on_head = {};
  // Takes the body of a 2xx answer piece by piece, instead of response::body. Called in the client's thread.
  body_sink on_body = {};
};

// The status says what to do; of a page of error the beginning is enough.
inline constexpr std::size_t max_error_body_bytes = 64 * 1024;

struct response {
  unsigned status = 0;
  std::vector<header> headers;  // as they came, without those after a chunked body
  std::string body;             // empty when a sink took it
  std::uint64_t body_bytes = 0; // of the body, wherever it went
  bool is_cut = false;          // not 2xx, and longer than max_error_body_bytes: the rest was not read

  [[nodiscard]] std::string_view find(std::string_view name) const { return find_header(headers, name); }
  bool operator==(const response&) const = default;
};

// Twice is as good as once: RFC 9110, 9.2.2, and what carries an idempotency key.
[[nodiscard]] bool may_repeat(const request& asked);
[[nodiscard]] std::string_view method_text(method value);
[[nodiscard]] bool equals_ignoring_case(std::string_view a, std::string_view b);

// Whether a Content-Type is the one that was expected.
//
// Thread: any, pure. Source: RFC 9110, 8.3 (media type, parameters); RFC 6839 (+json).

// "application/json" for "Application/JSON; charset=utf-8". Of what is no media type: empty.
[[nodiscard]] std::string_view media_type(std::string_view content_type);

// Type and subtype agree in any case, and the character set, where there is one, is UTF-8. Other parameters are not
// looked at.
[[nodiscard]] bool has_content_type(std::string_view content_type, std::string_view expected);

// application/json, and what ends in +json, such as application/geo+json and application/problem+json.
[[nodiscard]] bool is_json(std::string_view content_type);

} // namespace godwit::io::http
