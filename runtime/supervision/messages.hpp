// What the guardian and the actor that decides (the executor) say to each other.
//
// The guardian carries out a policy table; the decider owns its content: it changes entries as the flight goes on
// (`set_policy`), stops and starts children, and hears of every change. It may crash: the guardian goes on with the
// last table, and the new incarnation asks for `get_children` and finds them all as they are. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "runtime/supervision/policy.hpp"
#include "runtime/supervision/supervision_core.hpp"

namespace godwit::runtime {

struct child_report {
  std::string name;
  child_phase phase = child_phase::absent;
  std::uint64_t incarnation = 0;
  std::uint64_t restarts = 0;
  std::string last_crash; // reason, empty = never
  static constexpr auto fields =
      io::table("runtime.child_report", io::field("name", &child_report::name),
                io::field("phase", &child_report::phase), io::field("incarnation", &child_report::incarnation),
                io::field("restarts", &child_report::restarts), io::field("last_crash", &child_report::last_crash));
};

// The decider asks, also to adopt the children after a crash of its own.
struct get_children {
  static constexpr auto fields = io::table("runtime.get_children");
};

struct children {
  std::vector<child_report> list; // in start order
  static constexpr auto fields = io::table("runtime.children", io::field("list", &children::list));
};

enum class child_event_kind { up, crashed, stopped, late, silent, gave_up };

constexpr auto enum_names(child_event_kind) {
  return io::names<child_event_kind>({{child_event_kind::up, "up"},
                                      {child_event_kind::crashed, "crashed"},
                                      {child_event_kind::stopped, "stopped"},
                                      {child_event_kind::late, "late"},
                                      {child_event_kind::silent, "silent"},
                                      {child_event_kind::gave_up, "gave_up"}});
}

// The guardian tells the decider, and the trace.
struct child_event {
  std::string name;
  child_event_kind kind = child_event_kind::up;
  std::uint64_t incarnation = 0;
  std::string reason;
  static constexpr auto fields =
      io::table("runtime.child_event", io::field("name", &child_event::name), io::field("kind", &child_event::kind),
                io::field("incarnation", &child_event::incarnation), io::field("reason", &child_event::reason));
};

// The decider tells the guardian. Unknown names are ignored and posted to health as the decider's mistake.
struct set_policy {
  std::string name;
  child_policy policy;
  static constexpr auto fields =
      io::table("runtime.set_policy", io::field("name", &set_policy::name), io::field("policy", &set_policy::policy));
};

struct want_child {
  std::string name;
  bool wanted = true;
  static constexpr auto fields =
      io::table("runtime.want_child", io::field("name", &want_child::name), io::field("wanted", &want_child::wanted));
};

} // namespace godwit::runtime
