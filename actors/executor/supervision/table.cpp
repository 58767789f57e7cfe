#include "actors/executor/supervision/table.hpp"

#include <algorithm>
#include <array>

namespace godwit::executor::supervision {
namespace {

enum class need { wanted, essential, away, for_scans };

struct row {
  std::string_view child;
  std::array<need, 3> in; // by part
  bool runs_reduced = false;
  bool is_for_ever = false; // restarted, once the process may not end because of it
};

using enum need;

constexpr std::array rows{
    row{"vehicle_link", {essential, essential, essential}, true, true},
    row{"failsafe", {essential, essential, essential}, true},
    row{"executor", {essential, essential, essential}, true},
    row{"mission_client", {wanted, wanted, essential}},
    row{"ground_port", {wanted, wanted, wanted}, true},
    row{"operator_bridge", {wanted, wanted, wanted}, true},
    row{"landing_watch", {wanted, wanted, wanted}, true},
    row{"scan_controller", {away, for_scans, away}},
    row{"movement_detector", {away, for_scans, away}},
};
// Who shows what there is, also far away, and who takes a mission from a page.
constexpr std::array<std::string_view, 5> dispensable{"health", "telemetry_stream", "fleet_link", "view_desk",
                                                      "mission_desk"};

constexpr row others{"", {wanted, wanted, wanted}};

const row& row_of(std::string_view child) {
  const auto* const found = std::ranges::find(rows, child, &row::child);
  return found == rows.end() ? others : *found;
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

bool is_dispensable(std::string_view child) { return std::ranges::find(dispensable, child) != dispensable.end(); }

bool is_wanted_on_ground(std::string_view child) {
  return row_of(child).in[static_cast<std::size_t>(part::ground)] != away;
}

std::vector<std::string> floor_children() {
  std::vector<std::string> result;
  for (const auto& each : rows)
    if (each.in[static_cast<std::size_t>(part::flight)] == essential)
      result.emplace_back(each.child);
  return result;
}

} // namespace godwit::executor::supervision
