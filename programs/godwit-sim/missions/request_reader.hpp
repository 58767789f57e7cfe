// Bytes of a connection to requests, one after the other, within bounds.
//
//   switch (reader.feed(bytes)) {
//   case progress::complete: handle(reader.take()); reader.next(); ...
//
// Errors: what is no HTTP, too long or too large is refused with an answer, and the connection is good for nothing
// more. Thread: as any value. Source: RFC 9112; RFC 9110, 10.1.1 (Expect).
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "programs/godwit-sim/missions/exchange.hpp"

namespace godwit::sim::missions {

inline constexpr std::size_t max_request_head_bytes = 16 * 1024; // a token of 8 kB, and as much again

enum class progress {
  more,     // bytes are needed
  complete, // there is a request
  refused   // there is an answer to what is no request
};

class request_reader {
public:
  request_reader();
  ~request_reader();
  request_reader(const request_reader&) = delete;
  request_reader& operator=(const request_reader&) = delete;

  [[nodiscard]] progress feed(std::span<const std::byte> bytes);
  // Goes on to the next request; what came of it already is looked at.
  [[nodiscard]] progress next();

  [[nodiscard]] request take();
  [[nodiscard]] answer refusal() const;
  // Whether another request may follow on this connection.
  [[nodiscard]] bool can_be_kept() const;
  // Something of a request has come.
  [[nodiscard]] bool has_begun() const;
  // Once for each request: the other side waits for "100 Continue" before it sends the body.
  [[nodiscard]] bool take_continue();

private:
  struct state;
  std::unique_ptr<state> state_;
};

} // namespace godwit::sim::missions
