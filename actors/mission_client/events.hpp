// What happens to the durable state beside what others say (messages/mission_client/types.hpp), and what comes of it.
// Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "actors/mission_client/outbox.hpp"
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

// A new incarnation goes on with its mission; the journal may be an older one than the reports that the service has.
struct begun_anew {
  static constexpr auto fields = io::table("mission_client.begun_anew");
};

// What the service has of a mission with which this journal goes on.
struct progress_told {
  std::string mission_id;
  std::optional<std::uint32_t> last_report_no; // absent: it does not say
  std::optional<mission::progress_report> last_report{};
  static constexpr auto fields =
      io::table("mission_client.progress_told", io::field("mission_id", &progress_told::mission_id),
                io::field("last_report_no", &progress_told::last_report_no),
                io::field("last_report", &progress_told::last_report));
};

// The map store owes something for these missions.
struct owed_found {
  std::vector<std::string> mission_ids;
  static constexpr auto fields =
      io::table("mission_client.owed_found", io::field("mission_ids", &owed_found::mission_ids));
};

struct mission_fetched {
  mission::document document;
  std::optional<std::uint32_t> last_report_no; // that the service has of it; absent: it does not say
  std::optional<mission::progress_report> last_report{};
  static constexpr auto fields =
      io::table("mission_client.mission_fetched", io::field("document", &mission_fetched::document),
                io::field("last_report_no", &mission_fetched::last_report_no),
                io::field("last_report", &mission_fetched::last_report));
};

struct fetch_failed {
  mission_refused refusal;
  static constexpr auto fields = io::table("mission_client.fetch_failed", io::field("refusal", &fetch_failed::refusal));
};

struct pull_ended {
  map_pulled result;
  static constexpr auto fields = io::table("mission_client.pull_ended", io::field("result", &pull_ended::result));
};

// The fate of a change was not known. Without a document: this is no mission that could be flown, REASON says why.
struct mission_looked_up {
  std::string mission_id;
  std::optional<mission::document> document;
  std::string reason;
  static constexpr auto fields =
      io::table("mission_client.mission_looked_up", io::field("mission_id", &mission_looked_up::mission_id),
                io::field("document", &mission_looked_up::document), io::field("reason", &mission_looked_up::reason));
};

struct assignments_seen {
  std::string mission_id;
  std::vector<mission::assignment> assignments;
  static constexpr auto fields =
      io::table("mission_client.assignments_seen", io::field("mission_id", &assignments_seen::mission_id),
                io::field("assignments", &assignments_seen::assignments));
};

// The service has them.
struct rows_delivered {
  std::vector<std::string> keys;
  static constexpr auto fields = io::table("mission_client.rows_delivered", io::field("keys", &rows_delivered::keys));
};

// A try failed, and a later one may go well.
struct rows_failed {
  std::vector<std::string> keys; // of one lane
  std::string error;
  std::int64_t retry_after_ns = 0; // as the service asked
  static constexpr auto fields =
      io::table("mission_client.rows_failed", io::field("keys", &rows_failed::keys),
                io::field("error", &rows_failed::error), io::field("retry_after_ns", &rows_failed::retry_after_ns));
};

// The service will never take them.
struct rows_refused {
  std::vector<std::string> keys; // of one lane
  std::string reason;
  bool ends_lane = false; // nor what comes behind them
  std::uint32_t rows = 0; // of the map, in the one batch
  static constexpr auto fields = io::table(
      "mission_client.rows_refused", io::field("keys", &rows_refused::keys), io::field("reason", &rows_refused::reason),
      io::field("ends_lane", &rows_refused::ends_lane), io::field("rows", &rows_refused::rows));
};

// 410: the service does not know the mission any more.
struct mission_gone {
  std::string mission_id;
  static constexpr auto fields =
      io::table("mission_client.mission_gone", io::field("mission_id", &mission_gone::mission_id));
};

// A delivery of the map's rows. Its key exists before the store is asked for the rows.
struct batch_planned {
  std::string key;
  std::string mission_id;
  destination to = destination::observations;
  static constexpr auto fields =
      io::table("mission_client.batch_planned", io::field("key", &batch_planned::key),
                io::field("mission_id", &batch_planned::mission_id), io::field("to", &batch_planned::to));
};

// The store has no row more for it.
struct batch_empty {
  std::string key;
  static constexpr auto fields = io::table("mission_client.batch_empty", io::field("key", &batch_empty::key));
};

// The store has the rows of the batch back.
struct batch_returned {
  std::string key;
  static constexpr auto fields = io::table("mission_client.batch_returned", io::field("key", &batch_returned::key));
};

// The answer to an insert or a tail.
struct change_done {
  std::string key;
  mission::document document;
  static constexpr auto fields = io::table("mission_client.change_done", io::field("key", &change_done::key),
                                           io::field("document", &change_done::document));
};

struct change_failed {
  std::string key;
  change_verdict verdict = change_verdict::unknown;
  std::string reason;
  static constexpr auto fields =
      io::table("mission_client.change_failed", io::field("key", &change_failed::key),
                io::field("verdict", &change_failed::verdict), io::field("reason", &change_failed::reason));
};

// The store has done the oldest store_operation.
struct store_operation_done {
  store_operation what;
  static constexpr auto fields =
      io::table("mission_client.errand_done", io::field("what", &store_operation_done::what));
};

// The wall clock was set; what was noted under it moves along.
struct clock_jumped {
  std::int64_t by_ns = 0;
  static constexpr auto fields = io::table("mission_client.clock_jumped", io::field("by_ns", &clock_jumped::by_ns));
};

using event = std::variant<begin_mission, pull_map, accept_copy, push_map, report_progress, respond_to_assignment,
                           insert_waypoint, replace_tail, retry_outbox, begun_anew, progress_told, earlier_delivered,
                           owed_found, mission_fetched, fetch_failed, pull_ended, mission_looked_up, assignments_seen,
                           rows_delivered, rows_failed, rows_refused, mission_gone, batch_planned, batch_empty,
                           batch_returned, change_done, change_failed, store_operation_done, clock_jumped>;

// -- effects, beside what the listener is told ----------------------------------------------------

enum class noted_as {
  waiting,
  delivered,
  returned, // nothing of it is owed under this key any more
  dropped
};

constexpr auto enum_names(noted_as) {
  return io::names<noted_as>({{noted_as::waiting, "waiting"},
                              {noted_as::delivered, "delivered"},
                              {noted_as::returned, "returned"},
                              {noted_as::dropped, "dropped"}});
}

// For people: the row as the journal's table of deliveries is to show it.
struct row_noted {
  outbox_row row;
  noted_as how = noted_as::waiting; // as the row says, or it has left the outbox
  static constexpr auto fields =
      io::table("mission_client.row_noted", io::field("row", &row_noted::row), io::field("how", &row_noted::how));
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
  static constexpr auto fields = io::table("mission_client.on_disk", io::field("below_order", &on_disk::below_order),
                                           io::field("frees_lanes", &on_disk::frees_lanes));
};

using effect =
    std::variant<mission_loaded, earlier_found, mission_refused, map_pulled, change_outcome, assignment_arrived,
                 mission_deleted, mission_resolved, retry_answer, row_noted, table_pruned, on_disk>;

} // namespace godwit::mission_client
