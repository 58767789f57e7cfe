#include "actors/executor/flight/homecoming.hpp"

#include <algorithm>

#include "actors/executor/plan/places.hpp"
#include "actors/executor/plan/way_home.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::executor {
namespace {

using flight::mode_kind;

constexpr double climb_margin_m = 1;

bool names_battery(failsafe::rule each) {
  return each == failsafe::rule::battery_low || each == failsafe::rule::battery_critical;
}

} // namespace

// -- the command ---------------------------------------------------------------------------------------

void homecoming::begin(effects& out, instant now) {
  const auto way = turns(now);
  const bool waits =
      flight_.returns_elsewhere() && !flight_.may_plan(now); // a new incarnation hears it within a second
  if (!way && !waits)
    return begin_straight(out, way.error());
  if (way && way->empty())
    return begin_return(out);
  flight_.homing = {homing_stage::holding, now.now_ns, waits, {}};
  phases_.go(out, trigger::called_home_by_plan);
  tasks_.begin(out, task_kind::come_home_by_plan, {change_mode{mode_kind::hold}});
}

// The autopilot's own, which is straight.
void homecoming::begin_return(effects& out) {
  flight_.homing = {};
  if (flight_.returns_elsewhere())
    return hold_instead(out, flight_.home_sentence());
  tasks_.begin(out, task_kind::come_home, {change_mode{mode_kind::returning}});
}

void homecoming::hold_instead(effects& out, const std::string& why) {
  if (is_for_failsafe_ && flight_.view.home()) {
    out.emplace_back(announce{"the vehicle returns by itself: " + why, true});
    tasks_.begin(out, task_kind::come_home, {change_mode{mode_kind::returning}});
    return;
  }
  const auto sentence = "called home, and it holds: " + why;
  out.emplace_back(announce{sentence, true});
  flight_.wanted.why_halt = sentence;
  tasks_.begin(out, task_kind::hold, {change_mode{mode_kind::hold}});
}

void homecoming::begin_straight(effects& out, const std::string& why) {
  if (flight_.returns_elsewhere()) {
    flight_.homing = {};
    return hold_instead(out, flight_.home_sentence() + "; no way is flown to the mission's: " + why);
  }
  out.emplace_back(announce{"the vehicle returns straight home, whatever fence lies there: " + why, true});
  begin_return(out);
}

std::string homecoming::why_not_for_failsafe(instant now) const {
  const auto& view = flight_.view;
  if (!flight_.is_in_flight() || flight_.has_person() || !flight_.authority.is_ours())
    return "the flight is not godwit's: " + flight_.sentence();
  if (!view.is_under_way() || !flight_.s.mission)
    return "the vehicle flies no mission of godwit's";
  if (view.owner().vehicle == flight::vehicle_class::fixed_wing)
    return "a fixed wing is given no landing that is not planned";
  if (!flight_.may_plan(now))
    return "the vehicle does not report where it is";
  return {};
}

// A new incarnation answers after its first look.
void homecoming::answer_failsafe(effects& out, bool has_looked, instant now) {
  const auto& status = flight_.failsafe_status;
  if (!status || !status->return_asked || status->return_asked->number == answered_ || !has_looked)
    return;
  answered_ = status->return_asked->number;
  auto why = why_not_for_failsafe(now);
  const bool is_taken = why.empty();
  out.emplace_back(send_to_failsafe{failsafe::return_taken{answered_, is_taken, std::move(why)}});
  if (!is_taken)
    return;
  is_for_failsafe_ = true;
  flight_.wanted.put_halt(task_kind::come_home);
  out.emplace_back(announce{"the failsafe calls the vehicle home by a plan (" +
                                std::string(io::name_of(status->return_asked->why)) + "): " + flight_.home_sentence(),
                            true});
}

homecoming::turns_or_why homecoming::turns(instant now) const {
  const auto& view = flight_.view;
  const auto& mission = flight_.s.mission;
  const bool needs_plan = flight_.returns_elsewhere() && view.owner().vehicle != flight::vehicle_class::fixed_wing;
  const bool is_flown =
      flight_.is_in_flight() && view.is_under_way() && (needs_plan || !view.obeys(mode_kind::returning));
  if (!is_flown || !mission || (mission->geofences.empty() && !needs_plan))
    return std::vector<mission::waypoint>();
  const auto where = flight_.setting(now);
  if (!where)
    return tl::make_unexpected(std::string("the vehicle does not report where it is, or where its home is"));
  const auto& here = where->start;
  const double altitude_m = std::max(here.altitude_m, flight_.configured.return_altitude_m);
  auto home = this->home().value();
  home.altitude_m = altitude_m;
  const bool is_straight = needs_plan && is_battery_low(); // a longer way is nothing for it
  const auto places = is_straight ? turns_or_reason(std::vector<geo::point>())
                                  : turns_home(flight_.way_between(here, home), mission->geofences);
  if (!places)
    return tl::make_unexpected(places.error());
  if (!places->empty() && is_battery_low())
    return tl::make_unexpected(std::string("the battery is low"));
  std::vector<mission::waypoint> result;
  for (const auto& each : *places)
    result.push_back(turn_at(each, altitude_m, {}, view.owner().vehicle));
  if (needs_plan)
    result.push_back(turn_at(plan::point_of(home), altitude_m, {}, view.owner().vehicle));
  return result;
}

