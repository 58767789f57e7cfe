// Everything that can be said about a running godwitd at one moment: what `/status` shows and `/metrics` counts.
//
// A part that there is none of (no service, no ground stations), and one that did not answer, is absent; who did not
// answer is named in `unanswered`. Times since 1970 (UTC) unless said otherwise. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/executor/flight.hpp"
#include "messages/executor/known_missions.hpp"
#include "messages/executor/traffic.hpp"
#include "messages/failsafe/types.hpp"
#include "messages/fleet_link/types.hpp"
#include "messages/ground_port/types.hpp"
#include "messages/health/types.hpp"
#include "messages/mapobjects_store/status.hpp"
#include "messages/mission_client/types.hpp"
#include "messages/vehicle_link/connection.hpp"
#include "runtime/supervision/messages.hpp"

namespace godwit::health {

// Of the stable address of an actor; totals since the process began, but for `waiting`.
struct mail_figures {
  std::string actor;
  std::uint64_t waiting = 0;
  std::uint64_t accepted = 0;
  std::uint64_t handled = 0;
  std::uint64_t crashes = 0;
  std::uint64_t requeued = 0;
  std::uint64_t dead_lettered = 0;
  std::uint64_t repeated = 0;
  std::uint64_t lost = 0;
  std::uint64_t refused = 0;
  std::uint64_t dropped = 0;
  std::uint64_t not_accepted = 0;
  GODWIT_FIELDS(mail_figures, "health.mail_figures", actor, waiting, accepted, handled, crashes, requeued,
                dead_lettered, repeated, lost, refused, dropped, not_accepted);
};

struct journal_figures {
  bool is_failing = false; // the last commit failed; it is tried again
  std::string reason;
  std::uint64_t commits = 0;
  std::uint64_t writes = 0;
  std::uint64_t events = 0;
  std::uint64_t retries = 0;
  std::uint64_t refused = 0;
  std::uint64_t queued = 0; // writes that wait now
  double fill = 0;          // of the bound on what waits: 1 = refuses
  std::uint64_t run = 0;    // how many times this journal was opened, this time included
  GODWIT_FIELDS(journal_figures, "health.journal_figures", is_failing, reason, commits, writes, events, retries,
                refused, queued, fill, run);
};

// Records of deliveries.
struct trace_figures {
  std::uint64_t recorded = 0;
  std::uint64_t dropped = 0;
  std::uint64_t oversize = 0;
  std::uint64_t written = 0;
  std::uint64_t unwritten = 0;
  GODWIT_FIELDS(trace_figures, "health.trace_figures", recorded, dropped, oversize, written, unwritten);
};

// Of the operating system; what it does not tell is absent.
struct process_figures {
  std::string version;
  std::int64_t began_ms = 0;
  double cpu_s = 0;
  std::uint64_t threads = 0;
  std::uint64_t resident_bytes = 0;
  std::uint64_t virtual_bytes = 0;
  std::uint64_t open_files = 0;
  std::uint64_t max_files = 0;
  std::optional<std::uint64_t> free_disk_bytes; // of the journal's disk
  GODWIT_FIELDS(process_figures, "health.process_figures", version, began_ms, cpu_s, threads, resident_bytes,
                virtual_bytes, open_files, max_files, free_disk_bytes);
};

// What is not an actor's.
struct host_figures {
  std::vector<mail_figures> mail;
  journal_figures journal;
  trace_figures trace;
  process_figures process;
};

struct unanswered_part {
  std::string part;
  std::string why;
  GODWIT_FIELDS(unanswered_part, "health.unanswered_part", part, why);
};

struct report {
  std::int64_t at_ms = 0;
  health_status health;
  std::optional<executor::flight_status> flight;
  std::optional<executor::known_missions> missions;
  std::optional<executor::heard_traffic> traffic;
  std::optional<failsafe::failsafe_status> failsafe;
  std::optional<vehicle_link::connection> vehicle;
  std::optional<ground_port::port_description> ground;
  std::optional<mission_client::service_status> service;
  std::optional<mapobjects_store::map_status> map;
  std::optional<fleet_link::fleet_view> fleet;
  std::vector<runtime::child_report> actors; // in start order
  std::vector<mail_figures> mail;
  journal_figures journal;
  trace_figures trace;
  process_figures process;
  std::vector<unanswered_part> unanswered;
  GODWIT_FIELDS(report, "health.report", at_ms, health, flight, missions, traffic, failsafe, vehicle, ground, service,
                map, fleet, actors, mail, journal, trace, process, unanswered);
};

} // namespace godwit::health
