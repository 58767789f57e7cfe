// Arbitrary bytes as the answer of a service, and as the texts in its headers: the reader must end, within its bounds,
// and must not depend on how the bytes were cut on their way.
//
// The first byte says the rules and the size of the pieces; the rest is what comes over the line.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/http/message.hpp"
#include "io/http/outcome.hpp"
#include "io/http/response_reader.hpp"

namespace godwit::io::http {
namespace {

constexpr std::size_t max_body_bytes = 4096;
constexpr wall_time now = std::chrono::sys_days(std::chrono::year(2026) / 11 / 21);

void require(bool holds) {
  if (!holds)
    std::abort();
}

struct ending {
  std::optional<response> answer;
  std::optional<errc> failed;
  std::size_t sunk_bytes = 0;
};

reader_rules rules_of(std::uint8_t choice, ending& to) {
  reader_rules rules;
  rules.max_body_bytes = max_body_bytes;
  rules.is_connect = (choice & 1U) != 0;
  if ((choice & 2U) != 0)
    rules.expected_content_type = "application/json";
  if ((choice & 4U) != 0)
    rules.on_body = [&to](std::span<const std::byte> bytes) {
      to.sunk_bytes += bytes.size();
      return body_flow::more;
    };
  return rules;
}

ending read(std::span<const std::byte> bytes, std::uint8_t choice, std::size_t piece_bytes) {
  ending seen;
  response_reader reader(rules_of(choice, seen));
  while (!bytes.empty() && !reader.is_complete()) {
    const auto piece = bytes.first(std::min(piece_bytes, bytes.size()));
    if (const auto taken = reader.feed(piece); !taken) {
      seen.failed = taken.error().code;
      return seen;
    }
    bytes = bytes.subspan(piece.size());
  }
  if (const auto ended = reader.end_of_stream((choice & 8U) != 0); !ended)
    seen.failed = ended.error().code;
  else
    seen.answer = reader.take();
  return seen;
}

// The answers of a dialogue with the header texts, which come from outside too.
void look_at(const response& answer) {
  require(answer.body.size() <= std::max(max_body_bytes, max_error_body_bytes));
  const auto wait = retry_after(answer, now);
  require(!wait || (*wait >= std::chrono::seconds(0) && *wait <= max_retry_after));
  static_cast<void>(is_json(answer.find("Content-Type")));
}

void read_both_ways(std::span<const std::byte> bytes, std::uint8_t choice) {
  const auto whole = read(bytes, choice, read_piece_bytes);
  const auto cut = read(bytes, choice, 1U + (choice >> 4U));
  require(whole.answer == cut.answer);
  require(whole.sunk_bytes <= max_body_bytes && cut.sunk_bytes <= max_body_bytes);
  if (whole.answer)
    look_at(*whole.answer);
}

void read_texts(std::string_view text) {
  static_cast<void>(parse_http_date(text, now));
  const response answer{
      503, {{"Retry-After", std::string(text)}, {"Date", "Sat, 21 Nov 2026 00:00:00 GMT"}}, {}, 0, false};
  look_at(answer);
  static_cast<void>(is_json(text));
}

} // namespace

static void run(std::span<const std::byte> input) {
  if (input.empty())
    return;
  const auto bytes = input.subspan(1);
  read_both_ways(bytes, std::to_integer<std::uint8_t>(input[0]));
  read_texts({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

} // namespace godwit::io::http

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  godwit::io::http::run(std::as_bytes(std::span(data, size)));
  return 0;
}
