#include "actors/executor/people_views.hpp"

#include <algorithm>
#include <array>

#include "actors/executor/plan/setting.hpp"
#include "io/mavlink/enums/command.hpp"
#include "io/mavlink/frame_meaning.hpp"
#include "io/time_units.hpp"

namespace godwit::executor {
namespace {

using io::mavlink::mav_cmd;

using io::mavlink::units_a_degree;

// The items to whose places the vehicle goes.
constexpr std::array ways{mav_cmd::nav_waypoint,    mav_cmd::nav_loiter_unlim,    mav_cmd::nav_loiter_turns,
                          mav_cmd::nav_loiter_time, mav_cmd::nav_loiter_to_alt,   mav_cmd::nav_land,
                          mav_cmd::nav_takeoff,     mav_cmd::nav_spline_waypoint, mav_cmd::nav_vtol_takeoff,
                          mav_cmd::nav_vtol_land};

bool leads_somewhere(const io::mavlink::mission_item_int& item) {
  return (item.x != 0 || item.y != 0) && std::ranges::find(ways, static_cast<mav_cmd>(item.command)) != ways.end();
}

} // namespace

plan_view plan_view_of(const state& s, const vehicle_view& vehicle) {
  plan_view result;
  result.mission = s.mission;
  if (s.flown) {
    result.generation = s.progress.last_generation;
    for (const auto& each : s.flown->items)
      if (leads_somewhere(each))
        result.way.push_back({each.x / units_a_degree, each.y / units_a_degree, static_cast<double>(each.z)});
  }
  if (vehicle.home())
    result.home = plan::place_of(*vehicle.home());
  if (s.home)
    result.kept = s.home->at;
  return result;
}

preflight_view preflight_view_of(const preflight::state& s, const std::optional<preflight::dated_report>& last) {
  preflight_view result;
  result.phase = io::name_of(s.now);
  result.reason = s.reason;
  if (s.report) {
    result.report = s.now == preflight::phase::awaiting_ack ? s.report->id : 0;
    result.acknowledged_by = s.report->acknowledged_by;
  }
  if (!last)
    return result;
  result.looked_ms = last->at_ns / ns_per_ms;
  for (const auto& each : last->what.findings)
    result.findings.push_back({each.check, std::string(io::name_of(each.how)), each.sentence});
  return result;
}

} // namespace godwit::executor
