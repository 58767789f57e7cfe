// The JSON around each message in the trace, taken apart (trace_renderer.hpp writes it).
//
// What the renderer writes is read in place, without a parser for all of JSON, ten times as fast; any other JSON of the
// same meaning (other order, spaces, escapes) is read too. The message within is not looked at. Errors: false for what
// is no such record. Thread: one at a time.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "runtime/trace/trace_sink.hpp"

namespace godwit::runtime {

struct record_fields {
  std::uint64_t id = 0;
  std::uint64_t cause = 0;
  std::int64_t duration_ns = 0;
  std::int64_t clock_offset_ns = 0;
  std::int64_t wall_offset_ns = 0;
  std::string_view actor;
  std::string_view sender;
  std::uint32_t incarnation = 0;
  outcome how = outcome::handled;
  bool oversize = false;
  std::string_view body;
};

class record_parser {
public:
  // Views in TO are of TEXT or of the parser, and valid until the next call.
  [[nodiscard]] bool parse(std::string_view text, record_fields& to);

private:
  [[nodiscard]] bool parse_any(std::string_view text, record_fields& to);

  std::string actor_;
  std::string sender_;
  std::string body_;
};

} // namespace godwit::runtime
