#include "actors/executor/flight/flight_context.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "actors/domain/control_authority/mode_tables.hpp"
#include "actors/domain/geo/geodesic.hpp"
#include "actors/domain/home/home.hpp"
#include "actors/executor/plan/fence_check.hpp"
#include "actors/executor/plan/fence_items.hpp"
#include "actors/executor/plan/places.hpp"
#include "actors/executor/plan/vehicle_items.hpp"
#include "actors/executor/preflight/report.hpp"
#include "actors/executor/remaining.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::executor {
namespace {

using flight::mode_kind;
using io::mavlink::mav_autopilot;

constexpr double landed_there_m = 15;
constexpr double fixed_wing_landed_there_m = 150;

} // namespace

void flight_context::adopt_flight() {
  authority.begin(*view.mode());
  was_up = true;
}

std::string flight_context::why_not_armed() const {
  if (view.is_armed() || configured.arm_on_start)
    return {};
  return "the vehicle is disarmed, and starting does not arm it (arm_on_start): arm it, then start";
}

std::optional<vehicle_link::seen_state> flight_context::known() const {
  if (!view.mode())
    return std::nullopt;
  return vehicle_link::seen_state{view.mode()->custom_mode, view.is_armed(),
                                  failsafe_status ? failsafe_status->last_command : 0, evidence.foreign_ns, 0};
}

std::string flight_context::sentence() const {
  const auto& at = s.status;
  std::string result(io::name_of(at.now));
  if (!at.reason.empty())
    result += ": " + at.reason;
  else if (at.now == phase::preflight)
    result += ": " + preflight::sentence_of(s.preflight);
  else if (waits_for_next())
    result += ": the missions service is asked for the next mission";
  if (at.now == phase::ready && view.is_armed())
    result += at.reason.empty() ? ": the vehicle stands armed" : "; the vehicle stands armed";
  if (at.now == phase::starting && !refused_start.empty())
    result += ": " + refused_start_sentence();
  const bool fails = s.preflight.now == preflight::phase::failed || s.preflight.now == preflight::phase::awaiting_ack;
  if (at.now == phase::ready && fails) // by what was seen when the plan was there
    result += (at.reason.empty() ? ": it is not started. " : "; ") + preflight::sentence_of(s.preflight);
  if (keeps_vehicle() && !view.is_connected() && !view.why_not_connected().empty())
    result += "; the vehicle is not heard: " + view.why_not_connected();
  return result;
}

std::string flight_context::refused_start_sentence() const {
  return refused_start + "; godwit tries it again while the vehicle stands, for a minute";
}

bool flight_context::is_plan_finished() const { return s.progress.plan && s.progress.plan->generation.is_finished; }

bool flight_context::is_on_way_home() const { return s.progress.plan && progress::is_way_home(s.progress.plan->map); }

bool flight_context::is_mission_finished() const {
  const auto& open = s.progress.mission; // after its end the vehicle may have been called home by another plan
  return (is_plan_finished() && s.progress.plan->map.ends_mission) ||
         (is_on_way_home() && open && open->completed_revision == open->revision);
}

bool flight_context::is_mission_flown() const {
  return s.status.now == phase::flying || (s.status.now == phase::pausing && !is_landing());
}

bool flight_context::is_plan_over() const { return is_plan_finished() || is_on_way_home() || was_called_home(); }

bool flight_context::is_landing() const {
  return s.status.now == phase::landing || (s.status.now == phase::pausing && is_plan_over());
}

bool flight_context::may_change_plan() const {
  const auto& at = s.status;
  return at.in_flight && !is_failsafe_gone &&
         (is_mission_flown() || is_held() || (at.now == phase::paused && at.cause == pause_cause::plan_ended) ||
          (is_landing() && hovers()));
}

bool flight_context::hovers() const {
  return is_plan_finished() && !ends_on_ground() && view.is_under_way() && !was_called_home();
}

bool flight_context::is_in_air() const {
  return view.owner().vehicle != flight::vehicle_class::rover && view.is_under_way();
}

bool flight_context::is_ardupilot() const { return view.owner().autopilot == mav_autopilot::ardupilotmega; }

bool flight_context::is_copter() const {
  return is_ardupilot() && view.owner().vehicle == flight::vehicle_class::multirotor;
}

bool flight_context::is_left_armed() const {
  return runner.has_armed() && view.is_armed() && view.knows_ground() && !is_in_air();
}

bool flight_context::may_disarm() const { return is_left_armed() && runner.is_armed_by_it(view); }

std::vector<std::uint32_t> flight_context::modes_after_disarm() const {
  if (view.owner().autopilot != io::mavlink::mav_autopilot::px4)
    return {};
  auto result = flight::modes_obeying(view.owner(), mode_kind::mission);
  for (const auto each : flight::modes_obeying(view.owner(), mode_kind::hold))
    result.push_back(each);
  return result;
}

