// What of fleet_link must survive a crash: the events that the broker does not have, in their order, and what was seen
// last of all that events are made of, so that a new incarnation sees what has changed meanwhile.
//
//   noted ──> [events, the oldest first] ──delivered──> gone
//                      └── no room ──> the oldest is dropped, and counted
//
// An event has a number, 1, 2, 3, ... without a gap, and keeps it; `store` says of which journal. Facts are put into
// the state and decide nothing. Times are since 1970 (UTC). Thread: plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/executor/flight.hpp"
#include "messages/failsafe/types.hpp"
#include "messages/health/types.hpp"
#include "runtime/effect_kind.hpp"

namespace godwit::fleet_link {

// An event each 3 s in a day without a broker, and no more than the journal's disk bears: the state is written as a
// whole each hundred events.
inline constexpr std::size_t max_events = 30'000;
// As they stand in the state; the journal with its log takes up to four times as much of the disk
// (docs/performance.md).
inline constexpr std::size_t max_event_bytes = std::size_t{14} * 1024 * 1024;
inline constexpr std::size_t max_data_bytes = std::size_t{16} * 1024; // of one: more is a mistake of ours

enum class event_kind {
  process_began,  // of godwitd
  flight,         // phase, cause of a pause, in flight, armed
  authority,      // who has the vehicle
  progress,       // of the mission: another one, another revision, items, reports
  failsafe,       // what it does, and what was overridden
  point_shown,    // of interest: a person may decide
  point_closed,   // the same: decided, or passed over
  health,         // the worst of all parts is another one
  actor_restarted // it had crashed
};

GODWIT_ENUM_NAMES(event_kind, process_began, flight, authority, progress, failsafe, point_shown, point_closed, health,
                  actor_restarted);

struct news {
  event_kind kind = event_kind::flight;
  std::string data; // JSON
  GODWIT_FIELDS(news, "fleet_link.news", kind, data);
};

struct queued_event {
  std::uint64_t number = 0;
  std::int64_t at_ms = 0;
  event_kind kind = event_kind::flight;
  bool is_late = false; // there was no broker when it happened
  std::string data;     // JSON
  GODWIT_FIELDS(queued_event, "fleet_link.queued_event", number, at_ms, kind, is_late, data);
};

struct actor_restarts {
  std::string name;
  std::uint64_t restarts = 0;
  GODWIT_FIELDS(actor_restarts, "fleet_link.actor_restarts", name, restarts);
};

// What was seen last. None: nothing yet.
struct sight {
  std::string process; // another one for each process
  std::optional<executor::flight_status> flight;
  std::optional<failsafe::failsafe_status> failsafe;
  std::optional<health::colour> worst;
  std::vector<actor_restarts> actors; // of this process, those that were restarted
  GODWIT_FIELDS(sight, "fleet_link.sight", process, flight, failsafe, worst, actors);
};

struct state {
  std::string store; // part of the id of each event: another one for each journal; empty: not begun
  std::uint64_t next_number = 1;
  std::vector<queued_event> events; // numbers without a gap
  std::uint64_t event_bytes = 0;    // as they stand here
  std::uint64_t delivered = 0;
  std::uint64_t dropped = 0;
  sight seen;
  static constexpr int version = 1;
  GODWIT_FIELDS(state, "fleet_link.state", store, next_number, events, event_bytes, delivered, dropped, seen);
};

// -- facts

struct store_named {
  std::string store;
  GODWIT_FIELDS(store_named, "fleet_link.store_named", store);
};

// What is absent in SEEN is as it was.
struct noted {
  std::vector<news> what;
  bool is_late = false;
  sight seen; // `process`: empty where it is as it was; `actors`: those that have changed
  GODWIT_FIELDS(noted, "fleet_link.noted", what, is_late, seen);
};

// The broker has all up to this number.
struct delivered {
  std::uint64_t upto = 0;
  GODWIT_FIELDS(delivered, "fleet_link.delivered", upto);
};

// -- what comes of them

// Events up to this number are on the disk, and may go to the broker.
struct written {
  static constexpr auto goes_out = runtime::effect_kind::after_commit;
  std::uint64_t upto = 0;
  GODWIT_FIELDS(written, "fleet_link.written", upto);
};

struct durable_core {
  using state = fleet_link::state;
  using event = std::variant<store_named, noted, delivered>;
  using effect = std::variant<written>;

  [[nodiscard]] static std::vector<effect> apply(state& s, const event& happened, std::int64_t at_ns);
  [[nodiscard]] static std::vector<effect> resume(const state& s, std::int64_t now_ns);
};

} // namespace godwit::fleet_link
