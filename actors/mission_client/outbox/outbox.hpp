// What is owed to the missions service: one row for each thing, in the order in which it came.
//
//                 tried, and the service has it
//   [pending] ────────────────────────────────────> (gone from here; "delivered" in the journal's table)
//    ^  │  │
//    │  │  ├─ a batch of several rows is refused ───────> (its rows are the store's again, and go out in halves)
//    │  │  └─ a try fails 24 h after the first failure ─> [expired]
//    │  └──── the service will never take it ───────────> [orphaned]
//    └──────────────── a person queues it again ──────────────┘
//
// Rows of one mission and one destination are a lane: they go out one after the other, and lanes know nothing of each
// other. Only a change that the vehicle flies already (is_flown) stands between them: it goes out after all responses
// of before it, and nothing of its mission that came later goes out before it. A change (waypoint, tail) is never
// orphaned or expired: it fails, and is gone.
//
// Times are nanoseconds since 1970 (UTC). Thread: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::mission_client {

enum class destination { progress, assignment_response, waypoint, tail, observations, ignored_items, picture };

GODWIT_ENUM_NAMES(destination, progress, assignment_response, waypoint, tail, observations, ignored_items, picture);

// Somebody waits for these.
[[nodiscard]] constexpr bool is_change(destination to) {
  return to == destination::waypoint || to == destination::tail;
}
// What these rows deliver is kept by the map store, under the key of the row.
[[nodiscard]] constexpr bool is_map(destination to) {
  return to == destination::observations || to == destination::ignored_items;
}

enum class row_state { pending, orphaned, expired };

GODWIT_ENUM_NAMES(row_state, pending, orphaned, expired);

struct outbox_row {
  std::string key{}; // made before the first try, never changed
  destination to = destination::progress;
  std::string mission_id{};
  std::string subject{};   // of a response: the assignment's id; of a picture: the name of its file
  std::string body{};      // JSON: the report, or what is posted as it is; of the map's nothing
  std::uint64_t order = 0; // rises by one with each row
  std::int64_t created_ns = 0;
  std::uint32_t tries = 0; // that failed
  std::string last_error{};
  std::int64_t next_try_ns = 0;
  std::int64_t first_failure_ns = 0; // 0: it has not failed yet
  row_state state = row_state::pending;
  bool is_flown = false;  // a change that the vehicle flies already: kept until the service has it
  bool goes_back = false; // of the map: the service will not have it under this key; the store gets its rows back
  GODWIT_FIELDS(outbox_row, "mission_client.outbox_row", key, to, mission_id, subject, body, order, created_ns, tries,
                last_error, next_try_ns, first_failure_ns, state, goes_back, is_flown);
};

// Somebody waits for the answer.
[[nodiscard]] inline bool is_waited_for(const outbox_row& row) { return is_change(row.to) && !row.is_flown; }

// 3 h of reports, two a second, for a service that is down: 10 MB of state.
inline constexpr std::size_t max_outbox_rows = 20'000;
// Rows that are taken above this bound: answers and changes are few, and matter more than one more report.
inline constexpr std::size_t outbox_reserve = 500;
// What is kept of an error.
inline constexpr std::size_t max_error_text = 512;
// TEXT with at most so many bytes, and no character cut in two.
[[nodiscard]] std::string cut_error(std::string_view text);

struct outbox_counts {
  std::uint32_t pending = 0;
  std::uint32_t orphaned = 0;
  std::uint32_t expired = 0;
};

// No row at all is taken any more.
[[nodiscard]] inline bool is_full(const std::vector<outbox_row>& rows) {
  return rows.size() >= max_outbox_rows + outbox_reserve;
}
[[nodiscard]] outbox_row* find_row(std::vector<outbox_row>& rows, std::string_view key);
[[nodiscard]] const outbox_row* find_row(const std::vector<outbox_row>& rows, std::string_view key);
[[nodiscard]] outbox_counts count_rows(const std::vector<outbox_row>& rows, std::string_view mission_id = {});
// A bound of order: rows of ROW's kind and mission from here on wait, because what stands there has to be at the
// service first, which then knows their items and their revision.
[[nodiscard]] std::uint64_t held_back_from(const std::vector<outbox_row>& rows, const outbox_row& row);
// Whether a row waits in this lane.
[[nodiscard]] bool is_waiting(const std::vector<outbox_row>& rows, destination to, std::string_view mission_id);
// The pending rows of ROW's lane from ROW on, at most LIMIT, as they go out together.
[[nodiscard]] std::vector<const outbox_row*> cut_from(const std::vector<outbox_row>& rows, const outbox_row& row,
                                                      std::size_t limit);

} // namespace godwit::mission_client
