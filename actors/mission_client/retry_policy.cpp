#include "actors/mission_client/retry_policy.hpp"

#include <algorithm>

#include "actors/mission_client/outbox/keys.hpp"

namespace godwit::mission_client {

namespace {

constexpr std::int64_t jitter_steps = 1'000;

std::int64_t grown(std::int64_t first, std::uint32_t failed) {
  auto result = first;
  for (std::uint32_t i = 1; i < failed && result < longest_pause_ns; ++i)
    result *= 2;
  return std::min(result, longest_pause_ns);
}

// From four fifths to six fifths.
std::int64_t jittered(std::int64_t pause, std::uint32_t failed, std::string_view key) {
  const auto step = static_cast<std::int64_t>(hash_of(key, failed) % (2 * jitter_steps + 1)) - jitter_steps;
  return pause + pause / (5 * jitter_steps) * step;
}

std::int64_t at_least(std::int64_t pause, std::optional<std::int64_t> retry_after_ns) {
  return std::max(pause, std::min(retry_after_ns.value_or(0), longest_retry_after_ns));
}

} // namespace

std::int64_t pause_ns(std::uint32_t failed, std::string_view key, std::optional<std::int64_t> retry_after_ns) {
  return at_least(jittered(grown(first_pause_ns, failed), failed, key), retry_after_ns);
}

std::int64_t change_pause_ns(std::uint32_t failed, std::string_view key, std::optional<std::int64_t> retry_after_ns) {
  return at_least(jittered(grown(first_change_pause_ns, failed), failed, key), retry_after_ns);
}

std::int64_t flown_pause_ns(std::uint32_t failed, std::string_view key, std::optional<std::int64_t> retry_after_ns) {
  const auto pause = std::min(grown(first_pause_ns, failed), longest_flown_pause_ns);
  return at_least(jittered(pause, failed, key), retry_after_ns);
}

bool is_due(std::int64_t next_try_ns, std::int64_t now_ns) {
  return next_try_ns <= now_ns || next_try_ns - now_ns > longest_retry_after_ns;
}

bool has_expired(std::int64_t first_failure_ns, std::int64_t now_ns) {
  return first_failure_ns != 0 && now_ns - first_failure_ns >= delivery_window_ns;
}

} // namespace godwit::mission_client
