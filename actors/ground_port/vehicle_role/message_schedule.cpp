#include "actors/ground_port/vehicle_role/message_schedule.hpp"

#include <algorithm>

#include "io/time_units.hpp"

namespace godwit::ground_port::vehicle_role {

namespace {

constexpr std::int64_t never_ns = std::numeric_limits<std::int64_t>::max();

} // namespace

message_schedule::message_schedule(std::span<const streamed_message> table, std::int64_t now_ns, double phase) {
  entries_.reserve(table.size());
  for (const auto& each : table) {
    const auto shift = static_cast<std::int64_t>(static_cast<double>(each.interval_ns) * phase);
    entries_.push_back({each.id, each.interval_ns, each.interval_ns, now_ns + shift});
  }
  find_next();
}

bool message_schedule::set_interval(std::uint32_t id, std::int64_t interval_us, std::int64_t now_ns) {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const entry& e) { return e.id == id; });
  if (found == entries_.end() || interval_us < -1 || interval_us > max_interval_us)
    return false;
  auto wanted_ns = found->default_interval_ns;
  if (interval_us > 0)
    wanted_ns = std::max(interval_us * ns_per_us, min_interval_ns);
  else if (interval_us < 0)
    wanted_ns = 0;
  // Who asks again for what already is must not make the message come more often.
  if (wanted_ns != found->interval_ns) {
    found->interval_ns = wanted_ns;
    found->due_ns = now_ns;
    find_next();
  }
  return true;
}

std::int32_t message_schedule::interval_us(std::uint32_t id) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const entry& e) { return e.id == id; });
  if (found == entries_.end())
    return 0;
  return found->interval_ns > 0 ? static_cast<std::int32_t>(found->interval_ns / ns_per_us) : -1;
}

std::int64_t message_schedule::next_after(const entry& each, std::int64_t now_ns) {
  const auto missed = (now_ns - each.due_ns) / each.interval_ns;
  return each.due_ns + (missed + 1) * each.interval_ns;
}

void message_schedule::find_next() {
  next_ns_ = never_ns;
  for (const auto& each : entries_)
    if (each.interval_ns > 0)
      next_ns_ = std::min(next_ns_, each.due_ns);
}

} // namespace godwit::ground_port::vehicle_role
