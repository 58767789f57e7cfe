#include "actors/failsafe/core.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>
#include <utility>

#include "actors/domain/control_authority/mode_tables.hpp"
#include "actors/domain/home/home.hpp"
#include "actors/domain/vehicle_text/vehicle_text.hpp"
#include "actors/failsafe/vehicle_texts.hpp"

namespace godwit::failsafe {

using io::mavlink::mav_severity;

namespace {

// PX4 says so for a moment when a plan has just been replaced.
constexpr std::uint16_t no_sequence = 65535;

std::string_view handed_back_in_silence(operator_link_policy policy) {
  if (policy == operator_link_policy::required)
    return "handed back while the operator's ground station is silent: its silence counts from now on";
  return "handed back while the operator's ground station is silent: it is not missed again before it was heard";
}

// That a station was once heard belongs to the flight. After one, it is heard anew or it is not there.
link_memory memory_for(const standing& restored) { return restored.in_flight ? restored.link : link_memory{}; }

} // namespace

core::core(const settings& configured, const state& restored, instant now)
    : settings_(configured), flight_(restored.now.in_flight, configured.moving_mps),
      pilot_(restored.now.pilot, restored.limits.plan_end, now),
      battery_(configured.battery_critical_percent, configured.battery_low_percent),
      link_(configured, memory_for(restored.now), now), overrides_(restored.now.overridden, now),
      latches_(restored.now.latches), reaction_(restored.now.reacts, restored.now.last_number, now.monotonic_ns),
      limits_(restored.limits), home_(restored.now.home), armed_at_(restored.now.armed_at),
      by_plan_(restored.now.by_plan), asked_plan_ns_(now.monotonic_ns), kept_(restored.now) {
  if (auto fences = geofence::fence_set::build(limits_.geofences))
    fences_.set(std::move(*fences));
  else
    limits_refused_ = true;
  if (restored.now.reacts && restored.now.reacts->tries > 0)
    pilot_.forget_the_plan();
  failsafe_status_ = stand(restored.now.in_flight);
}

// -- what is heard --------------------------------------------------------------------------------

void core::take(const event& heard, instant now) {
  std::visit([&](const auto& what) { handle(what, now); }, heard);
}

// Autopilots move their home when they are armed.
void core::handle(const heartbeat& what, instant now) {
  if (heartbeat_ns_ != 0 && what.armed && !newest_.armed) {
    home_.reset();
    armed_at_.reset();
  }
  newest_ = what;
  modes_.reset(); // told before it
  newest_mode_ = what.mode;
  heartbeat_ns_ = now.monotonic_ns;
  flight_.on_heartbeat(what.what, what.armed, now.monotonic_ns);
}

void core::handle(const modes_told& what, instant now) {
  if (heartbeat_ns_ == 0)
    return;
  modes_ = {what, now};
  newest_mode_ = flight::mode_of(owner(), what.actual);
}

void core::handle(const landed& what, instant) { flight_.on_landed(what.how); }

void core::handle(const position& what, instant now) {
  fences_.on_position(what, now.monotonic_ns);
  flight_.on_speed(std::hypot(what.north_mps, what.east_mps));
}

void core::handle(const home_told& what, instant) {
  home_ = what.where;
  if (newest_.armed && !armed_at_)
    armed_at_ = flight::home_of_arming(what.where, limits_.home_before);
}

void core::handle(const battery& what, instant now) { battery_.on_sample(what.percent, now.monotonic_ns); }

void core::handle(const mission_current& what, instant now) {
  place_ = {what, now};
  if (what.sequence == no_sequence)
    return;
  sequence_ = what.sequence;
  sequence_ns_ = now.monotonic_ns;
}

void core::handle(const autopilot_text& what, instant now) {
  if (flight::tells_of_authority(what.what) && texts_.size() < max_texts)
    texts_.push_back({what.what, now});
}

void core::handle(const command_resolved& what, instant) {
  const auto& current = reaction_.current();
  if (what.verdict == vehicle_link::command_verdict::outdated && current && what.number == reaction_.last_number())
    orders_.push_back({modes_for(current->what, owner()), 0, true}); // it was not sent
  reaction_.on_resolved(what);
}

void core::handle(const operator_heard& what, instant now) { link_.on_report(what.ever_heard, what.age_ms, now); }

void core::handle(const controller_heard&, instant now) { link_.on_controller(now); }

void core::handle(const asked_override& what, instant) {
  if (wanted_overrides_.size() < max_waiting_overrides)
    wanted_overrides_.push_back(what);
}

void core::handle(const hand_back&, instant) { hand_back_received_ = true; }

void core::handle(const asked_guard& what, instant) { new_limits_ = what; }

void core::handle(const expect_mode& what, instant) { orders_.push_back(what); }

void core::handle(const taken_over&, instant) { takeover_received_ = true; }

// On the ground somebody else may do as he likes; and who has it already may be handing it back in this moment.
void core::handle(const vehicle_link::foreign_act& what, instant) {
  if (what.kind == vehicle_link::foreign_kind::command && failsafe_status_.in_flight && !pilot_.is_taken_over())
    takeover_received_ = true;
}

void core::handle(const command_pending& what, instant now) {
  pending_until_ns_ = now.monotonic_ns + what.lasts_ms * ns_per_ms;
}

void core::handle(const following& what, instant) { link_.on_following(what.on); }

void core::handle(const return_taken& what, instant) { plan_answer_ = what; }

// -- the tick -------------------------------------------------------------------------------------

effects core::tick(instant now) {
  effects out;
  take_limits(out);
  auto seen = look(now);
  follow_flight(seen);
  hear_words(now, out);
  seen.link = link_.evaluate(now);
  watch_pilot(seen, now, out);
  judge_rules(seen, now, out);
  resolve_plan(now, out);
  drive(seen, now, out);
  warn_of_link(seen, out);
  warn_of_fence(seen, now, out);
  tell_failsafe_status(seen.flight.in_flight, out);
  tell_health(seen, out);
  keep(seen.flight.in_flight, out);
  return out;
}

void core::take_limits(effects& out) {
  if (!new_limits_)
    return;
  auto wanted = std::exchange(new_limits_, std::nullopt);
  auto fences = geofence::fence_set::build(wanted->what.geofences);
  limits_refused_ = !fences;
  if (fences) {
    fences_.set(std::move(*fences));
    has_new_limits_ = wanted->what != limits_;
    limits_ = std::move(wanted->what);
    pilot_.set_plan_end(limits_.plan_end);
    place_.reset(); // it may be that of the plan before
    sequence_.reset();
    sequence_ns_ = 0;
    out.emplace_back(guard_resolved{wanted->request_id, {true, {}}});
  } else {
    out.emplace_back(guard_resolved{wanted->request_id, {false, fences.error()}});
  }
}

core::view core::look(instant now) {
  view seen;
  seen.flight = flight_.evaluate(now.monotonic_ns);
  if (seen.flight.begins)
    fences_.begin_flight();
  seen.battery = battery_.judge(now.monotonic_ns);
  seen.fences = fences_.evaluate(now.monotonic_ns, seen.flight.near_ground);
  return seen;
}

void core::follow_flight(const view& seen) {
  if (!seen.flight.ends)
    return;
  latches_.release_all();
  reaction_.drop();
  by_plan_.reset();
}

// Of two contrary words in one tick, that a pilot has the vehicle counts. It does on the ground too: a person may have
// ended a start.
void core::hear_words(instant now, effects& out) {
  const bool taken = std::exchange(takeover_received_, false);
  const bool handed_back = std::exchange(hand_back_received_, false) && !taken;
  if (taken && !pilot_.is_taken_over()) {
    pilot_.take_over();
    out.emplace_back(warning{mav_severity::notice, "somebody else has the vehicle; the failsafes only warn"});
  }
  if (handed_back) {
    pilot_.hand_back();
    latches_.release_all();
    reaction_.drop();
    by_plan_.reset();
    if (link_.on_hand_back(now))
      out.emplace_back(warning{mav_severity::warning, std::string(handed_back_in_silence(settings_.operator_link))});
  }
  overrides_.expire(now);
  auto wanted = std::exchange(wanted_overrides_, {});
  std::sort(wanted.begin(), wanted.end(), [](const asked_override& a, const asked_override& b) {
    return std::tie(a.what.until_ns, a.request_id) < std::tie(b.what.until_ns, b.request_id);
  });
  for (const auto& each : wanted) {
    const auto done = overrides_.take(each.what, now);
    out.emplace_back(override_resolved{each.request_id, {done.has_value(), done ? std::string() : done.error()}});
    if (done)
      lift(each.what.scope);
  }
}

// What else had wanted the same has to say so again.
void core::lift(rule scope) {
  latches_.release(scope);
  const auto& current = reaction_.current();
  const bool is_reacting = (current && current->why == scope) || (by_plan_ && by_plan_->why == scope);
  if (!is_reacting)
    return;
  reaction_.drop();
  by_plan_.reset();
  latches_.release_all();
}

// An order is given to the vehicle where it is: of the two, the place is first.
void core::watch_pilot(const view& seen, instant now, effects& out) {
  const bool before = pilot_.is_taken_over();
  const bool was_autopilots = pilot_.is_autopilots();
  for (const auto& each : std::exchange(texts_, {}))
    pilot_.on_text(owner(), each.what, each.at);
  if (const auto place = std::exchange(place_, std::nullopt))
    pilot_.on_place(place->what.sequence, place->what.is_complete, place->at);
  for (const auto& each : std::exchange(orders_, {})) {
    if (each.is_withdrawn)
      pilot_.withdraw(each.modes);
    else
      pilot_.expect(each.modes, each.lasts_ms, now);
  }
  if (seen.flight.link_up)
    pilot_.evaluate(seen.flight, {owner(), newest_.mode, newest_.is_critical, heartbeat_ns_, newest_mode_}, now);
  if (const auto told = std::exchange(modes_, std::nullopt); told && seen.flight.in_flight)
    pilot_.on_current_mode(
        owner(), {flight::mode_of(owner(), told->what.actual), newest_.is_critical, told->what.intended}, told->at);
  if (pilot_.is_taken_over())
    by_plan_.reset();
  if (!was_autopilots && pilot_.is_autopilots())
    out.emplace_back(warning{mav_severity::notice, "the autopilot's own failsafe has the vehicle; ours only warn"});
  else if (!before && pilot_.is_taken_over())
    out.emplace_back(warning{mav_severity::notice, "the mode was changed by somebody else; the failsafes only warn"});
}

// -- the rules ------------------------------------------------------------------------------------

bool core::has_cause(rule each, const view& seen) const {
  if (!seen.flight.may_act || overrides_.holds(each))
    return false;
  switch (each) {
  case rule::battery_critical:
    return seen.battery.critical;
  case rule::fence:
    return seen.fences.finding == fence_finding::breached;
  case rule::battery_low:
    return seen.battery.low;
  case rule::operator_link:
    break;
  }
  return seen.link == link_phase::lost;
}

bool core::leaves_it_to_pilot() const { return pilot_.is_taken_over() && !settings_.failsafe_in_manual; }

void core::judge_rules(const view& seen, instant now, effects& out) {
  for (const auto each : rules) {
    const auto what = action_for(each, newest_.what, limits_.land_start.has_value());
    if (what && !latches_.holds(each) && has_cause(each, seen))
      act(each, *what, seen, now, out);
  }
}

// The executor knows it; of a first flight it is that of the arming.
const std::optional<flight::home_place>& core::home_of_mission() const {
  return limits_.home ? limits_.home : armed_at_;
}

// Home was moved, or is where the vehicle was armed again on the way, or nobody knows where.
bool core::returns_elsewhere() const {
  const auto& there = home_of_mission();
  return there && !(home_ && !flight::is_moved(*home_, *there));
}

std::string core::where_it_returns() const {
  const auto& there = home_of_mission();
  if (!there || !home_)
    return "is not known to lead to the home of the mission";
  const auto away_m = std::lround(flight::distance_m(*home_, *there));
  return "leads to a place " + std::to_string(away_m) + " m from the home of the mission";
}

void core::act(rule why, action what, const view& seen, instant now, effects& out) {
  const auto cause = cause_of(why, seen.battery, seen.fences);
  const auto& current = reaction_.current();
  if (leaves_it_to_pilot()) {
    latches_.set(why, latch_kind::left_to_pilot);
    out.emplace_back(warning{mav_severity::critical, cause + "; a pilot has the vehicle, nothing is sent"});
    return;
  }
  if ((current && is_higher(current->why, why)) || (by_plan_ && is_higher(by_plan_->why, why))) {
    latches_.set(why, latch_kind::covered);
    out.emplace_back(warning{mav_severity::warning, cause + "; something worse is being acted on"});
    return;
  }
  latches_.set(why, latch_kind::acted);
  if (what == action::return_home && returns_elsewhere() && !(current && current->what == what))
    return ask_for_plan(why, cause, now, out);
  by_plan_.reset();
  pilot_.forget_the_plan();
  if (current && current->what == what)
    reaction_.raise(why);
  else
    reaction_.begin(why, what);
  out.emplace_back(warning{mav_severity::critical, cause + ": " + deed_of(what)});
}

// -- a return by a plan -----------------------------------------------------------------------------

void core::ask_for_plan(rule why, const std::string& cause, instant now, effects& out) {
  if (by_plan_) {
    by_plan_->why = why;
    out.emplace_back(warning{mav_severity::critical, cause + ": the vehicle returns by a plan already"});
    return;
  }
  reaction_.drop();
  by_plan_ = plan_return{static_cast<std::uint64_t>(now.wall_ns), why, false};
  asked_plan_ns_ = now.monotonic_ns;
  out.emplace_back(
      warning{mav_severity::critical,
              cause + ": the vehicle is to return by a plan, because its own return " + where_it_returns()});
}

void core::resolve_plan(instant now, effects& out) {
  const auto answer = std::exchange(plan_answer_, std::nullopt);
  if (!by_plan_ || by_plan_->is_taken)
    return;
  if (answer && answer->number == by_plan_->number) {
    by_plan_->is_taken = answer->is_taken;
    if (!answer->is_taken)
      return_without_plan(answer->reason, out);
  } else if (now.monotonic_ns - asked_plan_ns_ >= plan_answer_ms * ns_per_ms) {
    return_without_plan("the executor does not answer", out);
  }
}

// Better home to where it leads than not at all; where nobody knows where that is it holds.
void core::return_without_plan(const std::string& why, effects& out) {
  const auto what = home_ ? action::return_home : action::hold;
  const auto wants = std::exchange(by_plan_, std::nullopt)->why;
  pilot_.forget_the_plan();
  reaction_.begin(wants, what);
  out.emplace_back(warning{mav_severity::critical,
                           deed_of(what) + ", and its return " + where_it_returns() + "; no plan is flown: " + why});
}

// After a return some vehicles hold by themselves, and a person may hold there too: neither is commanded to return
// again.
bool core::follows_what_is_wanted() const {
  const auto& current = reaction_.current();
  if (!current)
    return false;
  const auto wanted = modes_for(current->what, owner());
  return std::any_of(wanted.begin(), wanted.end(), [this](std::uint32_t each) {
    return flight::follows_by_itself(owner(), each, newest_.mode.custom_mode, true);
  });
}

// A command that was sent may show in a heartbeat after another has taken its place.
void core::drive(const view& seen, instant now, effects& out) {
  const bool is_pending = now.monotonic_ns < pending_until_ns_;
  const bool may_send =
      seen.flight.link_up && seen.flight.may_act && !leaves_it_to_pilot() && !pilot_.is_unclear() && !is_pending;
  const bool on_landing = limits_.land_start && sequence_ && *sequence_ >= *limits_.land_start;
  const bool is_ours = !pilot_.is_taken_over() && !pilot_.is_unclear() && !follows_what_is_wanted();
  const auto step = reaction_.drive({newest_.mode.kind, heartbeat_ns_, may_send, is_ours, on_landing, sequence_ns_},
                                    now.monotonic_ns);
  if (step.send) {
    pilot_.expect(modes_for(step.send->what, owner()), command_answer_ms + obedience_ms, now);
    out.insert(out.begin(), *step.send); // before anything else
  }
  if (step.fails_first)
    out.emplace_back(warning{mav_severity::alert, "what the failsafe wants does not get through; it tries on"});
  if (step.disobeyed)
    out.emplace_back(warning{mav_severity::alert, "the vehicle accepted what the failsafe wants and does not do it"});
  if (step.was_left)
    out.emplace_back(
        warning{mav_severity::alert, "the vehicle has left the mode of the failsafe; it is commanded again"});
}

// -- what is said ---------------------------------------------------------------------------------

void core::warn_of_link(const view& seen, effects& out) {
  const auto is_silent = [](link_phase phase) { return phase == link_phase::degraded || phase == link_phase::lost; };
  const auto before = std::exchange(said_link_, seen.link);
  if (is_silent(seen.link) && !is_silent(before))
    out.emplace_back(warning{mav_severity::warning, "the operator's ground station is silent"});
  else if (seen.link == link_phase::ok && is_silent(before))
    out.emplace_back(warning{mav_severity::notice, "the operator's ground station is heard again"});
}

void core::warn_of_fence(const view& seen, instant now, effects& out) {
  if (!seen.flight.may_act || !seen.fences.ahead)
    return;
  const auto before = std::exchange(fence_ahead_ns_, now.monotonic_ns);
  if (!before || now.monotonic_ns - *before >= fence_warning_quiet_ms * ns_per_ms)
    out.emplace_back(warning{mav_severity::warning, "a fence is near: in 2 s " + seen.fences.ahead->sentence()});
}

failsafe_status core::stand(bool in_flight) const {
  failsafe_status result{in_flight, pilot_.is_taken_over(), {}, {}, overrides_.all(), reaction_.last_number(), {}};
  if (by_plan_ && !by_plan_->is_taken)
    result.return_asked = asked_return{by_plan_->number, by_plan_->why};
  if (const auto& current = reaction_.current())
    result.reacts = told_reaction{current->why, current->what, reaction_.stage()};
  for (const auto each : rules)
    if (latches_.holds(each))
      result.latched.push_back(each);
  return result;
}

void core::tell_failsafe_status(bool in_flight, effects& out) {
  auto now = stand(in_flight);
  if (now == failsafe_status_)
    return;
  failsafe_status_ = std::move(now);
  out.emplace_back(failsafe_status_changed{failsafe_status_});
}

void core::tell_health(const view& seen, effects& out) {
  auto how =
      judge_health({seen.flight, newest_.what, seen.battery, seen.fences.finding, seen.link, pilot_.is_taken_over(),
                    limits_refused_, failsafe_status_.reacts, by_plan_ ? std::optional(by_plan_->why) : std::nullopt});
  if (how == health_)
    return;
  health_ = std::move(how);
  out.emplace_back(health_);
}

void core::keep(bool in_flight, effects& out) {
  standing now{in_flight,        latches_.all(),  reaction_.current(), reaction_.last_number(),
               overrides_.all(), pilot_.memory(), link_.memory(),      home_,
               armed_at_,        by_plan_};
  if (now == kept_ && !has_new_limits_)
    return;
  kept_ = std::move(now);
  out.emplace_back(remember{{kept_, has_new_limits_ ? std::optional(limits_) : std::nullopt}});
  has_new_limits_ = false;
}

} // namespace godwit::failsafe
