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
  GODWIT_FIELDS(begin_mission, "mission_client.begin_mission", mission_id);
};

// Deliver what earlier missions left, then ask the service for the vehicle's next mission until there is one, and go on
// with that as with begin_mission. Said again while it is asked for, or while a mission is loaded that is not OVER, it
// changes nothing; after a refusal it asks anew.
struct begin_next {
  std::string vehicle_id;        // as the service calls it
  std::vector<std::string> over; // missions that are not begun again: flown to their end, called off, or withdrawn
  GODWIT_FIELDS(begin_next, "mission_client.begin_next", vehicle_id, over);
};

// Pull the map again, after a pull that failed.
struct pull_map {
  std::string mission_id;
  GODWIT_FIELDS(pull_map, "mission_client.pull_map", mission_id);
};

// An operator flies with the copy from before (pull_state cached_fallback): what is seen counts from it. Said again, or
// when the map is not such a copy, it changes nothing.
struct accept_copy {
  std::string mission_id;
  GODWIT_FIELDS(accept_copy, "mission_client.accept_copy", mission_id);
};

// The flight is over: deliver what the map store owes for it. Said again, it looks again. Answered by
// mission_resolved.
struct push_map {
  std::string mission_id;
  GODWIT_FIELDS(push_map, "mission_client.push_map", mission_id);
};

// In the order of report_no, without a gap, for each mission. Delivered in that order.
struct report_progress {
  std::string key;
  mission::progress_report report;
  GODWIT_FIELDS(report_progress, "mission_client.report_progress", key, report);
};

struct respond_to_assignment {
  std::string mission_id;
  std::string assignment_id;
  mission::assignment_response response; // its idempotency_key is the key
  GODWIT_FIELDS(respond_to_assignment, "mission_client.respond_to_assignment", mission_id, assignment_id, response);
};

// Somebody waits: at most three tries within 2 s, then it has failed. Answered by change_outcome. IS_FLOWN, with the
// same key: the vehicle flies it without an answer. Then it is kept until the service has it, before all changes and
// reports that come later.
struct insert_waypoint {
  std::string mission_id;
  mission::waypoint_insert insert; // its idempotency_key is the key
  bool is_flown = false;
  GODWIT_FIELDS(insert_waypoint, "mission_client.insert_waypoint", mission_id, insert, is_flown);
};

struct replace_tail {
  std::string mission_id;
  mission::tail tail; // its idempotency_key is the key
  bool is_flown = false;
  GODWIT_FIELDS(replace_tail, "mission_client.replace_tail", mission_id, tail, is_flown);
};

// What the camera has shown of what OBSERVATION_ID is about: a JPEG in FILE of the folder of pictures, whose name it
// is. It is delivered after the flight, to a service that takes pictures. Repeated, it changes nothing.
struct deliver_picture {
  std::string mission_id;
  std::string observation_id;
  std::string file;
  std::int64_t captured_ns = 0;
  GODWIT_FIELDS(deliver_picture, "mission_client.deliver_picture", mission_id, observation_id, file, captured_ns);
};

// It is on the disk that this picture is to be delivered, or it never will be; whoever asked may forget it.
struct picture_noted {
  static constexpr auto fields = io::table("mission_client.picture_noted");
};

// The operator fetched what was needed, or the address of the service was mended: what is pending is tried now, what is
// orphaned or expired is queued again, with its tries and its window beginning anew.
struct retry_outbox {
  std::string key; // of one row; empty: all
  GODWIT_FIELDS(retry_outbox, "mission_client.retry_outbox", key);
};

struct retry_answer {
  std::uint32_t tried_now = 0; // were pending
  std::uint32_t queued = 0;    // were orphaned or expired
  std::string error;           // sentence for people; empty when something was found
  GODWIT_FIELDS(retry_answer, "mission_client.retry_answer", tried_now, queued, error);
};

struct get_service {
  static constexpr auto fields = io::table("mission_client.get_service");
};

enum class connection_state { unknown, reachable, unreachable };

GODWIT_ENUM_NAMES(connection_state, unknown, reachable, unreachable);

enum class pull_state { not_started, in_flight, synced, cached_fallback, failed };

