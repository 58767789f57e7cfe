#include "actors/fleet_link/news.hpp"

#include <algorithm>
#include <tuple>

#include "io/fields/json_text.hpp"
#include "messages/telemetry_stream/types.hpp"

namespace godwit::fleet_link {
namespace {

struct began {
  std::string process;
  GODWIT_FIELDS(began, "fleet_link.began", process);
};

struct restarted {
  std::string actor;
  std::uint64_t incarnation = 0;
  std::uint64_t restarts = 0; // in this process
  std::string reason;
  GODWIT_FIELDS(restarted, "fleet_link.restarted", actor, incarnation, restarts, reason);
};

template <class Data>
void add(noted& to, event_kind kind, const Data& data) {
  auto text = io::to_json(data);
  if (text.size() > max_data_bytes) // it is named, and what it says is in the log and the trace
    text = "{}";
  to.what.push_back({kind, std::move(text)});
}

auto key_of_flight(const executor::flight_status& m) {
  return std::tie(m.phase, m.cause, m.in_flight, m.is_armed, m.mode);
}

auto key_of_progress(const executor::flight_status& m) {
  return std::tie(m.mission_id, m.revision, m.items, m.items_done, m.reports);
}

auto key_of(const failsafe::failsafe_status& m) {
  return std::tie(m.in_flight, m.taken_over, m.reacts, m.latched, m.overridden);
}

} // namespace

std::optional<noted> news_of_process(const sight& seen, const std::string& process) {
  if (seen.process == process)
    return {};
  noted result;
  result.seen.process = process;
  add(result, event_kind::process_began, began{process});
  return result;
}

std::optional<noted> news_of(const sight& seen, const executor::flight_status& now) {
  const auto before = seen.flight.value_or(executor::flight_status{});
  noted result;
  if (key_of_flight(before) != key_of_flight(now))
    add(result, event_kind::flight,
        telemetry_stream::flight_update{now.phase, now.cause, now.sentence, now.in_flight, now.is_armed, now.mode,
                                        now.preflight_report, now.state});
  if (before.authority != now.authority)
    add(result, event_kind::authority, telemetry_stream::authority_update{now.authority});
  if (key_of_progress(before) != key_of_progress(now))
    add(result, event_kind::progress,
        telemetry_stream::progress_update{now.mission_id, now.revision, now.generation, now.items, now.items_done,
                                          now.reports});
  if (result.what.empty())
    return {};
  result.seen.flight = now;
  return result;
}

std::optional<noted> news_of(const sight& seen, const failsafe::failsafe_status& now) {
  if (key_of(seen.failsafe.value_or(failsafe::failsafe_status{})) == key_of(now))
    return {};
  noted result;
  add(result, event_kind::failsafe, now);
  result.seen.failsafe = now;
  return result;
}

// Parts that are well are left out: there are some thirty.
std::optional<noted> news_of(const sight& seen, const health::health_status& now) {
  if (seen.worst.value_or(health::colour::green) == now.worst)
    return {};
  auto shown = now;
  std::erase_if(shown.parts, [](const auto& each) { return each.health == health::colour::green; });
  noted result;
  add(result, event_kind::health, shown);
  result.seen.worst = now.worst;
  return result;
}

std::optional<noted> news_of(const sight& seen, const runtime::children& now) {
  noted result;
  for (const auto& each : now.list) {
    const auto known = std::ranges::find(seen.actors, each.name, &actor_restarts::name);
    if (each.restarts <= (known == seen.actors.end() ? 0 : known->restarts))
      continue;
    add(result, event_kind::actor_restarted, restarted{each.name, each.incarnation, each.restarts, each.last_crash});
    result.seen.actors.push_back({each.name, each.restarts});
  }
  return result.what.empty() ? std::nullopt : std::optional(std::move(result));
}

noted news_of(const scan_controller::point_shown& now) {
  noted result;
  add(result, event_kind::point_shown, now);
  return result;
}

noted news_of(const scan_controller::point_closed& now) {
  noted result;
  add(result, event_kind::point_closed, now);
  return result;
}

} // namespace godwit::fleet_link
