// The bytes of a connection as one answer, piece by piece and within bounds.
//
//   head --1xx--> head ...        at most max_interim_answers of them, thrown away
//   head --judged--> body --> complete
//
// The head is judged before a byte of the body is taken: too large, not compressed as accepted, a redirect, of the
// wrong type. A 2xx body goes to the sink where there is one, else into the answer. Any other body is kept in the
// answer, up to its bound: an error page that is too long must not hide the status.
//
// Errors: as values, without the place; after one the reader is of no more use. Thread: any, pure but for the sink.
// Source: RFC 9112 (HTTP/1.1), RFC 9110, 15; parsed by Boost.Beast.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "io/http/error.hpp"
#include "io/http/message.hpp"

namespace godwit::io::http {

inline constexpr std::size_t max_head_bytes = 16 * 1024;
inline constexpr std::size_t read_piece_bytes = 64 * 1024;
inline constexpr unsigned max_interim_answers = 8;

struct reader_rules {
  std::size_t max_body_bytes = 0;    // of a 2xx answer
  std::string expected_content_type; // empty: any
  bool is_connect = false;           // the answer of a proxy to CONNECT: a 2xx has no body
  body_sink on_body = {};
  bool accepts_compressed = false; // then bodies are unpacked, and the bound is that of what is unpacked
  std::function<void(const response& head)> on_head = {}; // of a 2xx answer
};

class response_reader {
public:
  explicit response_reader(reader_rules rules);
  ~response_reader();
  response_reader(const response_reader&) = delete;
  response_reader& operator=(const response_reader&) = delete;

  // At most read_piece_bytes at a time.
  [[nodiscard]] result<void> feed(std::span<const std::byte> bytes);
  // The service has closed. IS_PROPER: it said so itself (TLS close_notify), or nobody can tell. A body without a
  // length is complete at its end only then.
  [[nodiscard]] result<void> end_of_stream(bool is_proper);

  [[nodiscard]] bool is_complete() const;
  [[nodiscard]] bool has_begun() const; // a byte has come
  // True, once, when the sink has asked for a pause since the last call.
  [[nodiscard]] bool take_pause();
  // Complete, nothing came after it, and both sides agree to go on.
  [[nodiscard]] bool can_be_kept() const;
  // Bytes lie after the complete answer.
  [[nodiscard]] bool has_leftover() const;
  // Of a complete answer.
  [[nodiscard]] response take();

private:
  struct state;
  std::unique_ptr<state> state_;
};

// What is refused of an answer before its body is looked at.
//
// Errors: redirect, encoded, wrong_content_type, malformed. Thread: any, pure. Source: RFC 9110, 8.4 and 15.4.

[[nodiscard]] result<void> judge_head(const response& head, std::string_view expected_content_type,
                                      bool accepts_compressed = false);

// What a service wrote, fit for a sentence: printable, not too long, and without a query, in which a secret may stand.
[[nodiscard]] std::string quotable(std::string_view foreign);

} // namespace godwit::io::http
