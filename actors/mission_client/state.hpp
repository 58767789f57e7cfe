// What of mission_client must survive a crash: which mission, how far with it, and what is owed to the service.
//
//          begin_mission            earlier_delivered             mission_fetched           pull_ended
//   [idle] ─────────────> [delivering_earlier] ─────────> [fetching] ─────────> [pulling] ───────────> [ready]
//                               ^                              │ fetch_failed,      ^                     │
//                               │ begin_mission                v mission_gone       └──── pull_map ───────┘
//                               └───────────────────────── [refused]                   (after a pull that failed)
//
// begin_mission for another mission leads to delivering_earlier from everywhere, and so does begin_next; after it
// stands asking_next then, until next_given leads to fetching. What is owed is delivered in every phase. Whoever begins
// anew with a mission does not know how old his journal is, and asks the service for its last report (fetching.hpp);
// until then no report of that mission goes out. Thread: plain values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/mission_client/outbox/outbox.hpp"
#include "io/fields/field_table.hpp"
#include "messages/mission_client/types.hpp"

namespace godwit::mission_client {

enum class phase { idle, delivering_earlier, fetching, pulling, ready, refused, asking_next };

GODWIT_ENUM_NAMES(phase, idle, delivering_earlier, fetching, pulling, ready, refused, asking_next);

// Missions of which something is known; the oldest with nothing owed is forgotten.
inline constexpr std::size_t max_mission_notes = 64;
// Assignments that nobody has responded to. The service gives further ones again when these are resolved.
inline constexpr std::size_t max_open_assignments = 16;
// Keys of what was resolved last, so that a repetition is known as such.
inline constexpr std::size_t max_resolved_keys = 256;
// One for each mission and kind.
inline constexpr std::size_t max_store_operations = 2 * max_mission_notes;

// Items that are not reported; the oldest are forgotten.
inline constexpr std::size_t max_left_out = 10'000;

struct mission_note {
  std::string mission_id;
  bool is_deleted = false;
  bool is_pushing = false;             // what the map store owes for it is being delivered
  bool was_asked = false;              // by push_map: somebody waits for mission_resolved
  bool seen_done = false;              // of its observations the store has no more, or they can not be delivered
  bool ignored_done = false;           // the same of its ignored items
  std::uint32_t last_report_no = 0;    // as whoever flies numbers them
  std::uint32_t service_report_no = 0; // as the service does: without a gap, and on from what it had before
  std::uint32_t sure_report_no = 0;    // of the service's numbers: given before it was asked, or told by it
  bool asks_progress =
      false; // which reports the service has is being asked; numbers above the sure one were given since
  // The service's last one, where it had more than this journal: what it has is not told again. Until a report of a
  // newer generation comes.
  std::optional<mission::progress_report> service_report = {};
  std::vector<std::string> left_out = {}; // items of changes that the service will not have: they are not reported
  std::uint32_t lost_reports = 0;         // that did not come here, or for which there was no room
  std::uint32_t seen_limit = 0;           // rows of the next batch, because larger ones were refused; 0: as it is set
  std::uint32_t ignored_limit = 0;        // the same of ignored items
  GODWIT_FIELDS(mission_note, "mission_client.mission_note", mission_id, is_deleted, is_pushing, was_asked, seen_done,
                ignored_done, last_report_no, service_report_no, sure_report_no, asks_progress, service_report,
                left_out, lost_reports, seen_limit, ignored_limit);