GODWIT_ENUM_NAMES(pull_state, not_started, in_flight, synced, cached_fallback, failed);

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
  bool waits_for_next = false;    // the service is asked for the vehicle's next mission, and has named none yet
  GODWIT_FIELDS(service_status, "mission_client.service_status", mission_id, revision, schema_version, last_fetch_ns,
                fetch_errors, connection, pull, push_pending, pending, orphaned, expired, last_error, delivery_error,
                may_deliver, refused, refused_sample, lost_reports, waits_for_next);
};

// -- told to the executor -------------------------------------------------------------------------

enum class load_cause { fetched, changed, looked_up, brought };

constexpr auto enum_names(load_cause) {
  return io::names<load_cause>({{load_cause::fetched, "fetched"},     // begin_mission
                                {load_cause::changed, "changed"},     // the answer to an insert or a tail
                                {load_cause::looked_up, "looked_up"}, // after a change whose fate was not known
                                {load_cause::brought, "brought"}});   // by people, through the operators' page
}

// Reports of the mission that the service has and this journal has not: it was lost, or another vehicle sent them.
struct earlier_reports {
  std::uint32_t last_report_no = 0;
  std::optional<mission::progress_report> last_report; // absent: the service does not give it back
  GODWIT_FIELDS(earlier_reports, "mission_client.earlier_reports", last_report_no, last_report);
};

// This is the mission from now on, instead of the one in memory.
struct mission_loaded {
  load_cause cause = load_cause::fetched;
  mission::document document;
  std::optional<earlier_reports> earlier{};
  std::uint32_t last_report_no = 0; // fetched: of the newest report that the service or this journal has
  GODWIT_FIELDS(mission_loaded, "mission_client.mission_loaded", cause, document, earlier, last_report_no);
};

// The same of the mission that is loaded, found when mission_client began anew with it: the journal is an older one.
struct earlier_found {
  std::string mission_id;
  earlier_reports earlier;
  GODWIT_FIELDS(earlier_found, "mission_client.earlier_found", mission_id, earlier);
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
  GODWIT_FIELDS(mission_refused, "mission_client.mission_refused", mission_id, why, reason, sample);
};

// How the pull ended: synced; cached_fallback: failed, with a copy from before in the store; failed: and without.
struct map_pulled {
  std::string mission_id;
  pull_state state = pull_state::failed;
  std::uint64_t objects = 0;
  std::uint64_t ignored = 0;
  std::string reason; // sentence for people; empty when synced
  GODWIT_FIELDS(map_pulled, "mission_client.map_pulled", mission_id, state, objects, ignored, reason);
};

enum class change_verdict {
  done,    // mission_loaded came before this
  stale,   // meant for another revision: nothing was changed, the newest mission is being fetched
  refused, // the service will not have it: nothing was changed
  unknown  // no answer in time: it may have happened; the mission is looked up as soon as the service answers
};

GODWIT_ENUM_NAMES(change_verdict, done, stale, refused, unknown);

struct change_outcome {
  std::string key;
  change_verdict verdict = change_verdict::unknown;
  std::string reason; // sentence for people; empty when done
  GODWIT_FIELDS(change_outcome, "mission_client.change_outcome", key, verdict, reason);
};

// The service wants other items. Comes again after a restart until it is responded to.
struct assignment_arrived {
  std::string mission_id;
  mission::assignment assignment;
  GODWIT_FIELDS(assignment_arrived, "mission_client.assignment_arrived", mission_id, assignment);
};

// The service does not know this mission any more.
struct mission_deleted {
  std::string mission_id;
  GODWIT_FIELDS(mission_deleted, "mission_client.mission_deleted", mission_id);
};

// After push_map: nothing is pending for this mission any more.
struct mission_resolved {
  std::string mission_id;
  std::uint32_t orphaned = 0; // rows of the outbox that are kept and not tried any more
  std::uint32_t expired = 0;
  GODWIT_FIELDS(mission_resolved, "mission_client.mission_settled", mission_id, orphaned, expired);
};

// What the service's thread and the timers say to mission_client: nothing that anybody else needs. Thread: plain
// values.

// An answer of the service has come; it waits in the port, not in the mailbox.
struct wake {
  static constexpr auto fields = io::table("mission_client.wake");
};

} // namespace godwit::mission_client