bool flight_context::ends_on_ground() const {
  const auto* const last = last_flown_item(s);
  return last != nullptr && view.owner().vehicle != flight::vehicle_class::rover && flight::leads_down(last->command);
}

bool flight_context::is_at_end_of_plan() const {
  return view.current() && view.current()->seq >= end_of_plan(view.owner(), s).from_sequence;
}

bool flight_context::is_in_return_of_plan() const {
  const auto* const last = last_flown_item(s);
  return last != nullptr && plan::is_return_item(*last) && is_at_end_of_plan();
}

bool flight_context::was_called_off() const {
  return s.progress.mission && progress::was_called_off(*s.progress.mission);
}

bool flight_context::waits_for_next() const {
  if (!configured.asks_next() || is_flight_begun(s) || s.doing || s.arrived)
    return false;
  if (!s.mission)
    return true;
  if (s.status.now == phase::post_flight) // it is delivered first
    return false;
  return is_at_rest(s.status.now) || is_withdrawn() ||
         progress::has_ended(s.progress, s.mission->mission_id, s.mission->revision);
}

bool flight_context::flies_deleted_mission() const {
  return configured.deleted_mission == deletion_policy::go_on && s.mission &&
         progress::is_begun(s.progress, s.mission->mission_id);
}

bool flight_context::is_coming_down() const { return is_landing() || (ends_on_ground() && is_at_end_of_plan()); }

bool flight_context::is_at_rally_point(double metres, instant now) const {
  if (!s.last_line.has_rally)
    return false;
  auto brought = s.station_rally;
  if (s.mission)
    std::ranges::copy(plan::rally_items(*s.mission), std::back_inserter(brought));
  using io::mavlink::units_a_degree;
  return std::ranges::any_of(brought, [&](const auto& each) {
    return view.is_within(metres, {each.x / units_a_degree, each.y / units_a_degree}, now.now_ns);
  });
}

bool flight_context::came_down_as_planned(instant now) const {
  if (!ends_on_ground() || view.is_under_way())
    return false;
  const auto& last = *last_flown_item(s);
  const bool is_wing = view.owner().vehicle == flight::vehicle_class::fixed_wing;
  const auto metres = is_wing ? fixed_wing_landed_there_m : landed_there_m;
  if (plan::is_return_item(last) && is_at_rally_point(metres, now))
    return true;
  if (plan::is_return_item(last))
    return view.home() && !returns_elsewhere() && view.is_within(metres, plan::point_of(*view.home()), now.now_ns);
  using io::mavlink::units_a_degree;
  return (last.x == 0 && last.y == 0) ||
         view.is_within(metres, {last.x / units_a_degree, last.y / units_a_degree}, now.now_ns);
}

bool flight_context::is_complete_credible(instant now) const {
  if (has_open_intent() && !view.is_armed()) // of what stands, the plan that is brought or started counts
    return false;
  if (!s.flown || view.owner().vehicle == flight::vehicle_class::rover)
    return true;
  if (ends_on_ground())
    return came_down_as_planned(now);
  const bool flies_plan = view.is_in(mode_kind::mission) || view.is_in_one_of(end_of_plan(view.owner(), s).modes);
  return flies_plan && view.is_under_way();
}

bool flight_context::returns_elsewhere() const {
  if (!keeps_home() || !is_in_flight())
    return false;
  const bool is_known = is_home_told && view.home();
  if (s.home->is_of_this_flight)
    return is_known && flight::is_moved(plan::place_of(*view.home()), s.home->at);
  return !(is_known && flight::is_same_home(plan::place_of(*view.home()), s.home->at));
}

std::string flight_context::home_sentence() const {
  if (!keeps_home() || !is_home_told || !view.home())
    return "the vehicle does not report where its home is";
  const auto away_m = geo::distance_m(plan::point_of(*view.home()), plan::point_of(s.home->at));
  return "a return of the vehicle leads to a place " + std::to_string(std::lround(away_m)) +
         " m from the home of the mission";
}

bool flight_context::has_service() const {
  return configured.has_service && !(s.mission && is_of_people(s, s.mission->mission_id));
}

std::string flight_context::who_else_brings_missions() const {
  const auto& next = is_flight_begun(s) || !s.arrived ? s.mission : s.arrived;
  const bool is_free = waits_for_next() || (next && is_of_people(s, next->mission_id));
  if (configured.has_service && !(configured.asks_next() && is_free))
    return "the missions service";
  if (configured.has_service && configured.start == start_policy::automatic)
    return "the missions service, which flies them by itself (flight.start is automatic),";
  return configured.mission_id.empty() ? std::string() : std::string("a file");
}

std::string flight_context::missions_come_from_elsewhere() const {
  const auto elsewhere = who_else_brings_missions();
  return elsewhere.empty() ? elsewhere : "missions come from " + elsewhere + " here";
}

bool flight_context::is_same_mission(const mission::document& next) const {
  return s.mission && s.mission->mission_id == next.mission_id;
}

