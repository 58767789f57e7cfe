// The bytes of a connection as requests, one after the other, piece by piece and within bounds.
//
//   switch (reader.feed(bytes)) {
//   case progress::complete: handle(reader.take()); reader.next(); ...
//
// The head is judged before a byte of the body is taken. What asks to be refused has a status and a sentence; then the
// connection is good for nothing more.
//
// Errors: as values. Thread: as any value. Source: RFC 9112; RFC 9110, 10.1.1 (Expect); parsed by Boost.Beast.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "io/http/server/response_head.hpp"
#include "io/http/server/settings.hpp"

namespace godwit::io::http {

enum class progress {
  more,     // bytes are needed
  complete, // there is a request
  refused   // there is an answer to what is no request
};

struct request_refusal {
  unsigned status = 400; // 400, 413, 414, 431
  std::string sentence;
};

// What the body of a request may have, as far as method and target say; never more than max_body_bytes.
using body_limit = std::function<std::size_t(std::string_view method, std::string_view target)>;

class request_reader {
public:
  static constexpr std::size_t read_bytes = 64 * 1024;

  // SET and LIMIT outlive it. No LIMIT: max_body_bytes for all.
  request_reader(const server_settings& set, const body_limit& limit);
  ~request_reader();
  request_reader(const request_reader&) = delete;
  request_reader& operator=(const request_reader&) = delete;

  // At most read_bytes at a time, and only when more are needed.
  [[nodiscard]] progress feed(std::span<const std::byte> bytes);
  // Goes on to the next request; what came of it already is looked at.
  [[nodiscard]] progress next();

  [[nodiscard]] server_request take();
  [[nodiscard]] const request_refusal& refusal() const;
  // Whether another request may follow on this connection: HTTP/1.1, and nobody says `close`.
  [[nodiscard]] bool can_be_kept() const;
  [[nodiscard]] bool has_begun() const; // something of a request has come
  [[nodiscard]] bool has_head() const;  // and its head is complete
  [[nodiscard]] std::size_t body_bytes() const;
  [[nodiscard]] std::string_view unread() const; // what lies after the request
  // Once for each request: the other side waits for "100 Continue" before it sends the body.
  [[nodiscard]] bool take_continue();

private:
  struct state;
  std::unique_ptr<state> state_;
};

} // namespace godwit::io::http