std::optional<mission::position> homecoming::home() const {
  if (flight_.keeps_home())
    return mission::position{flight_.s.home->at.latitude, flight_.s.home->at.longitude, 0};
  const auto& told = flight_.view.home();
  return told ? std::optional(mission::position{told->latitude, told->longitude, 0}) : std::nullopt;
}

// Also while an operator has told the failsafe to wait: a longer way is nothing for this battery.
bool homecoming::is_battery_low() const {
  const auto percent = flight_.view.battery_percent().value_or(-1);
  const bool is_told = flight_.failsafe_status && std::ranges::any_of(flight_.failsafe_status->latched, names_battery);
  return is_told || (percent >= 0 && percent <= flight_.configured.checks.battery_return_percent);
}

// -- around the fences ------------------------------------------------------------------------------

std::int64_t homecoming::next_deadline_ns() const {
  return flight_.homing.at == homing_stage::none ? std::numeric_limits<std::int64_t>::max()
                                                 : flight_.homing.since_ns + time_for_plan_ns();
}

std::int64_t homecoming::time_for_plan_ns() const {
  return flight_.returns_elsewhere() ? flown_elsewhere_within_ns : flown_within_ns;
}

bool homecoming::is_coming_home() const {
  const bool flies_it =
      flight_.is_on_way_home() && flight_.s.status.now == phase::landing && flight_.view.is_in(mode_kind::mission);
  return flight_.homing.at != homing_stage::none || flies_it;
}

bool homecoming::advance(effects& out, instant now) {
  auto& wanted = flight_.wanted;
  auto& homing = flight_.homing;
  if (wanted.halt == task_kind::come_home && is_coming_home())
    wanted.halt.reset();
  const auto& doing = flight_.runner.doing();
  const bool is_task = doing && doing->kind == task_kind::come_home_by_plan;
  const bool has_task = homing.at == homing_stage::holding || homing.at == homing_stage::bringing;
  const bool is_over = !flight_.is_in_flight() || flight_.has_person();
  is_for_failsafe_ = is_for_failsafe_ && !is_over;
  if (is_over || wanted.halt || wanted.go_on || (has_task && !is_task)) // a later word takes its place
    homing = {};
  return homing.at == homing_stage::none ? stop_at_home(out, now) : go_on(out, now);
}

bool homecoming::go_on(effects& out, instant now) {
  const auto at = flight_.homing.at;
  if (const auto why = why_not_by_plan(now); !why.empty()) {
    tasks_.give_up(out, now, why);
    begin_straight(out, why);
    return true;
  }
  if (at == homing_stage::held && flight_.authority.is_uncertain() && !is_for_failsafe_) {
    flight_.homing = {};
    phases_.go(
        out, trigger::held,
        "called home, and no acknowledgement of godwit's hold came: somebody may have stopped it; come_home again "
        "brings it");
    return true;
  }
  const bool is_known = flight_.may_plan(now);
  if (at != homing_stage::held || !is_known || flight_.has_open_intent() || flight_.runner.is_busy())
    return false;
  const auto way = turns(now); // it has come on a little until it held
  if (!way)
    begin_straight(out, way.error());
  else if (way->empty())
    begin_return(out);
  else
    bring(out, *way, now);
  return true;
}

// Empty: there is still time for it.
std::string homecoming::why_not_by_plan(instant now) const {
  if (flight_.homing.at == homing_stage::failed)
    return flight_.homing.why;
  if (now.now_ns - flight_.homing.since_ns >= time_for_plan_ns())
    return "the way was not flown within " + std::to_string(time_for_plan_ns() / 1'000'000'000) + " s";
  if (is_battery_low() && !flight_.returns_elsewhere())
    return "the battery is low";
  const bool is_known = flight_.homing.is_recalled || flight_.may_plan(now);
  return is_known ? "" : "the vehicle does not report where it is";
}

void homecoming::bring(effects& out, const std::vector<mission::waypoint>& turns, instant now) {
  flight_.homing.at = homing_stage::bringing;
  const auto where = *flight_.setting(now);
  auto way = turns;
  const bool climbs = turns.front().at.altitude_m > where.start.altitude_m + climb_margin_m;
  if (climbs && where.vehicle == flight::vehicle_class::multirotor) { // first, as at any return, and not on a slant
    way.insert(way.begin(), turns.front());
    way.front().at.latitude = where.start.latitude;
    way.front().at.longitude = where.start.longitude;
  }
  tasks_.begin_way_home(out, plan::way_home(way, where, flight_.returns_elsewhere() ? home() : std::nullopt));
}

// What flies lands by itself. A rover would stand in its mission mode.
bool homecoming::stop_at_home(effects& out, instant now) {
  const auto& view = flight_.view;
  const auto generation = flight_.s.progress.last_generation;
  if (!flight_.drives() || !flight_.is_in_flight() || !flight_.is_on_way_home() || flight_.has_person() ||
      flight_.runner.is_busy() || flight_.wanted.halt || stopped_in_ == generation)
    return false;
  if (!view.is_in(mode_kind::mission) || !flight_.is_at_end_of_plan() || !view.stands_at_home(now.now_ns))
    return false;
  stopped_in_ = generation;
  tasks_.begin(out, task_kind::come_home, {change_mode{mode_kind::hold}});
  return true;
}

} // namespace godwit::executor
