#include "actors/fleet_link/state.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "io/time_units.hpp"

namespace godwit::fleet_link {
namespace {

constexpr std::size_t bytes_beside_data = 90; // of an event: names, numbers, time

// As text within a text.
std::size_t bytes_of(const queued_event& each) {
  const auto escaped = std::ranges::count_if(each.data, [](char c) { return c == '"' || c == '\\'; });
  return bytes_beside_data + each.data.size() + static_cast<std::size_t>(escaped);
}

void forget_oldest(state& s, std::size_t count) {
  const auto end = s.events.begin() + static_cast<std::ptrdiff_t>(count);
  for (auto each = s.events.begin(); each != end; ++each)
    s.event_bytes -= bytes_of(*each);
  s.events.erase(s.events.begin(), end);
}

// A tenth goes at once: what is dropped one by one would move all the others each time.
void make_room(state& s) {
  if (s.events.size() <= max_events && s.event_bytes <= max_event_bytes)
    return;
  const auto count = std::max<std::size_t>(1, s.events.size() / 10);
  s.dropped += count;
  forget_oldest(s, count);
}

void put(state& s, const sight& seen) {
  if (!seen.process.empty()) {
    s.seen.process = seen.process;
    s.seen.actors.clear();
  }
  if (seen.flight)
    s.seen.flight = seen.flight;
  if (seen.failsafe)
    s.seen.failsafe = seen.failsafe;
  if (seen.worst)
    s.seen.worst = seen.worst;
  for (const auto& each : seen.actors) {
    std::erase_if(s.seen.actors, [&](const actor_restarts& known) { return known.name == each.name; });
    s.seen.actors.push_back(each);
  }
}

std::vector<durable_core::effect> put(state& s, const store_named& happened, std::int64_t) {
  s.store = happened.store;
  return {};
}

std::vector<durable_core::effect> put(state& s, const noted& happened, std::int64_t at_ns) {
  put(s, happened.seen);
  for (const auto& each : happened.what) {
    s.events.push_back({s.next_number++, at_ns / ns_per_ms, each.kind, happened.is_late, each.data});
    s.event_bytes += bytes_of(s.events.back());
    make_room(s);
  }
  if (happened.what.empty())
    return {};
  return {written{s.next_number - 1}};
}

std::vector<durable_core::effect> put(state& s, const delivered& happened, std::int64_t) {
  const auto end = std::ranges::find_if(s.events, [&](const auto& each) { return each.number > happened.upto; });
  const auto count = static_cast<std::size_t>(std::distance(s.events.begin(), end));
  s.delivered += count;
  forget_oldest(s, count);
  return {};
}

} // namespace

std::vector<durable_core::effect> durable_core::apply(state& s, const event& happened, std::int64_t at_ns) {
  return std::visit([&](const auto& each) { return put(s, each, at_ns); }, happened);
}

// The shell looks what is on the disk.
std::vector<durable_core::effect> durable_core::resume(const state&, std::int64_t) { return {}; }

} // namespace godwit::fleet_link
