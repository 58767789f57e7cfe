#include "actors/health/report_text.hpp"

#include <array>
#include <string_view>

#include "io/fields/json_text.hpp"

namespace godwit::health {
namespace {

using io::prometheus::metric_kind;
using io::prometheus::text_writer;

constexpr double seconds_of_ms = 1e-3;

template <class Owner>
struct row {
  const char* name;
  const char* help;
  std::uint64_t Owner::*value;
};

// Totals after _total count, all else is as it is now.
metric_kind kind_of(std::string_view name) {
  return name.ends_with("_total") ? metric_kind::counter : metric_kind::gauge;
}

template <class Owner, std::size_t N>
void append_rows(text_writer& out, const Owner& of, const std::array<row<Owner>, N>& rows) {
  for (const auto& each : rows)
    out.one(each.name, kind_of(each.name), each.help, of.*each.value);
}

constexpr std::array mail_rows{
    row<mail_figures>{"godwit_actor_mailbox_messages", "Messages that wait for an actor.", &mail_figures::waiting},
    row<mail_figures>{"godwit_actor_messages_total", "Messages that an actor was sent.", &mail_figures::accepted},
    row<mail_figures>{"godwit_actor_messages_handled_total", "Messages that an actor has handled.",
                      &mail_figures::handled},
    row<mail_figures>{"godwit_actor_crashes_total", "Incarnations of an actor that crashed.", &mail_figures::crashes},
    row<mail_figures>{"godwit_actor_messages_requeued_total", "Messages put back after they crashed their handler.",
                      &mail_figures::requeued},
    row<mail_figures>{"godwit_actor_dead_letters_total", "Messages given up after they crashed their handler thrice.",
                      &mail_figures::dead_lettered},
    row<mail_figures>{"godwit_actor_messages_repeated_total", "Durable effects that were seen before.",
                      &mail_figures::repeated},
    row<mail_figures>{"godwit_actor_messages_lost_total", "Messages of a stream that went with a crash.",
                      &mail_figures::lost},
    row<mail_figures>{"godwit_actor_messages_refused_total", "Messages over a bound, and requests while it was away.",
                      &mail_figures::refused},
    row<mail_figures>{"godwit_actor_messages_dropped_total", "Messages to an actor that was not wanted or given up.",
                      &mail_figures::dropped},
    row<mail_figures>{"godwit_actor_messages_not_accepted_total",
                      "Messages that the mailbox of an actor does not have.", &mail_figures::not_accepted},
};

constexpr std::array journal_rows{
    row<journal_figures>{"godwit_journal_commits_total", "Transactions that reached the disk.",
                         &journal_figures::commits},
    row<journal_figures>{"godwit_journal_writes_total", "Writes in these transactions.", &journal_figures::writes},
    row<journal_figures>{"godwit_journal_events_total", "Events in these transactions.", &journal_figures::events},
    row<journal_figures>{"godwit_journal_retries_total", "Commits tried again after an error.",
                         &journal_figures::retries},
    row<journal_figures>{"godwit_journal_refused_total", "Writes that the journal did not take.",
                         &journal_figures::refused},
    row<journal_figures>{"godwit_journal_queued_writes", "Writes that wait for the disk.", &journal_figures::queued},
};

constexpr std::array trace_rows{
    row<trace_figures>{"godwit_trace_records_total", "Deliveries that were recorded.", &trace_figures::recorded},
    row<trace_figures>{"godwit_trace_records_dropped_total", "Deliveries for which a ring was full.",
                       &trace_figures::dropped},
    row<trace_figures>{"godwit_trace_records_oversize_total", "Deliveries recorded without their message.",
                       &trace_figures::oversize},
    row<trace_figures>{"godwit_trace_records_written_total", "Records in the files.", &trace_figures::written},
    row<trace_figures>{"godwit_trace_records_unwritten_total", "Records that the disk refused.",
                       &trace_figures::unwritten},
};

using vehicle_link::connection;
constexpr std::array link_rows{
    row<connection>{"godwit_vehicle_frames_received_total", "Good frames from the link to the vehicle.",
                    &connection::frames_in},
    row<connection>{"godwit_vehicle_frames_sent_total", "Frames sent to the vehicle.", &connection::frames_out},
    row<connection>{"godwit_vehicle_frames_missing_total", "Frames of the autopilot that did not arrive.",
                    &connection::sequence_gaps},
    row<connection>{"godwit_vehicle_frames_unsent_total", "Frames that the link had no room for.",
                    &connection::dropped_out},
    row<connection>{"godwit_vehicle_unread_bytes_total", "Bytes that came faster than they were read.",
                    &connection::dropped_in},
    row<connection>{"godwit_vehicle_frames_signed_total", "Good frames that were signed with our key.",
                    &connection::signed_in},
    row<connection>{"godwit_vehicle_signing_rejected_total", "Frames refused for their signature.",
                    &connection::signing_rejected},
    row<connection>{"godwit_vehicle_frames_not_accepted_total", "Good frames that nobody here takes.",
                    &connection::not_accepted},
    row<connection>{"godwit_vehicle_frames_under_its_name_total", "Frames of the vehicle's name from another peer.",
                    &connection::under_its_name},
    row<connection>{"godwit_vehicle_other_autopilots_total", "Heartbeats of autopilots that are not the vehicle.",
                    &connection::other_autopilots},
    row<connection>{"godwit_vehicle_other_programs_total",
                    "Heartbeats under the vehicle's name that are no autopilot's.", &connection::other_programs},
    row<connection>{"godwit_vehicle_reconnects_total", "Times that the link was opened anew.", &connection::reconnects},
    row<connection>{"godwit_vehicle_restarts_total", "Restarts of the autopilot.", &connection::vehicle_restarts},
};

void append_health(text_writer& out, const health_status& seen) {
  out.one("godwit_health", metric_kind::gauge, "The worst of all parts: 0 green, 1 yellow, 2 red.",
          static_cast<int>(seen.worst));
  out.begin("godwit_part_health", metric_kind::gauge, "How a part of the program is: 0 green, 1 yellow, 2 red.");
  for (const auto& each : seen.parts)
    out.add(static_cast<int>(each.health), {{"part", each.part}});
}

void append_actors(text_writer& out, const report& made) {
  out.begin("godwit_actor_up", metric_kind::gauge, "Whether an actor runs.");
  for (const auto& each : made.actors)
    out.add(each.phase == runtime::child_phase::running ? 1 : 0, {{"actor", each.name}});
  out.begin("godwit_actor_wanted", metric_kind::gauge, "Whether an actor is to run in this part of the flight.");
  for (const auto& each : made.actors)
    out.add(each.wanted ? 1 : 0, {{"actor", each.name}});
  out.begin("godwit_actor_restarts_total", metric_kind::counter, "Restarts of an actor.");
  for (const auto& each : made.actors)
    out.add(each.restarts, {{"actor", each.name}});
  for (const auto& figure : mail_rows) {
    out.begin(figure.name, kind_of(figure.name), figure.help);
    for (const auto& each : made.mail)
      out.add(each.*figure.value, {{"actor", each.actor}});
  }
}

void append_journal(text_writer& out, const journal_figures& seen) {
  append_rows(out, seen, journal_rows);
  out.one("godwit_journal_failing", metric_kind::gauge, "Whether the disk refuses what is written.",
          seen.is_failing ? 1 : 0);
  out.one("godwit_journal_fill_ratio", metric_kind::gauge, "How full the queue of the journal is; 1 is its bound.",
          seen.fill);
}

void append_vehicle(text_writer& out, const connection& seen) {
  out.one("godwit_vehicle_connected", metric_kind::gauge, "Whether the autopilot's heartbeats come.",
          seen.connected ? 1 : 0);
  if (seen.last_heartbeat_age_ms >= 0)
    out.one("godwit_vehicle_heartbeat_age_seconds", metric_kind::gauge, "Since the last heartbeat of the autopilot.",
            static_cast<double>(seen.last_heartbeat_age_ms) * seconds_of_ms);
  append_rows(out, seen, link_rows);
  out.one("godwit_vehicle_sequence_received", metric_kind::gauge, "Number of the autopilot's last frame, 0 to 255.",
          static_cast<int>(seen.rx_seq));
  out.one("godwit_vehicle_sequence_sent", metric_kind::gauge, "Number of our next frame to the vehicle, 0 to 255.",
          static_cast<int>(seen.tx_seq));
  out.one("godwit_vehicle_signing", metric_kind::gauge, "Whether the line has a key.", seen.signing_enabled ? 1 : 0);
  out.begin("godwit_vehicle_signing_errors_total", metric_kind::counter,
            "Frames refused for their signature, by cause.");
  for (const auto& each : seen.signing_errors)
    out.add(each.count, {{"cause", each.name}});
  out.begin("godwit_vehicle_parse_errors_total", metric_kind::counter, "Bytes and frames that are no MAVLink.");
  for (const auto& each : seen.parse_errors)
    out.add(each.count, {{"cause", each.name}});
}

void append_ground(text_writer& out, const ground_port::port_description& seen) {
  out.one("godwit_ground_port_up", metric_kind::gauge, "Whether the line for ground stations is open.",
          seen.link_is_up ? 1 : 0);
  out.one("godwit_ground_stations", metric_kind::gauge, "Ground stations that are heard.", seen.stations.size());
  out.begin("godwit_ground_port_events_total", metric_kind::counter, "What the port for ground stations counts.");
  for (const auto& each : seen.counts)
    out.add(each.count, {{"event", each.name}});
}

void append_service(text_writer& out, const mission_client::service_status& seen) {
  out.begin("godwit_service_connection", metric_kind::gauge, "1 at how the missions service is.");
  out.add(1, {{"state", io::name_of(seen.connection)}});
  out.begin("godwit_map_pull", metric_kind::gauge, "1 at how the last pull of the map is.");
  out.add(1, {{"state", io::name_of(seen.pull)}});
  if (seen.last_fetch_ns != 0)
    out.one("godwit_service_last_fetch_time_seconds", metric_kind::gauge,
            "When the mission was fetched last, since 1970 (UTC).", static_cast<double>(seen.last_fetch_ns) * 1e-9);
  if (!seen.schema_version.empty()) {
    out.begin("godwit_service_schema_info", metric_kind::gauge, "1 at the version of the last mission's schema.");
    out.add(1, {{"version", seen.schema_version}});
  }
  out.one("godwit_service_fetch_errors_total", metric_kind::counter, "Calls to the missions service that failed.",
          seen.fetch_errors);
  out.one("godwit_service_lost_reports_total", metric_kind::counter, "Reports of progress that were never delivered.",
          seen.lost_reports);
  out.begin("godwit_outbox_rows", metric_kind::gauge, "Rows that are still to be delivered to the missions service.");
  out.add(seen.pending, {{"state", "pending"}});
  out.add(seen.orphaned, {{"state", "orphaned"}});
  out.add(seen.expired, {{"state", "expired"}});
}

void append_map(text_writer& out, const mapobjects_store::map_status& seen) {
  out.begin("godwit_map_objects", metric_kind::gauge, "Objects of the map: pulled, and found or moved here.");
  out.add(seen.objects, {{"from", "service"}});
  out.add(seen.seen_here, {{"from", "here"}});
  out.begin("godwit_map_rows_owed", metric_kind::gauge, "Rows of the map that are to be delivered.");
  out.add(seen.pending, {{"state", "pending"}});
  out.add(seen.taken, {{"state", "taken"}});
  out.add(seen.orphaned, {{"state", "orphaned"}});
}

void append_fleet(text_writer& out, const fleet_link::fleet_view& seen) {
  out.one("godwit_broker_connected", metric_kind::gauge, "1 while there is a broker of MQTT.",
          seen.is_connected ? 1 : 0);
  out.one("godwit_broker_connects_total", metric_kind::counter, "Connections to the broker.", seen.connects);
  out.one("godwit_broker_failures_total", metric_kind::counter, "Connections that were lost or not made.",
          seen.failures);
  out.one("godwit_broker_events_waiting", metric_kind::gauge, "Events that the broker does not have.", seen.waiting);
  out.one("godwit_broker_events_delivered_total", metric_kind::counter, "Events that the broker has.", seen.delivered);
  out.one("godwit_broker_events_dropped_total", metric_kind::counter, "Events for which there was no room any more.",
          seen.dropped);
  out.one("godwit_broker_texts_total", metric_kind::counter, "What was live and went to the broker.", seen.texts);
  out.one("godwit_broker_texts_skipped_total", metric_kind::counter,
          "What was live, and overtaken by what is newer: the network was too slow.", seen.skipped);
}

void append_flight(text_writer& out, const executor::flight_status& seen) {
  out.begin("godwit_flight_phase", metric_kind::gauge, "1 at the phase of the flight.");
  out.add(1, {{"phase", seen.phase}});
  out.begin("godwit_flight_authority", metric_kind::gauge, "1 at who has the vehicle.");
  out.add(1, {{"holder", seen.authority}});
  out.one("godwit_flight_under_way", metric_kind::gauge, "Whether the vehicle is in a flight of ours.",
          seen.in_flight ? 1 : 0);
  out.one("godwit_vehicle_armed", metric_kind::gauge, "Whether the vehicle is armed.", seen.is_armed ? 1 : 0);
  out.one("godwit_mission_items", metric_kind::gauge, "Items of the mission.", seen.items);
  out.one("godwit_mission_items_done", metric_kind::gauge, "Of these: done.", seen.items_done);
  out.one("godwit_mission_reports", metric_kind::gauge, "Reports of progress that were made for this mission.",
          seen.reports);
}

void append_failsafe(text_writer& out, const failsafe::failsafe_status& seen) {
  out.one("godwit_failsafe_acting", metric_kind::gauge, "Whether a failsafe of ours has the vehicle.",
          seen.reacts ? 1 : 0);
  out.one("godwit_failsafe_overrides", metric_kind::gauge, "Rules that a person has switched off for a while.",
          seen.overridden.size());
}

void append_process(text_writer& out, const process_figures& seen) {
  out.begin("godwit_build_info", metric_kind::gauge, "1 at the version that runs.");
  out.add(1, {{"version", seen.version}});
  out.one("godwit_process_start_time_seconds", metric_kind::gauge, "When the process began, since 1970 (UTC).",
          static_cast<double>(seen.began_ms) * seconds_of_ms);
  out.one("godwit_process_cpu_seconds_total", metric_kind::counter, "Time on all cores, user and system.", seen.cpu_s);
  out.one("godwit_process_threads", metric_kind::gauge, "Threads.", seen.threads);
  out.one("godwit_process_resident_memory_bytes", metric_kind::gauge, "Memory in use.", seen.resident_bytes);
  out.one("godwit_process_virtual_memory_bytes", metric_kind::gauge, "Address space in use.", seen.virtual_bytes);
  out.one("godwit_process_open_fds", metric_kind::gauge, "Open descriptors.", seen.open_files);
  out.one("godwit_process_max_fds", metric_kind::gauge, "Descriptors that it may open.", seen.max_files);
  if (seen.free_disk_bytes)
    out.one("godwit_disk_free_bytes", metric_kind::gauge, "Free on the disk of the journal.", *seen.free_disk_bytes);
}

} // namespace

std::string json_of(const report& made) { return io::to_json(made); }

std::string json_of(const health_status& status) { return io::to_json(status); }

void append_metrics(text_writer& out, const report& made) {
  append_health(out, made.health);
  append_actors(out, made);
  append_journal(out, made.journal);
  append_rows(out, made.trace, trace_rows);
  if (made.vehicle)
    append_vehicle(out, *made.vehicle);
  if (made.ground)
    append_ground(out, *made.ground);
  if (made.service)
    append_service(out, *made.service);
  if (made.map)
    append_map(out, *made.map);
  if (made.fleet)
    append_fleet(out, *made.fleet);
  if (made.flight)
    append_flight(out, *made.flight);
  if (made.failsafe)
    append_failsafe(out, *made.failsafe);
  append_process(out, made.process);
}

} // namespace godwit::health
