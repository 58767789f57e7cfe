#include "actors/failsafe/overrides.hpp"

#include <algorithm>

namespace godwit::failsafe {

namespace {

constexpr std::int64_t max_override_ns = max_override_ms * ns_per_ms;

} // namespace

overrides::overrides(const std::vector<standing_override>& restored, instant now) {
  for (const auto& each : restored) {
    const auto left_ns = std::min(each.until_ns - now.wall_ns, max_override_ns);
    if (left_ns > 0 && may_be_overridden(each.scope))
      slots_.at(index_of(each.scope)) = slot{each, now.monotonic_ns + left_ns};
  }
}

tl::expected<void, std::string> overrides::take(const override_rule& wanted, instant now) {
  if (!may_be_overridden(wanted.scope))
    return tl::unexpected(std::string("a critical battery can not be overridden"));
  if (wanted.reason.empty())
    return tl::unexpected(std::string("an override needs a reason"));
  if (wanted.until_ns <= now.wall_ns)
    return tl::unexpected(std::string("the deadline of the override has passed"));
  if (wanted.until_ns - max_override_ns > now.wall_ns)
    return tl::unexpected("the deadline of the override is more than " + std::to_string(max_override_ms / 60'000) +
                          " min away");
  slots_.at(index_of(wanted.scope)) =
      slot{{wanted.scope, wanted.reason.substr(0, max_override_reason), wanted.until_ns},
           now.monotonic_ns + (wanted.until_ns - now.wall_ns)};
  return {};
}

void overrides::expire(instant now) {
  for (auto& each : slots_)
    if (each && now.monotonic_ns >= each->until_monotonic_ns)
      each.reset();
}

std::vector<standing_override> overrides::all() const {
  std::vector<standing_override> result;
  for (const auto& each : slots_)
    if (each)
      result.push_back(each->what);
  return result;
}

} // namespace godwit::failsafe
