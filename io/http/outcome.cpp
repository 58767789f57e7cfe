#include "io/http/outcome.hpp"

#include <algorithm>
#include <charconv>

namespace godwit::io::http {
namespace {

using std::chrono::seconds;

std::optional<seconds> as_seconds(std::string_view text) {
  if (text.empty() || !std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; }))
    return std::nullopt;
  std::int64_t value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  return read.ec == std::errc() ? seconds(std::min<std::int64_t>(value, max_retry_after.count())) : max_retry_after;
}

} // namespace

outcome outcome_of(unsigned status) {
  if (status >= 200 && status <= 299)
    return outcome::success;
  return status == 408 || status == 429 || (status >= 500 && status <= 599) ? outcome::transient : outcome::permanent;
}

std::optional<seconds> retry_after(const response& answer, wall_time now) {
  const auto text = answer.find("Retry-After");
  if (const auto delay = as_seconds(text))
    return delay;
  const auto date = parse_http_date(text, now);
  if (!date)
    return std::nullopt;
  const auto said_at = parse_http_date(answer.find("Date"), now).value_or(now);
  return std::clamp<seconds>(*date - said_at, seconds(0), max_retry_after);
}

} // namespace godwit::io::http
