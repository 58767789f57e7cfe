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

constexpr auto enum_names(event_kind) {
  return io::names<event_kind>({{event_kind::process_began, "process_began"},
                                {event_kind::flight, "flight"},
                                {event_kind::authority, "authority"},
                                {event_kind::progress, "progress"},
                                {event_kind::failsafe, "failsafe"},
                                {event_kind::point_shown, "point_shown"},
                                {event_kind::point_closed, "point_closed"},
                                {event_kind::health, "health"},
                                {event_kind::actor_restarted, "actor_restarted"}});
}

struct news {
  event_kind kind = event_kind::flight;
  std::string data; // JSON
  static constexpr auto fields =
      io::table("fleet_link.news", io::field("kind", &news::kind), io::field("data", &news::data));
};

struct queued_event {
  std::uint64_t number = 0;
  std::int64_t at_ms = 0;
  event_kind kind = event_kind::flight;
  bool is_late = false; // there was no broker when it happened
  std::string data;     // JSON
  static constexpr auto fields =
      io::table("fleet_link.queued_event", io::field("number", &queued_event::number),
                io::field("at_ms", &queued_event::at_ms), io::field("kind", &queued_event::kind),
                io::field("is_late", &queued_event::is_late), io::field("data", &queued_event::data));
};

struct actor_restarts {
  std::string name;
  std::uint64_t restarts = 0;
  static constexpr auto fields = io::table("fleet_link.actor_restarts", io::field("name", &actor_restarts::name),
                                           io::field("restarts", &actor_restarts::restarts));
};

// What was seen last. None: nothing yet.
struct sight {
  std::string process; // another one for each process
  std::optional<executor::flight_status> flight;
  std::optional<failsafe::failsafe_status> failsafe;
  std::optional<health::colour> worst;
  std::vector<actor_restarts> actors; // of this process, those that were restarted
  static constexpr auto fields = io::table("fleet_link.sight", io::field("process", &sight::process),
                                           io::field("flight", &sight::flight), io::field("failsafe", &sight::failsafe),
                                           io::field("worst", &sight::worst), io::field("actors", &sight::actors));
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
  static constexpr auto fields =
      io::table("fleet_link.state", io::field("store", &state::store), io::field("next_number", &state::next_number),
                io::field("events", &state::events), io::field("event_bytes", &state::event_bytes),
                io::field("delivered", &state::delivered), io::field("dropped", &state::dropped),
                io::field("seen", &state::seen));
};

// -- facts

struct store_named {
  std::string store;
  static constexpr auto fields = io::table("fleet_link.store_named", io::field("store", &store_named::store));
};

// What is absent in SEEN is as it was.
struct noted {
  std::vector<news> what;
  bool is_late = false;
  sight seen; // `process`: empty where it is as it was; `actors`: those that have changed
  static constexpr auto fields = io::table("fleet_link.noted", io::field("what", &noted::what),
                                           io::field("is_late", &noted::is_late), io::field("seen", &noted::seen));
};

// The broker has all up to this number.
struct delivered {
  std::uint64_t upto = 0;
  static constexpr auto fields = io::table("fleet_link.delivered", io::field("upto", &delivered::upto));
};

// -- what comes of them

// Events up to this number are on the disk, and may go to the broker.
struct written {
  static constexpr auto goes_out = runtime::effect_kind::after_commit;
  std::uint64_t upto = 0;
  static constexpr auto fields = io::table("fleet_link.written", io::field("upto", &written::upto));
};

struct durable_core {
  using state = fleet_link::state;
  using event = std::variant<store_named, noted, delivered>;
  using effect = std::variant<written>;

  [[nodiscard]] static std::vector<effect> apply(state& s, const event& happened, std::int64_t at_ns);
  [[nodiscard]] static std::vector<effect> resume(const state& s, std::int64_t now_ns);
};

} // namespace godwit::fleet_link
