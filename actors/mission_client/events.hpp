// What happens to the durable state beside what others say (messages/mission_client/types.hpp), and what comes of it.
// Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "actors/mission_client/outbox/outbox.hpp"
#include "actors/mission_client/state.hpp"
#include "io/fields/field_table.hpp"
#include "messages/mission_client/types.hpp"
#include "runtime/effect_kind.hpp"

namespace godwit::mission_client {

// -- events ---------------------------------------------------------------------------------------

// What earlier missions left is delivered, or has been tried often enough for now.
struct earlier_delivered {
  static constexpr auto fields = io::table("mission_client.earlier_delivered");
};

// The service has named the vehicle's next mission.
struct next_given {
  std::string mission_id;
  GODWIT_FIELDS(next_given, "mission_client.next_given", mission_id);
};

// A new incarnation goes on with its mission; the journal may be an older one than the reports that the service has.
struct begun_anew {
  static constexpr auto fields = io::table("mission_client.begun_anew");
};

// What the service has of a mission with which this journal goes on.
struct progress_told {
  std::string mission_id;
  std::optional<std::uint32_t> last_report_no; // absent: it does not say
  std::optional<mission::progress_report> last_report{};
  GODWIT_FIELDS(progress_told, "mission_client.progress_told", mission_id, last_report_no, last_report);
};

// The map store owes something for these missions.
struct owed_found {
  std::vector<std::string> mission_ids;
  GODWIT_FIELDS(owed_found, "mission_client.owed_found", mission_ids);
};

struct mission_fetched {
  mission::document document;
  std::optional<std::uint32_t> last_report_no; // that the service has of it; absent: it does not say
  std::optional<mission::progress_report> last_report{};
  GODWIT_FIELDS(mission_fetched, "mission_client.mission_fetched", document, last_report_no, last_report);
};

struct fetch_failed {
  mission_refused refusal;
  GODWIT_FIELDS(fetch_failed, "mission_client.fetch_failed", refusal);
};

struct pull_ended {
  map_pulled result;
  GODWIT_FIELDS(pull_ended, "mission_client.pull_ended", result);
};

// The fate of a change was not known. Without a document: this is no mission that could be flown, REASON says why.
struct mission_looked_up {
  std::string mission_id;
  std::optional<mission::document> document;
  std::string reason;
  GODWIT_FIELDS(mission_looked_up, "mission_client.mission_looked_up", mission_id, document, reason);
};

struct assignments_seen {
  std::string mission_id;
  std::vector<mission::assignment> assignments;
  GODWIT_FIELDS(assignments_seen, "mission_client.assignments_seen", mission_id, assignments);
};

// The service has them.
struct rows_delivered {
  std::vector<std::string> keys;
  GODWIT_FIELDS(rows_delivered, "mission_client.rows_delivered", keys);
};

// A try failed, and a later one may go well.
struct rows_failed {
  std::vector<std::string> keys; // of one lane
  std::string error;
  std::int64_t retry_after_ns = 0; // as the service asked
  GODWIT_FIELDS(rows_failed, "mission_client.rows_failed", keys, error, retry_after_ns);
};

// The service will never take them.
struct rows_refused {
  std::vector<std::string> keys; // of one lane
  std::string reason;
  bool ends_lane = false; // nor what comes after them
  std::uint32_t rows = 0; // of the map, in the one batch
  GODWIT_FIELDS(rows_refused, "mission_client.rows_refused", keys, reason, ends_lane, rows);
};

// 410: the service does not know the mission any more.
struct mission_gone {
  std::string mission_id;
  GODWIT_FIELDS(mission_gone, "mission_client.mission_gone", mission_id);
};

// A delivery of the map's rows. Its key exists before the store is asked for the rows.
struct batch_planned {
  std::string key;
  std::string mission_id;
  destination to = destination::observations;
  GODWIT_FIELDS(batch_planned, "mission_client.batch_planned", key, mission_id, to);
};

// The store has no row more for it.
struct batch_empty {
  std::string key;
  GODWIT_FIELDS(batch_empty, "mission_client.batch_empty", key);
};

// The store has the rows of the batch back.
struct batch_returned {
  std::string key;
  GODWIT_FIELDS(batch_returned, "mission_client.batch_returned", key);
};

// The answer to an insert or a tail.
struct change_done {
  std::string key;
  mission::document document;
  GODWIT_FIELDS(change_done, "mission_client.change_done", key, document);
};

struct change_failed {
  std::string key;
  change_verdict verdict = change_verdict::unknown;
  std::string reason;
  GODWIT_FIELDS(change_failed, "mission_client.change_failed", key, verdict, reason);
};

// The store has done the oldest store_operation.
struct store_operation_done {
  store_operation what;
  GODWIT_FIELDS(store_operation_done, "mission_client.errand_done", what);
};

// The wall clock was set; what was noted under it moves along.
struct clock_jumped {
  std::int64_t by_ns = 0;
  GODWIT_FIELDS(clock_jumped, "mission_client.clock_jumped", by_ns);
};

using event =
    std::variant<begin_mission, begin_next, next_given, pull_map, accept_copy, push_map, report_progress,
                 respond_to_assignment, insert_waypoint, replace_tail, retry_outbox, begun_anew, progress_told,
                 earlier_delivered, owed_found, mission_fetched, fetch_failed, pull_ended, mission_looked_up,
                 assignments_seen, rows_delivered, rows_failed, rows_refused, mission_gone, batch_planned, batch_empty,
                 batch_returned, change_done, change_failed, store_operation_done, clock_jumped, deliver_picture>;

// -- effects, beside what the listener is told ----------------------------------------------------

enum class noted_as {
  waiting,
  delivered,
  returned, // nothing of it is owed under this key any more
  dropped
};

GODWIT_ENUM_NAMES(noted_as, waiting, delivered, returned, dropped);

// For people: the row as the journal's table of deliveries is to show it.
struct row_noted {
  outbox_row row;
  noted_as how = noted_as::waiting; // as the row says, or it has left the outbox
  GODWIT_FIELDS(row_noted, "mission_client.row_noted", row, how);
};

// Time to shorten that table.
struct table_pruned {
  static constexpr auto fields = io::table("mission_client.table_pruned");
};

// Rows below this order are on the disk, and may be delivered.
struct on_disk {
  static constexpr auto goes_out = runtime::effect_kind::after_commit;
  std::uint64_t below_order = 0;
  bool frees_lanes = false; // by a person's will also those that were not allowed
  GODWIT_FIELDS(on_disk, "mission_client.on_disk", below_order, frees_lanes);
};

using effect =
    std::variant<mission_loaded, earlier_found, mission_refused, map_pulled, change_outcome, assignment_arrived,
                 mission_deleted, mission_resolved, retry_answer, row_noted, table_pruned, on_disk, picture_noted>;

} // namespace godwit::mission_client
