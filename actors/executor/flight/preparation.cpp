#include "actors/executor/flight/preparation.hpp"

#include <cmath>
#include <utility>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/domain/home/home.hpp"
#include "actors/executor/flight/mission_list.hpp"
#include "actors/executor/plan/fence_check.hpp"
#include "actors/executor/plan/places.hpp"
#include "actors/executor/preflight/checks.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::executor {
namespace {

constexpr std::int64_t look_period_ns = 1'000'000'000;

} // namespace

// -- what is known ----------------------------------------------------------------------------------

preflight::vehicle_facts preparation::look_at_vehicle(instant now) const {
  const auto& view = flight_.view;
  preflight::vehicle_facts seen;
  seen.link = view.link();
  seen.link_reason = view.why_not_connected();
  seen.line = view.line();
  seen.what = view.owner().vehicle;
  seen.autopilot = view.owner().autopilot;
  seen.fix = static_cast<io::mavlink::gps_fix_type>(view.fix_type());
  if (view.satellites() >= 0)
    seen.satellites = static_cast<std::uint8_t>(view.satellites());
  if (view.place_heard_ns() != 0)
    seen.position_age_ns = now.now_ns - view.place_heard_ns();
  seen.is_home_known = view.home().has_value();
  seen.battery_percent = view.battery_percent(); // absent before the first word of it
  seen.own = view.own_checks();
  seen.estimate = view.estimate(now.now_ns);
  seen.why_not_armed = view.why_not_armed(now.now_ns);
  seen.is_moving = view.is_moving() && !flight_.is_in_flight();
  seen.stands_ready_to_move = seen.is_moving && !flight_.is_in_air() && view.stands();
  return seen;
}

std::string preparation::why_no_mission() const {
  const auto& id = flight_.configured.mission_id;
  if (service_.refusal().empty() && flight_.configured.asks_next())
    return "the missions service is asked for the next mission of vehicle " + flight_.configured.vehicle_id +
           "; it is loaded as soon as there is one";
  if (!service_.refusal().empty() || id.empty() || !progress::has_ended(flight_.s.progress, id, 0))
    return service_.refusal();
  return "mission " + id + " was flown to its end, or called off, before. Give it a new revision, or another mission.";
}

// What was found first stays while the vehicle's home only drifts: an operator acknowledges the distance.
std::optional<preflight::planned_home_fact> preparation::compare_planned_home(const mission::document& mission,
                                                                              const plan::plan_setting& where) {
  if (!mission.planned_home)
    return std::nullopt;
  const auto home = plan::point_of(plan::home_of(where));
  const auto planned = plan::point_of(*mission.planned_home);
  const preflight::planned_home_fact found{geo::distance_m(home, planned), geo::bearing_deg(home, planned)};
  const bool drifts = planned_home_ && std::abs(planned_home_->away_m - found.away_m) <= flight::same_home_within_m;
  if (!drifts)
    planned_home_ = found;
  return planned_home_;
}

preflight::report preparation::look_at_all(instant now) {
  const auto& mission = flight_.s.mission;
  plans_.reset();
  preflight::facts seen;
  seen.vehicle = look_at_vehicle(now);
  seen.mission.document = mission ? &*mission : nullptr;
  seen.mission.refusal = why_no_mission();
  seen.mission.is_deleted = flight_.is_withdrawn();
  seen.mission.is_brought = flight_.s.status.now == phase::ready;
  seen.mission.has_service = flight_.has_service();
  seen.mission.map = service_.map();
  seen.mission.map_problem = service_.map_problem();
  if (const auto where = flight_.setting(now); where && mission) {
    seen.mission.out_of_limits = flight_.out_of_limits(*mission, flight_.first_item(*mission), now);
    seen.mission.planned_home = compare_planned_home(*mission, *where);
    plans_ = plan::build_plans(*mission, *where, flight_.going_on(*mission, flight_.first_item(*mission)));
    seen.mission.plans = &*plans_;
    seen.mission.return_point = plan::return_point_violations(*mission);
    crossings_.clear();
    if (*plans_) {
      seen.mission.way.emplace();
      for (const auto& each : **plans_) {
        for (auto& found : plan::fence_violations(each, *mission, where->vehicle))
          seen.mission.way->push_back(std::move(found));
        for (const auto& found : plan::straight_return_crossings(each, *mission, *where))
          crossings_.push_back(found);
      }
      seen.mission.straight_return = crossings_;
      seen.mission.spare_percent = energy_.spare_after((*plans_)->front());
    }
  }
  seen.journal = host_status_.journal;
  seen.actors = host_status_.actors;
  seen.wall_ns = now.wall_ns;
  seen.is_operator_session_alive = host_status_.operators.is_there;
  seen.camera = host_status_.camera;
  seen.program = host_status_.program;
  for (const auto& each : flight_.traffic.all(flight_.configured.close_traffic, now.now_ns).aircraft) {
    seen.traffic.heard.push_back(each.sentence);
    if (each.is_close)
      seen.traffic.close.push_back(each.sentence);
  }
  last_look_ = preflight::dated_report{preflight::run_checks(seen, flight_.configured.checks), now.wall_ns};
  return last_look_->what;
}