  [[nodiscard]] bool is_done(destination to) const {
    return to == destination::observations ? seen_done : ignored_done;
  }
  [[nodiscard]] std::uint32_t limit(destination to) const {
    return to == destination::observations ? seen_limit : ignored_limit;
  }
  void set_limit(destination to, std::uint32_t rows) {
    (to == destination::observations ? seen_limit : ignored_limit) = rows;
  }
  void set_done(destination to, bool done) { (to == destination::observations ? seen_done : ignored_done) = done; }
};

struct open_assignment {
  mission::assignment what;
  bool is_responded = false; // and the response is not delivered yet
  GODWIT_FIELDS(open_assignment, "mission_client.open_assignment", what, is_responded);
};

// What the map store has to be told, until it has confirmed it.
enum class store_operation_kind { delete_mission, orphan_mission, requeue_mission, accept_copy };

GODWIT_ENUM_NAMES(store_operation_kind, delete_mission, orphan_mission, requeue_mission, accept_copy);

struct store_operation {
  store_operation_kind kind = store_operation_kind::delete_mission;
  std::string mission_id; // empty, to queue again: all
  std::string reason;
  GODWIT_FIELDS(store_operation, "mission_client.errand", kind, mission_id, reason);
};

struct state {
  phase now = phase::idle;
  std::string mission_id;         // empty: the next one of the service, which has not named it yet
  std::int32_t revision = 0;      // 0: nothing is loaded
  std::string schema_version;     // of the last mission that the service sent
  std::int64_t last_fetch_ns = 0; // 0: never
  pull_state pull = pull_state::not_started;
  std::optional<mission_refused> refused; // the last one that was fetched for nothing, until one is taken
  std::int32_t asks_after = 0;            // assignments up to this revision are known; 0: see polling.cpp
  bool looks_up = false;                  // the fate of a change is not known: the mission has to be fetched
  std::vector<mission_note> missions;
  std::vector<outbox_row> rows;                  // in the order in which they came
  std::vector<open_assignment> assignments;      // of mission_id, oldest first
  std::vector<store_operation> store_operations; // oldest first
  std::vector<std::string> resolved_keys;        // oldest first
  std::uint64_t next_order = 1;
  std::uint64_t resolved_rows = 0;
  std::uint64_t refused_rows = 0; // for which there was no room
  std::string vehicle_id;         // whose next mission is asked for
  std::vector<std::string> over;  // missions that are not begun again
  static constexpr int version = 1;
  static constexpr auto fields = io::table(
      "mission_client.state", io::field("now", &state::now), io::field("mission_id", &state::mission_id),
      io::field("revision", &state::revision), io::field("schema_version", &state::schema_version),
      io::field("last_fetch_ns", &state::last_fetch_ns), io::field("pull", &state::pull),
      io::field("refused", &state::refused), io::field("asks_after", &state::asks_after),
      io::field("looks_up", &state::looks_up), io::field("missions", &state::missions), io::field("rows", &state::rows),
      io::field("assignments", &state::assignments), io::field("errands", &state::store_operations),
      io::field("settled_keys", &state::resolved_keys), io::field("next_order", &state::next_order),
      io::field("settled_rows", &state::resolved_rows), io::field("refused_rows", &state::refused_rows),
      io::field("vehicle_id", &state::vehicle_id), io::field("over", &state::over));
};

[[nodiscard]] const mission_note* find_note(const state& s, std::string_view mission_id);
[[nodiscard]] inline bool is_deleted(const state& s, std::string_view mission_id) {
  const auto* note = find_note(s, mission_id);
  return note != nullptr && note->is_deleted;
}
// It is loaded, and what the map store owes for it is not asked for yet.
[[nodiscard]] inline bool is_in_flight(const state& s, std::string_view mission_id) {
  const auto* note = find_note(s, mission_id);
  return mission_id == s.mission_id && (note == nullptr || !(note->is_pushing || note->seen_done));
}
[[nodiscard]] inline bool is_mission_over(const state& s, std::string_view mission_id) {
  return std::ranges::find(s.over, mission_id) != s.over.end();
}
// A mission is loaded, and the service may have reports of it that this journal has not.
[[nodiscard]] inline bool goes_on_with_mission(const state& s) {
  return (s.now == phase::pulling || s.now == phase::ready) && !is_deleted(s, s.mission_id);
}
[[nodiscard]] inline bool asks_progress(const state& s, std::string_view mission_id) {
  const auto* note = find_note(s, mission_id);
  return note != nullptr && note->asks_progress;
}

} // namespace godwit::mission_client
