// What the guardian and the actor that supervises (the executor) say to each other.
//
// The guardian executes a table; the supervisor owns its content. It sends the whole of it (`supervise`) with an
// epoch whenever it becomes another one, and again until the answer has that epoch; the guardian applies what differs
// and ignores an older epoch. The supervisor hears of every change (`child_event`). It may crash: the guardian goes on
// with the last table, and the new incarnation asks for `get_children` and finds them all as they are. Thread: plain
// values.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "runtime/condition.hpp"
#include "runtime/supervision/policy.hpp"

namespace godwit::runtime {

GODWIT_ENUM_NAMES(health_colour, green, yellow, red);

struct child_report {
  std::string name;
  child_phase phase = child_phase::absent;
  std::uint64_t incarnation = 0;
  std::uint64_t restarts = 0;
  std::string last_crash; // reason, empty = never
  bool wanted = true;
  bool essential = false;
  health_colour health = health_colour::green;
  std::string health_reason; // a sentence for people; empty when all is well
  GODWIT_FIELDS(child_report, "runtime.child_report", name, phase, incarnation, restarts, last_crash, wanted, essential,
                health, health_reason);
};

// The supervisor asks, also to adopt the children after a crash of its own.
struct get_children {
  static constexpr auto fields = io::table("runtime.get_children");
};

struct children {
  std::vector<child_report> list; // in start order
  GODWIT_FIELDS(children, "runtime.children", list);
};

enum class child_event_kind { up, crashed, stopped, late, silent, gave_up };

GODWIT_ENUM_NAMES(child_event_kind, up, crashed, stopped, late, silent, gave_up);

// The guardian tells the supervisor, and the trace.
struct child_event {
  std::string name;
  child_event_kind kind = child_event_kind::up;
  std::uint64_t incarnation = 0;
  std::string reason;
  GODWIT_FIELDS(child_event, "runtime.child_event", name, kind, incarnation, reason);
};

// The guardian tells who has asked for it (system::tell_who_lives), each time that NAME has begun or answered a ping.
struct child_alive {
  std::string name;
  GODWIT_FIELDS(child_alive, "runtime.child_alive", name);
};

// What holds for a child from now on.
struct child_entry {
  std::string name;
  bool wanted = true; // else it is stopped; its tells are dropped, its asks refused, and durable effects wait
  child_policy policy;
  GODWIT_FIELDS(child_entry, "runtime.child_entry", name, wanted, policy);
};

// Of a table: which incarnation of the supervisor has made it, and its how manieth it is. The later one counts.
struct table_epoch {
  std::uint64_t incarnation = 0;
  std::uint64_t n = 0;
  GODWIT_FIELDS(table_epoch, "runtime.table_epoch", incarnation, n);
  friend auto operator<=>(const table_epoch&, const table_epoch&) = default;
};

// The supervisor asks the guardian. Children that are not in the list keep what holds for them; names that no child has
// are ignored and posted to health as the supervisor's mistake. When `revivals` has risen, each child that was given up
// starts again with its crashes forgotten; the first table of a process revives nobody.
struct supervise {
  table_epoch epoch;
  std::uint64_t revivals = 0;
  std::vector<child_entry> list;
  GODWIT_FIELDS(supervise, "runtime.supervise", epoch, revivals, list);
};

// The answer: of the table that holds now.
struct supervised {
  table_epoch epoch;
  GODWIT_FIELDS(supervised, "runtime.supervised", epoch);
};

} // namespace godwit::runtime