std::string preparation::why_not_start(effects& out, instant now) {
  const preflight::looked look{look_at_all(now)};
  auto why = preflight::why_not_start(flight_.s.preflight, look.what, now.wall_ns);
  if (preflight::matters(flight_.s.preflight, look, now.wall_ns))
    out.emplace_back(note{look});
  return why;
}

// -- the way to a plan that is ready ----------------------------------------------------------------

void preparation::on_host_status(host_status seen) {
  flight_.is_journal_nearly_full = seen.journal.is_nearly_full;
  host_status_ = std::move(seen);
}

preparation::result preparation::advance(effects& out, instant now) {
  const auto at = flight_.s.status.now;
  const bool is_prepared =
      at == phase::disconnected || at == phase::connected || at == phase::preflight || at == phase::ready;
  const bool has_next = is_at_rest(at) && flight_.s.arrived;
  if (flight_.is_in_flight() || flight_.has_person() || !(is_prepared || has_next))
    return result::nothing;
  if (!flight_.view.is_connected() || !flight_.view.mode()) {
    phases_.go(out, trigger::link_lost, flight_.view.why_not_connected());
    return result::under_way;
  }
  if (take_arrived(out))
    return result::under_way;
  if (at == phase::disconnected) {
    phases_.go(out, trigger::link_found);
    return result::under_way;
  }
  if (!flight_.s.mission) { // a station has cleared it, or there never was one
    phases_.go(out, trigger::mission_changed);
    return result::nothing;
  }
  if (acknowledged_) {
    out.emplace_back(note{*std::exchange(acknowledged_, {})});
    return result::under_way;
  }
  if (at == phase::connected || std::exchange(wants_checks_, false)) {
    out.emplace_back(note{preflight::checks_wanted{flight_.s.mission->mission_id, flight_.s.mission->revision}});
    phases_.go(out, trigger::checks_begun);
    checked_ns_ = 0;
    return result::under_way;
  }
  return check(out, now);
}

bool preparation::take_arrived(effects& out) {
  if (!flight_.s.arrived)
    return false;
  const auto& next = *flight_.s.arrived;
  const bool is_over = is_at_rest(flight_.s.status.now);
  if (flight_.has_nothing_left(next) || (is_over && flight_.is_same_mission(next))) {
    flight_.refused = refused_mission(flight_, next.mission_id, next.revision, "it came when the mission was over");
    out.emplace_back(announce{"revision " + std::to_string(next.revision) + " came when the mission was over", true});
    out.emplace_back(note{arrival_refused{next.revision}});
    return true;
  }
  // Whoever has armed it since the last one may stand beside it.
  const bool is_left_to_person = flight_.was_called_off() || flight_.view.is_armed();
  out.emplace_back(note{mission_taken{next, {}, flight_.configured.asks_next() && is_left_to_person}});
  out.emplace_back(note{preflight::mission_changed{next.mission_id, next.revision}});
  phases_.go(out, trigger::mission_changed);
  return true;
}

// Where nobody is asked for it, everybody is told before each flight.
void preparation::warn_of_straight_return(effects& out) const {
  if (!flight_.configured.checks.asks_for_straight_return && !crossings_.empty())
    out.emplace_back(announce{preflight::crossing_sentence(crossings_, *flight_.s.mission), true});
}

// Whether the mission is over nobody here knows, where the landing alone is left of it: only a person can look.
std::string preparation::why_rest_refused() const {
  const auto& view = flight_.view;
  const auto& mission = flight_.s.mission;
  const bool stands = !view.is_armed() && !view.is_under_way();
  const bool was_begun = mission && flight_.first_item(*mission) > 0;
  if (!stands || !was_begun || !plans_ || *plans_)
    return {};
  return "what is left of this mission, which was begun before, can not be flown from here, and whether it is over "
         "nobody here knows. " +
         plans_->error().message() +
         " Nothing is sent; check the vehicle. With a new revision, or another mission, resume prepares that";
}

preparation::result preparation::check(effects& out, instant now) {
  const auto at = flight_.s.status.now;
  if (checked_ns_ != 0 && now.now_ns - checked_ns_ < look_period_ns)
    return result::nothing;
  checked_ns_ = now.now_ns;
  const preflight::looked look{look_at_all(now)};
  if (preflight::matters(flight_.s.preflight, look, now.wall_ns)) {
    out.emplace_back(note{look});
    checked_ns_ = 0; // and what comes of it at once
    return result::under_way;
  }
  if (const auto why = why_rest_refused(); at == phase::preflight && !why.empty()) {
    phases_.go(out, trigger::rest_refused, why);
    return result::under_way;
  }
  if (!preflight::why_not_start(flight_.s.preflight, look.what, now.wall_ns).empty())
    return result::nothing;
  if (at == phase::preflight && plans_ && *plans_) {
    warn_of_straight_return(out);
    phases_.go(out, trigger::checks_passed);
    tasks_.begin_deploy(out, *flight_.s.mission, (*plans_)->front(), flight_.s.assigned, false);
    return result::under_way;
  }
  return at == phase::ready ? result::ready : result::nothing;
}

} // namespace godwit::executor
