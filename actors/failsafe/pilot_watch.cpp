#include "actors/failsafe/pilot_watch.hpp"

#include <algorithm>

namespace godwit::failsafe {

namespace {

std::size_t index_of(mode_kind kind) { return static_cast<std::size_t>(kind); }

bool follows_by_itself(mode_kind before, mode_kind after) {
  if (before == mode_kind::returning)
    return after == mode_kind::landing;
  return before == mode_kind::take_off && (after == mode_kind::mission || after == mode_kind::hold);
}

bool is_wanted(std::optional<action> reacts, mode_kind kind) {
  if (!reacts)
    return false;
  const auto wanted = modes_of(*reacts);
  return std::find(wanted.begin(), wanted.end(), kind) != wanted.end();
}

} // namespace

pilot_watch::pilot_watch(const pilot_memory& restored, instant now)
    : ours_(restored.ours), taken_over_(restored.taken_over) {
  for (const auto& each : restored.expected)
    if (!each.until_ns)
      expected_.at(index_of(each.kind)) = expectation{};
    else if (const auto left_ns = std::min(*each.until_ns - now.wall_ns, max_expectation_ms * ns_per_ms); left_ns > 0)
      expected_.at(index_of(each.kind)) = expectation{each.until_ns, now.monotonic_ns + left_ns};
}

void pilot_watch::expect(mode_kind kind, std::optional<std::int64_t> lasts_ms, instant now) {
  auto& slot = expected_.at(index_of(kind));
  if (!lasts_ms) {
    slot = expectation{};
    return;
  }
  const auto lasts_ns = std::clamp<std::int64_t>(*lasts_ms, 0, max_expectation_ms) * ns_per_ms;
  const auto until_ns = now.monotonic_ns + lasts_ns;
  if (!slot || (slot->until_monotonic_ns && *slot->until_monotonic_ns < until_ns)) // the longer one counts
    slot = expectation{now.wall_ns + lasts_ns, until_ns};
}

void pilot_watch::forget_the_plan() {
  for (auto& each : expected_)
    if (each && !each->until_monotonic_ns)
      each.reset();
}

void pilot_watch::hand_back() {
  taken_over_ = false;
  adopts_ = true;
}

bool pilot_watch::is_expected(mode_kind kind) const { return expected_.at(index_of(kind)).has_value(); }

void pilot_watch::expire(instant now) {
  for (auto& each : expected_)
    if (each && each->until_monotonic_ns && now.monotonic_ns >= *each->until_monotonic_ns)
      each.reset();
}

bool pilot_watch::is_ours(const flight_now& flight, const flight_mode& mode) const {
  if (adopts_ || is_expected(mode.kind))
    return true;
  if (flight.begins && !flight.is_found) // a take-off that we saw: by a person at the sticks, or by itself
    return mode.kind != mode_kind::manual;
  if (flight.is_found || !ours_)
    return mode.kind == mode_kind::mission;
  return mode == *ours_ || follows_by_itself(ours_->kind, mode.kind);
}

void pilot_watch::evaluate(const flight_now& flight, const flight_mode& mode, std::optional<action> reacts,
                           instant now) {
  if (flight.ends) {
    taken_over_ = false;
    expected_ = {};
  }
  if (!flight.in_flight)
    ours_ = mode;
  else if (!taken_over_ && (is_ours(flight, mode) || is_wanted(reacts, mode.kind)))
    ours_ = mode;
  else
    taken_over_ = true;
  adopts_ = false;
  expire(now);
}

pilot_memory pilot_watch::memory() const {
  pilot_memory result{ours_, taken_over_, {}};
  for (const auto& [kind, text] : enum_names(mode_kind{}))
    if (const auto& each = expected_.at(index_of(kind)))
      result.expected.push_back({kind, each->until_ns});
  return result;
}

} // namespace godwit::failsafe
