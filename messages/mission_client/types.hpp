// What is said to mission_client, and what it tells the executor.
//
// All ids and keys are UUIDs in small letters; times are nanoseconds since 1970 (UTC). What is owed to the service is
// told as a durable effect by whoever owes it, so that it comes once in effect; its key was made before the first try
// and is the idempotency key on the wire. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/mission/change.hpp"
#include "messages/mission/document.hpp"
#include "messages/mission/progress.hpp"

namespace godwit::mission_client {

// -- said to mission_client -----------------------------------------------------------------------

// Deliver what earlier missions left, then fetch this one, then pull its map. Answered by mission_loaded and
// map_pulled, or by mission_refused. Said again for the mission that is loaded or being loaded, it changes nothing;
// after a refusal it tries anew.
struct begin_mission {
  std::string mission_id;
  static constexpr auto fields =
      io::table("mission_client.begin_mission", io::field("mission_id", &begin_mission::mission_id));
};

// Pull the map again, after a pull that failed.
struct pull_map {
  std::string mission_id;
  static constexpr auto fields = io::table("mission_client.pull_map", io::field("mission_id", &pull_map::mission_id));
};

// An operator flies with the copy from before (pull_state cached_fallback): what is seen counts from it. Said again, or
// when the map is not such a copy, it changes nothing.
struct accept_copy {
  std::string mission_id;
  static constexpr auto fields =
      io::table("mission_client.accept_copy", io::field("mission_id", &accept_copy::mission_id));
};

// The flight is over: deliver what the map store owes for it. Said again, it looks again. Answered by
// mission_resolved.
struct push_map {
  std::string mission_id;
  static constexpr auto fields = io::table("mission_client.push_map", io::field("mission_id", &push_map::mission_id));
};

// In the order of report_no, without a gap, for each mission. Delivered in that order.
struct report_progress {
  std::string key;
  mission::progress_report report;
  static constexpr auto fields = io::table("mission_client.report_progress", io::field("key", &report_progress::key),
                                           io::field("report", &report_progress::report));
};

struct respond_to_assignment {
  std::string mission_id;
  std::string assignment_id;
  mission::assignment_response response; // its idempotency_key is the key
  static constexpr auto fields =
      io::table("mission_client.respond_to_assignment", io::field("mission_id", &respond_to_assignment::mission_id),
                io::field("assignment_id", &respond_to_assignment::assignment_id),
                io::field("response", &respond_to_assignment::response));
};

// Somebody waits: at most three tries within 2 s, then it has failed. Answered by change_outcome. IS_FLOWN, with the
// same key: the vehicle flies it without an answer. Then it is kept until the service has it, before all changes and
// reports that come later.
struct insert_waypoint {
  std::string mission_id;
  mission::waypoint_insert insert; // its idempotency_key is the key
  bool is_flown = false;
  static constexpr auto fields =
      io::table("mission_client.insert_waypoint", io::field("mission_id", &insert_waypoint::mission_id),
                io::field("insert", &insert_waypoint::insert), io::field("is_flown", &insert_waypoint::is_flown));
};

struct replace_tail {
  std::string mission_id;
  mission::tail tail; // its idempotency_key is the key
  bool is_flown = false;
  static constexpr auto fields =
      io::table("mission_client.replace_tail", io::field("mission_id", &replace_tail::mission_id),
                io::field("tail", &replace_tail::tail), io::field("is_flown", &replace_tail::is_flown));
};

// The operator fetched what was needed, or the address of the service was mended: what is pending is tried now, what is
// orphaned or expired is queued again, with its tries and its window beginning anew.
struct retry_outbox {
  std::string key; // of one row; empty: all
  static constexpr auto fields = io::table("mission_client.retry_outbox", io::field("key", &retry_outbox::key));
};

struct retry_answer {
  std::uint32_t tried_now = 0; // were pending
  std::uint32_t queued = 0;    // were orphaned or expired
  std::string error;           // sentence for people; empty when something was found
  static constexpr auto fields =
      io::table("mission_client.retry_answer", io::field("tried_now", &retry_answer::tried_now),
                io::field("queued", &retry_answer::queued), io::field("error", &retry_answer::error));
};

struct get_service {
  static constexpr auto fields = io::table("mission_client.get_service");
};

enum class connection_state { unknown, reachable, unreachable };

constexpr auto enum_names(connection_state) {
  return io::names<connection_state>({{connection_state::unknown, "unknown"},
                                      {connection_state::reachable, "reachable"},
                                      {connection_state::unreachable, "unreachable"}});
}

enum class pull_state { not_started, in_flight, synced, cached_fallback, failed };

constexpr auto enum_names(pull_state) {
  return io::names<pull_state>({{pull_state::not_started, "not_started"},
                                {pull_state::in_flight, "in_flight"},
                                {pull_state::synced, "synced"},
                                {pull_state::cached_fallback, "cached_fallback"},
                                {pull_state::failed, "failed"}});
}

// What a preflight check and the operator look at.
struct service_status {
  std::string mission_id;
  std::int32_t revision = 0;      // 0 while nothing is loaded
  std::string schema_version;     // of the last mission that the service sent
  std::int64_t last_fetch_ns = 0; // 0 = never
  std::uint64_t fetch_errors = 0; // since the process began
  connection_state connection = connection_state::unknown;
  pull_state pull = pull_state::not_started;
  std::uint32_t push_pending = 0; // observations and ignored items that are taken into batches and not delivered
  std::uint32_t pending = 0;      // rows of the outbox
  std::uint32_t orphaned = 0;
  std::uint32_t expired = 0;
  std::string last_error;     // sentence for people; empty when the last call of each kind went well
  std::string delivery_error; // what of it is about deliveries
  bool may_deliver = true;    // false: a delivery for this mission was answered with 401 or 403, and waits for a person
  std::string refused;        // why the last mission that was asked for was not taken; empty: it was
  std::string refused_sample; // the beginning of what came instead of one, at most 1 KiB; kept over restarts
  std::uint64_t lost_reports = 0; // of progress, that were never delivered; what came after them was
  static constexpr auto fields = io::table(
      "mission_client.service_status", io::field("mission_id", &service_status::mission_id),
      io::field("revision", &service_status::revision), io::field("schema_version", &service_status::schema_version),
      io::field("last_fetch_ns", &service_status::last_fetch_ns),
      io::field("fetch_errors", &service_status::fetch_errors), io::field("connection", &service_status::connection),
      io::field("pull", &service_status::pull), io::field("push_pending", &service_status::push_pending),
      io::field("pending", &service_status::pending), io::field("orphaned", &service_status::orphaned),
      io::field("expired", &service_status::expired), io::field("last_error", &service_status::last_error),
      io::field("delivery_error", &service_status::delivery_error),
      io::field("may_deliver", &service_status::may_deliver), io::field("refused", &service_status::refused),
      io::field("refused_sample", &service_status::refused_sample),
      io::field("lost_reports", &service_status::lost_reports));
};

// -- told to the executor -------------------------------------------------------------------------

enum class load_cause { fetched, changed, looked_up };

constexpr auto enum_names(load_cause) {
  return io::names<load_cause>({{load_cause::fetched, "fetched"},       // begin_mission
                                {load_cause::changed, "changed"},       // the answer to an insert or a tail
                                {load_cause::looked_up, "looked_up"}}); // after a change whose fate was not known
}

// Reports of the mission that the service has and this journal has not: it was lost, or another vehicle sent them.
struct earlier_reports {
  std::uint32_t last_report_no = 0;
  std::optional<mission::progress_report> last_report; // absent: the service does not give it back
  static constexpr auto fields =
      io::table("mission_client.earlier_reports", io::field("last_report_no", &earlier_reports::last_report_no),
                io::field("last_report", &earlier_reports::last_report));
};

// This is the mission from now on, instead of the one in memory.
struct mission_loaded {
  load_cause cause = load_cause::fetched;
  mission::document document;
  std::optional<earlier_reports> earlier{};
  std::uint32_t last_report_no = 0; // fetched: of the newest report that the service or this journal has
  static constexpr auto fields =
      io::table("mission_client.mission_loaded", io::field("cause", &mission_loaded::cause),
                io::field("document", &mission_loaded::document), io::field("earlier", &mission_loaded::earlier),
                io::field("last_report_no", &mission_loaded::last_report_no));
};

// The same of the mission that is loaded, found when mission_client began anew with it: the journal is an older one.
struct earlier_found {
  std::string mission_id;
  earlier_reports earlier;
  static constexpr auto fields =
      io::table("mission_client.earlier_found", io::field("mission_id", &earlier_found::mission_id),
                io::field("earlier", &earlier_found::earlier));
};

enum class refusal {
  unreachable,  // the service did not answer well within the tries
  not_allowed,  // 401, 403: the token
  not_found,    // 404: no such mission, or a mistyped address
  deleted,      // 410
  invalid,      // what came is no valid mission, or of another major version
  misconfigured // TLS, redirect, token file: a person has to act
};

constexpr auto enum_names(refusal) {
  return io::names<refusal>({{refusal::unreachable, "unreachable"},
                             {refusal::not_allowed, "not_allowed"},
                             {refusal::not_found, "not_found"},
                             {refusal::deleted, "deleted"},
                             {refusal::invalid, "invalid"},
                             {refusal::misconfigured, "misconfigured"}});
}

struct mission_refused {
  std::string mission_id;
  refusal why = refusal::unreachable;
  std::string reason; // sentence for people: what is wrong, where, what to do
  std::string sample; // the beginning of what came, at most 1 KiB; empty when nothing came
  static constexpr auto fields =
      io::table("mission_client.mission_refused", io::field("mission_id", &mission_refused::mission_id),
                io::field("why", &mission_refused::why), io::field("reason", &mission_refused::reason),
                io::field("sample", &mission_refused::sample));
};

// How the pull ended: synced; cached_fallback: failed, with a copy from before in the store; failed: and without.
struct map_pulled {
  std::string mission_id;
  pull_state state = pull_state::failed;
  std::uint64_t objects = 0;
  std::uint64_t ignored = 0;
  std::string reason; // sentence for people; empty when synced
  static constexpr auto fields =
      io::table("mission_client.map_pulled", io::field("mission_id", &map_pulled::mission_id),
                io::field("state", &map_pulled::state), io::field("objects", &map_pulled::objects),
                io::field("ignored", &map_pulled::ignored), io::field("reason", &map_pulled::reason));
};

enum class change_verdict {
  done,    // mission_loaded came before this
  stale,   // meant for another revision: nothing was changed, the newest mission is being fetched
  refused, // the service will not have it: nothing was changed
  unknown  // no answer in time: it may have happened; the mission is looked up as soon as the service answers
};

constexpr auto enum_names(change_verdict) {
  return io::names<change_verdict>({{change_verdict::done, "done"},
                                    {change_verdict::stale, "stale"},
                                    {change_verdict::refused, "refused"},
                                    {change_verdict::unknown, "unknown"}});
}

struct change_outcome {
  std::string key;
  change_verdict verdict = change_verdict::unknown;
  std::string reason; // sentence for people; empty when done
  static constexpr auto fields =
      io::table("mission_client.change_outcome", io::field("key", &change_outcome::key),
                io::field("verdict", &change_outcome::verdict), io::field("reason", &change_outcome::reason));
};

// The service wants other items. Comes again after a restart until it is responded to.
struct assignment_arrived {
  std::string mission_id;
  mission::assignment assignment;
  static constexpr auto fields =
      io::table("mission_client.assignment_arrived", io::field("mission_id", &assignment_arrived::mission_id),
                io::field("assignment", &assignment_arrived::assignment));
};

// The service does not know this mission any more.
struct mission_deleted {
  std::string mission_id;
  static constexpr auto fields =
      io::table("mission_client.mission_deleted", io::field("mission_id", &mission_deleted::mission_id));
};

// After push_map: nothing is pending for this mission any more.
struct mission_resolved {
  std::string mission_id;
  std::uint32_t orphaned = 0; // rows of the outbox that are kept and not tried any more
  std::uint32_t expired = 0;
  static constexpr auto fields =
      io::table("mission_client.mission_settled", io::field("mission_id", &mission_resolved::mission_id),
                io::field("orphaned", &mission_resolved::orphaned), io::field("expired", &mission_resolved::expired));
};

} // namespace godwit::mission_client