bool flight_context::has_nothing_left(const mission::document& next) const {
  return is_same_mission(next) && first_item(next) >= next.items.size();
}

std::size_t flight_context::first_item(const mission::document& mission) const {
  return s.flown ? first_to_fly(mission, s.flown->mission, last_done(s)) : 0;
}

plan::plan_from flight_context::going_on(const mission::document& mission, std::size_t first_item) const {
  const bool is_begun = is_same_mission(mission) && s.progress.mission;
  if (!is_begun)
    return {first_item, lines_flown(s, mission, first_item)};
  return {first_item, lines_flown(s, mission, first_item), s.progress.mission->jumps,
          line_begun(s, mission, first_item)};
}

bool flight_context::may_plan(instant now) const {
  return view.place(now.now_ns) && view.home() && view.owner().vehicle != flight::vehicle_class::unknown;
}

std::optional<plan::plan_setting> flight_context::setting(instant now) const {
  if (!may_plan(now))
    return std::nullopt;
  plan::plan_setting result;
  result.vehicle = view.owner().vehicle;
  result.autopilot = view.owner().autopilot;
  result.home = *view.home();
  result.start = *view.place(now.now_ns);
  result.is_under_way = view.is_under_way();
  place_home(result);
  result.own_loiter_radius_m = configured.own_loiter_radius_m;
  result.return_altitude_m = configured.return_altitude_m;
  result.marks_landings = configured.marks_landings;
  result.profile = view.profile();
  result.allowed_commands = configured.allowed_commands;
  result.stops_camera = camera_to_stop(s);
  return result;
}

// The mission counts altitudes from its own home, and the vehicle from where its home is now.
void flight_context::place_home(plan::plan_setting& where) const {
  const bool is_as_kept =
      keeps_home() &&
      (where.is_under_way ? flight::is_same_home(plan::place_of(where.home), s.home->at) : s.home->is_of_this_flight);
  if (!keeps_home() || is_as_kept)
    return;
  const auto& kept = s.home->at;
  const double rise_m = where.home.above_sea_m - kept.above_sea_m;
  where.start.altitude_m += rise_m;
  if (where.is_under_way) {
    where.home.above_mission_zero_m = rise_m;
    return;
  }
  where.home = {kept.latitude, kept.longitude, kept.above_sea_m, 0};
  where.is_home_set_again = true;
}

tl::expected<plan::flight_plan, std::string> flight_context::plan_in_flight(const mission::document& mission,
                                                                            instant now) const {
  return plan_in_flight(mission, first_item(mission), now);
}

tl::expected<plan::flight_plan, std::string> flight_context::plan_in_flight(const mission::document& mission,
                                                                            std::size_t first_item, instant now) const {
  const auto where = setting(now);
  if (!where)
    return tl::make_unexpected(std::string("the vehicle reports no position"));
  if (auto why = why_out_of_limits(mission, first_item, now); !why.empty())
    return tl::make_unexpected(std::move(why));
  auto plans = plan::build_plans(mission, *where, going_on(mission, first_item));
  if (!plans)
    return tl::make_unexpected(plans.error().message());
  if (const auto found = plan::fence_violations(plans->front(), mission, where->vehicle); !found.empty())
    return tl::make_unexpected(found.front().message);
  return std::move(plans->front());
}

// Until the vehicle reports where it stands, where its home was at last.
std::optional<mission::limits_origin> flight_context::limits_origin(instant now) const {
  if (const auto where = setting(now)) {
    const auto home = plan::home_of(*where);
    return mission::limits_origin{plan::point_of(home), home.altitude_m, where->vehicle,
                                  where->home.above_sea_m - where->home.above_mission_zero_m + home.altitude_m};
  }
  if (!view.home())
    return std::nullopt;
  return mission::limits_origin{plan::point_of(*view.home()), 0, view.owner().vehicle, view.home()->above_sea_m};
}

std::optional<std::vector<std::string>> flight_context::out_of_limits(const mission::document& mission,
                                                                      std::size_t first, instant now) const {
  const auto origin = limits_origin(now);
  if (!origin)
    return std::nullopt;
  return mission::places_out_of_limits(mission, first, *origin, configured.limits);
}

std::string flight_context::why_out_of_limits(const mission::document& mission, std::size_t first, instant now) const {
  auto found = out_of_limits(mission, first, now);
  return found && !found->empty() ? std::move(found->front()) : std::string();
}

std::optional<std::string> flight_context::out_of_limits(const std::string& what, const mission::position& at,
                                                         instant now) const {
  const auto origin = limits_origin(now);
  return origin ? std::optional(mission::why_out_of_limits(what, at, *origin, configured.limits)) : std::nullopt;
}

way_request flight_context::way_between(const mission::position& from, const mission::position& to) const {
  const auto [low, high] = std::minmax(from.altitude_m, to.altitude_m);
  return {from, to, low, high, view.owner().vehicle, configured.fence_margin_m, configured.own_loiter_radius_m};
}

} // namespace godwit::executor
