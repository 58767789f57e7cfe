#include "actors/executor/supervision/table.hpp"

#include <array>

namespace godwit::executor::supervision {
namespace {

enum class need { wanted, essential, away, for_scans };

struct row {
  child_name child = child_name::vehicle_link;
  std::array<need, 3> in{}; // by part
  bool runs_reduced = false;
  bool is_for_ever = false;    // restarted, once the process may not end because of it
  bool is_dispensable = false; // no flight waits for it
};

using enum need;
using enum child_name;

constexpr std::array always{wanted, wanted, wanted};
constexpr std::array needed_always{essential, essential, essential};
constexpr std::array for_surveys{away, for_scans, away};

constexpr std::array rows{
    row{vehicle_link, needed_always, true, true},
    row{failsafe, needed_always, true},
    row{executor, needed_always, true},
    row{mission_client, {wanted, wanted, essential}},
    row{mapobjects_store, always},
    row{ground_port, always, true},
    row{operator_bridge, always, true},
    row{landing_watch, always, true},
    row{sightings, always},
    row{scan_controller, for_surveys},
    row{movement_detector, for_surveys},
    // who shows what there is, also far away, and who takes a mission from a page
    row{health, always, false, false, true},
    row{telemetry_stream, always, false, false, true},
    row{fleet_link, always, false, false, true},
    row{view_handler, always, false, false, true},
    row{mission_handler, always, false, false, true},
    row{operator_handler, always},
    row{control_handler, always},
    row{ground_run, {essential, wanted, wanted}},
};

constexpr bool is_whole_and_in_order() {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (static_cast<std::size_t>(rows[i].child) != i)
      return false;
  return rows.size() == io::enum_table<child_name>.size();
}
static_assert(is_whole_and_in_order(), "each child has its row");

// Of a process that is none of godwitd's.
constexpr row others{.in = always};

const row& row_of(std::string_view child) {
  const auto found = io::value_of<child_name>(child);
  return found ? rows[static_cast<std::size_t>(*found)] : others;
}

runtime::child_entry entry_of(const std::string& child, part now, const circumstances& process, bool scans) {
  const auto& its = row_of(child);
  runtime::child_entry result;
  result.name = child;
  const auto needed = its.in[static_cast<std::size_t>(now)];
  const bool is_left_out = now == part::flight && process.is_reduced && !its.runs_reduced;
  result.wanted = !is_left_out && needed != away && (needed != for_scans || scans);
  result.policy.essential = needed == essential;
  if (now != part::flight)
    return result;
  result.policy.end = runtime::process_end::fast_once;
  if (its.is_for_ever && !process.may_end_fast)
    result.policy.restart.intensity = runtime::restart_policy::for_ever;
  return result;
}

} // namespace

std::vector<runtime::child_entry> table_of(part now, const circumstances& process,
                                           const std::vector<std::string>& children, bool scans) {
  std::vector<runtime::child_entry> result;
  result.reserve(children.size());
  for (const auto& each : children)
    result.push_back(entry_of(each, now, process, scans));
  return result;
}

runtime::child_policy policy_of(child_name child) {
  const bool is_essential =
      rows[static_cast<std::size_t>(child)].in[static_cast<std::size_t>(part::ground)] == essential;
  return {.essential = is_essential, .restart = {}};
}

bool is_dispensable(std::string_view child) { return row_of(child).is_dispensable; }

bool is_wanted_on_ground(std::string_view child) {
  return row_of(child).in[static_cast<std::size_t>(part::ground)] != away;
}

std::vector<std::string> floor_children() {
  std::vector<std::string> result;
  for (const auto& each : rows)
    if (each.in[static_cast<std::size_t>(part::flight)] == essential)
      result.push_back(name(each.child));
  return result;
}

} // namespace godwit::executor::supervision
