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
#include "messages/failsafe/types.hpp"
#include "messages/fleet_link/types.hpp"
#include "messages/ground_port/description.hpp"
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
  static constexpr auto fields = io::table(
      "health.mail_figures", io::field("actor", &mail_figures::actor), io::field("waiting", &mail_figures::waiting),
      io::field("accepted", &mail_figures::accepted), io::field("handled", &mail_figures::handled),
      io::field("crashes", &mail_figures::crashes), io::field("requeued", &mail_figures::requeued),
      io::field("dead_lettered", &mail_figures::dead_lettered), io::field("repeated", &mail_figures::repeated),
      io::field("lost", &mail_figures::lost), io::field("refused", &mail_figures::refused),
      io::field("dropped", &mail_figures::dropped), io::field("not_accepted", &mail_figures::not_accepted));
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
  static constexpr auto fields =
      io::table("health.journal_figures", io::field("is_failing", &journal_figures::is_failing),
                io::field("reason", &journal_figures::reason), io::field("commits", &journal_figures::commits),
                io::field("writes", &journal_figures::writes), io::field("events", &journal_figures::events),
                io::field("retries", &journal_figures::retries), io::field("refused", &journal_figures::refused),
                io::field("queued", &journal_figures::queued), io::field("fill", &journal_figures::fill),
                io::field("run", &journal_figures::run));
};

// Records of deliveries.
struct trace_figures {
  std::uint64_t recorded = 0;
  std::uint64_t dropped = 0;
  std::uint64_t oversize = 0;
  std::uint64_t written = 0;
  std::uint64_t unwritten = 0;
  static constexpr auto fields =
      io::table("health.trace_figures", io::field("recorded", &trace_figures::recorded),
                io::field("dropped", &trace_figures::dropped), io::field("oversize", &trace_figures::oversize),
                io::field("written", &trace_figures::written), io::field("unwritten", &trace_figures::unwritten));
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
  static constexpr auto fields = io::table(
      "health.process_figures", io::field("version", &process_figures::version),
      io::field("began_ms", &process_figures::began_ms), io::field("cpu_s", &process_figures::cpu_s),
      io::field("threads", &process_figures::threads), io::field("resident_bytes", &process_figures::resident_bytes),
      io::field("virtual_bytes", &process_figures::virtual_bytes),
      io::field("open_files", &process_figures::open_files), io::field("max_files", &process_figures::max_files),
      io::field("free_disk_bytes", &process_figures::free_disk_bytes));
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
  static constexpr auto fields = io::table("health.unanswered_part", io::field("part", &unanswered_part::part),
                                           io::field("why", &unanswered_part::why));
};

struct report {
  std::int64_t at_ms = 0;
  health_status health;
  std::optional<executor::flight_status> flight;
  std::optional<executor::known_missions> missions;
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
  static constexpr auto fields = io::table(
      "health.report", io::field("at_ms", &report::at_ms), io::field("health", &report::health),
      io::field("flight", &report::flight), io::field("missions", &report::missions),
      io::field("failsafe", &report::failsafe), io::field("vehicle", &report::vehicle),
      io::field("ground", &report::ground), io::field("service", &report::service), io::field("map", &report::map),
      io::field("fleet", &report::fleet), io::field("actors", &report::actors), io::field("mail", &report::mail),
      io::field("journal", &report::journal), io::field("trace", &report::trace),
      io::field("process", &report::process), io::field("unanswered", &report::unanswered));
};

} // namespace godwit::health
