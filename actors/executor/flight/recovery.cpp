#include "actors/executor/flight/recovery.hpp"

#include <algorithm>
#include <tuple>
#include <utility>
#include <variant>

#include "actors/domain/control_authority/mode_tables.hpp"
#include "actors/executor/flight/vehicle_steps.hpp"
#include "actors/executor/remaining.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/plan_meaning.hpp"
#include "runtime/planted_bug.hpp"

namespace godwit::executor {
namespace {

using flight::mode_kind;
namespace transfer = vehicle_link::transfer;

constexpr std::int64_t read_again_after_ns = 2'000'000'000;
// Longer than it takes to restart the executor, and a heartbeat more: what a person did before, the incarnation before
// has heard.
constexpr std::int64_t heard_throughout_ms = 2'500;

bool was_prepared(phase now) { return now == phase::uploading || now == phase::ready || now == phase::starting; }

void append(std::vector<std::uint32_t>& to, const std::vector<std::uint32_t>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

constexpr std::string_view call_again =
    "godwit was restarted while the vehicle was returning; it holds: send come_home again";

} // namespace

void recovery::begin(bool is_new_process) {
  is_new_process_ = is_new_process;
  const auto& s = flight_.s;
  last_task_before_ = s.last_task;
  if (const auto& plan = s.progress.plan) // what was to be done about it died with the incarnation that was told
    flight_.wanted.set_current_item = plan->generation.is_not_at_start_told && !plan->generation.is_armed;
  const auto at = s.status.now;
  const bool is_fresh = !s.doing && !flight_.is_in_flight() && !flight_.has_open_intent();
  has_looked_ =
      (is_fresh && (at == phase::disconnected || at == phase::connected || is_over(at))) || GODWIT_PLANTED(skip_look);
}

void recovery::on_heard_for(std::int64_t ms, instant now) {
  heard_until_ns_ = ms >= heard_throughout_ms ? now.now_ns + flight::silence_ns : 0;
}

// -- the first look ---------------------------------------------------------------------------------

bool recovery::look(effects& out, instant now) {
  if (has_looked_)
    return false;
  if (!flight_.view.is_seen() || !flight_.failsafe_status)
    return true;
  has_looked_ = true;
  flight_.was_up = flight_.view.is_under_way();
  for (const auto& each : progress::resume(flight_.s.progress))
    if (std::holds_alternative<progress::look_at_vehicle>(each)) {
      on_news(progress::look_at_vehicle{}, now);
      may_upload_go_on_ = true;
      was_cut_off_ = true;
    } else if (std::holds_alternative<progress::read_plan_back>(each)) {
      on_news(progress::read_plan_back{}, now);
      was_cut_off_ = true;
    } else if (const auto* start = std::get_if<progress::resolve_start>(&each))
      on_news(*start, now);
  if (flight_.view.is_under_way())
    recover_in_flight(out, now);
  else
    recover_on_ground(out, now);
  return true;
}

// While nobody was here, or when nobody could write it down any more: the vehicle is in a mode in which no step of the
// start leaves it.
bool recovery::was_taken_in_start() const {
  const auto& doing = flight_.s.doing;
  if (!flight_.is_starting() || flight_.is_in_flight() || flight_.has_person() || !doing->mode_before)
    return false;
  const auto& whose = flight_.view.owner();
  auto modes = flight::modes_of_start(whose);
  modes.push_back(*doing->mode_before);
  append(modes, flight::modes_obeying(whose, mode_kind::guided));
  append(modes, flight_.modes_after_disarm());
  if (const auto stands_in = flight::standing_mode(whose))
    modes.push_back(*stands_in);
  return std::ranges::find(modes, flight_.view.mode()->custom_mode) == modes.end();
}

// Nothing begins by itself: whoever stands beside the vehicle has seen godwit fail.
void recovery::recover_on_ground(effects& out, instant now) {
  const auto& s = flight_.s;
  if (was_taken_in_start())
    return watch_.find_taken(out);
  if (flight_.is_in_flight() && !flight_.has_person()) { // it has come down meanwhile: by itself, or by somebody
    auto modes = left_in(s.doing);
    append(modes, end_of_plan(flight_.view.owner(), s).modes);
    append(modes, flight_.modes_after_disarm());
    watch_.resume(std::move(modes), now);
  }
  tasks_.end(out, "godwit was restarted before the vehicle moved");
  if (flight_.s.status.now == phase::pausing) // it stands: it is not commanded to hold once more
    phases_.go(out, trigger::found_in_flight);
  if (flight_.is_in_flight() || flight_.has_person() || is_over(s.status.now))
    return; // the end of the flight sees to it; who has the vehicle keeps it, and what is over stays so
  if (!s.doing && !was_prepared(s.status.now))
    return;
  if (s.doing && s.doing->kind == task_kind::start)
    flight_.runner.assume_armed();
  phases_.go(out, trigger::restarted_on_ground);
}

std::vector<std::uint32_t> recovery::left_in(const std::optional<task>& doing) const {
  const auto& whose = flight_.view.owner();
  const auto holds = flight::modes_obeying(whose, mode_kind::hold);
  const auto at = flight_.s.status.now;
  const bool is_at_end = flight_.is_landing() || flight_.s.status.cause == pause_cause::plan_ended;
  const bool returns = doing && doing->kind == task_kind::come_home;
  if (flight_.is_held() && !doing)
    return holds;
  auto result = flight::modes_of_start(whose);
  if (at == phase::paused || (doing && !returns))
    append(result, holds);
  if (returns || flight_.was_called_home())
    append(result, flight::modes_obeying(whose, mode_kind::returning));
  if (flight_.was_called_home())
    append(result, holds); // a rover that has come home
  if (is_at_end)
    append(result, end_of_plan(whose, flight_.s).modes);
  return result;
}

// The task is ended by the first restart; a second one after it still finds the vehicle held for it.
std::optional<task> recovery::was_doing() const {
  const auto& s = flight_.s;
  const bool is_cut_off = s.progress.upload || (s.cut_off_uploads > 0 && !s.waiting.empty());
  if (s.doing || !is_cut_off || !flight_.is_in_flight() || s.status.now != phase::flying)
    return s.doing;
  return task{s.last_task, task_kind::deploy, true, {}};
}

void recovery::recover_in_flight(effects& out, instant now) {
  const auto doing = was_doing();
  const bool was_starting = flight_.is_starting();
  const bool stands = !flight_.view.is_moving() && (was_starting || !flight_.is_in_air());
  if (!flight_.is_in_flight() && stands)
    return recover_on_ground(out, now); // a rover that is armed
  tasks_.end(out, "godwit was restarted while the vehicle started");
  if (!(flight_.is_in_flight() || was_starting) || flight_.has_person())
    return;
  flight_.wanted.guard_again = doing && doing->kind == task_kind::deploy;
  if (flight_.failsafe_status->reacts || flight_.failsafe_status->taken_over)
    return phases_.go(out, trigger::found_on_its_way); // the watch says the rest
  watch_.resume(left_in(doing), now);
  find_in_flight(out, doing, now);
}

// What was meant and is not done is finished by a mode change, and only out of the hold that we have commanded.
void recovery::find_in_flight(effects& out, const std::optional<task>& doing, instant now) {
  const auto is = [&](task_kind kind) { return doing && doing->kind == kind; };
  if (is(task_kind::come_home_by_plan))
    return find_called_home(out, now);
  const bool is_held = flight_.authority.is_ours() && flight_.view.obeys(mode_kind::hold);
  const bool was_to_go_on = is(task_kind::resume) || (is(task_kind::deploy) && doing->goes_on);
  // The hold may be a person's who came while nobody heard the vehicle.
  if (is_held && was_to_go_on && (is_new_process_ || now.now_ns > heard_until_ns_)) {
    late_order_until_ns_ = now.now_ns + flight::order_is_expected_ns;
    flight_.authority.expect_also(flight::modes_of_start(flight_.view.owner()), now.now_ns, late_order_until_ns_);
    return phases_.go(out, trigger::found_held, "godwit was restarted while the vehicle was held; resume goes on");
  }
  if (is_held && was_to_go_on) {
    flight_.wanted.finish_replan = true;
    return phases_.go(out, trigger::found_on_its_way);
  }
  if (is_held && flight_.s.status.cause == pause_cause::infeasible_plan)
    return phases_.go(out, trigger::infeasible_plan_found, flight_.s.status.reason);
  if (is_held && !doing && flight_.s.status.cause == pause_cause::not_done)
    return phases_.go(out, trigger::task_failed, flight_.s.status.reason);
  if (is_held && (flight_.s.status.cause == pause_cause::asked || is(task_kind::hold)))
    return phases_.go(out, trigger::found_held);
  const bool is_ours = flight_.authority.is_ours() && !flight_.authority.is_unclear();
  if (is_ours && is(task_kind::come_home) && flight_.view.is_in(mode_kind::returning))
    return tasks_.follow_return(out);
  if (is_ours && !flight_.is_landing() && flight_.view.is_in(mode_kind::mission) &&
      (is(task_kind::hold) || is(task_kind::come_home))) {
    // An operator's word, which the vehicle has not heard or not shown yet.
    if (is(task_kind::hold) && flight_.s.commanded) {
      phases_.go(out, trigger::found_in_flight);
      return tasks_.begin(out, task_kind::hold, {change_mode{mode_kind::hold}}); // and then it is sent elsewhere
    }
    flight_.wanted.put_halt(doing->kind);
  }
  phases_.go(out, trigger::found_in_flight);
}

// It is flown already, or the operator's word is done anew. What needs a start is not begun by a restart.
void recovery::find_called_home(effects& out, instant now) {
  const bool flies_it =
      flight_.view.is_in(mode_kind::mission) && flight_.is_on_way_home() && !flight_.has_open_intent();
  if (flies_it || !flight_.authority.is_ours()) {
    flight_.wanted.guard_again = flies_it;
    return phases_.go(out, trigger::found_in_flight);
  }
  if (starts_in_mission_mode(flight_)) {
    phases_.go(out, trigger::found_in_flight);
    flight_.wanted.put_halt(task_kind::hold);
    out.push_back(announce{std::string(call_again), true});
    return;
  }
  flight_.homing = {homing_stage::holding, now.now_ns, true, {}};
  phases_.go(out, trigger::called_home_by_plan);
  tasks_.begin(out, task_kind::come_home_by_plan, {change_mode{mode_kind::hold}});
}

// -- what was left open -----------------------------------------------------------------------------

void recovery::on_news(const progress::look_at_vehicle&, instant now) {
  was_cut_off_ = false;
  looking_ = question::plan_id;
  looking_since_ns_ = now.now_ns;
}

void recovery::on_news(const progress::read_plan_back&, instant now) {
  looking_ = question::read_back;
  reading_back_ = 0;
  read_again_ns_ = now.now_ns;
}

void recovery::on_news(const progress::resolve_start&, instant now) {
  looking_ = question::start;
  looking_since_ns_ = now.now_ns;
}

// The link takes it after the transfer that is under way.
void recovery::read_back(effects& out, instant now) {
  if (reading_back_ != 0 || now.now_ns < read_again_ns_)
    return;
  reading_back_ = ++last_reading_back_;
  out.emplace_back(order{goes::after_notes, reading_back_, now.now_ns, {}, vehicle_link::download_plan{}});
}

bool recovery::follow_late_order(effects& out, instant now) {
  if (now.now_ns >= late_order_until_ns_ || !flight_.is_held() || !flight_.authority.is_ours() ||
      !flight_.view.is_in(going_on_mode(flight_)))
    return false;
  late_order_until_ns_ = 0;
  phases_.go(out, trigger::resumed);
  return true;
}

bool recovery::resolve(effects& out, instant now) {
  if (follow_late_order(out, now))
    return true;
  if (looking_ == question::none || (flight_.is_in_flight() && flight_.has_person()))
    return false;
  if (!flight_.view.is_connected())
    return true;
  const bool is_news = flight_.view.current() && flight_.view.current_heard_ns() > looking_since_ns_;
  switch (looking_) {
  case question::plan_id:
    resolve_plan_id(out, now, is_news);
    break;
  case question::read_back:
    read_back(out, now);
    break;
  case question::start:
    resolve_start(out, is_news);
    break;
  case question::none:
    break;
  }
  return true;
}

void recovery::resolve_plan_id(effects& out, instant now, bool is_news) {
  if (may_upload_go_on_)
    return read_back(out, now);
  const auto& view = flight_.view;
  if (view.keeps_plan_ids() && !is_news)
    return;
  looking_ = question::none;
  const auto id = view.keeps_plan_ids() ? std::optional(view.current()->mission_id) : std::nullopt;
  out.emplace_back(note{progress::vehicle_looked_at{id, tries_again()}});
}

// An upload that kills whoever makes it is not tried for ever.
bool recovery::tries_again() const {
  return was_cut_off_ && flight_.s.cut_off_uploads + 1 < static_cast<std::uint32_t>(max_uploads);
}

bool recovery::is_mixture(const std::vector<io::mavlink::mission_item_int>& items) const {
  const auto& [brings, flown] = std::tie(flight_.s.brings, flight_.s.flown);
  if (!brings || !flown)
    return false;
  const auto has = [&](const deployment& of, std::size_t i) {
    return i < of.items.size() && io::mavlink::means_the_same(of.items[i], items[i]);
  };
  for (std::size_t i = flight_.plan_has_home() ? 1 : 0; i < items.size(); ++i)
    if (!has(*brings, i) && !has(*flown, i))
      return false;
  return true;
}

void recovery::resolve_start(effects& out, bool is_news) {
  if (!is_news || !flight_.view.mode())
    return;
  looking_ = question::none;
  out.emplace_back(note{progress::start_ended{flight_.view.is_armed() && flight_.view.is_in_begun_mission()}});
}

void recovery::take_read_back(effects& out, std::uint64_t number, const transfer::outcome& outcome, instant now) {
  if (number != reading_back_ || (looking_ != question::read_back && looking_ != question::plan_id))
    return;
  reading_back_ = 0;
  if (outcome.verdict != transfer::verdict::accepted) {
    read_again_ns_ = now.now_ns + read_again_after_ns;
    return;
  }
  if (looking_ == question::plan_id) { // no upload goes on in the link; what the vehicle says from now on holds
    may_upload_go_on_ = false;
    looking_since_ns_ = now.now_ns;
    return;
  }
  const bool has_home = flight_.plan_has_home();
  const auto is_same = [&](const std::optional<deployment>& one) {
    return one && !io::mavlink::first_difference(one->items, outcome.items, has_home);
  };
  auto match = progress::read_back_match::other;
  if (is_same(flight_.s.brings))
    match = progress::read_back_match::pending;
  else if (is_same(flight_.s.flown))
    match = progress::read_back_match::before;
  looking_ = question::none;
  const bool may_try = match == progress::read_back_match::before ||
                       (match == progress::read_back_match::other && is_mixture(outcome.items));
  out.emplace_back(note{progress::plan_read_back{match, may_try && tries_again()}});
  was_cut_off_ = false;
}

// -- what was meant ---------------------------------------------------------------------------------

bool recovery::finish(effects& out) {
  auto& wanted = flight_.wanted;
  if (std::exchange(wanted.finish_replan, false)) {
    begin_going_on(out);
    return true;
  }
  if (wanted.guard_again && !flight_.is_failsafe_gone && flight_.s.status.now != phase::paused && flight_.s.flown) {
    tasks_.begin(out, task_kind::resume, tasks_.guarded({}));
    return true;
  }
  if (flight_.s.progress.plan && flight_.s.progress.plan->generation.is_armed)
    wanted.set_current_item = false; // it was found to be further
  if (wanted.set_current_item && flight_.s.status.now == phase::flying && flight_.s.progress.plan) {
    wanted.set_current_item = false;
    begin_at_start(out);
    return true;
  }
  return false;
}

// The vehicle has another item than the one with which it should begin. A new incarnation starts nothing.
void recovery::begin_at_start(effects& out) {
  const bool has_begun_task = flight_.s.last_task != last_task_before_;
  tasks_.begin(out, task_kind::resume, tasks_.guarded(at_start_steps(flight_, has_begun_task)));
}

// The vehicle is held with the new plan; whether it was told where to begin is not known.
void recovery::begin_going_on(effects& out) {
  auto way = going_on_steps(flight_);
  if (std::holds_alternative<start_plan>(way.front())) // a start, which nothing but a person's word may cause
    return phases_.go(out, trigger::replan_left_open);
  if (flight_.is_ardupilot() && flight_.s.progress.plan && !std::holds_alternative<set_current_item>(way.front()))
    way = at_start_steps(flight_, false);
  tasks_.begin(out, task_kind::resume, tasks_.guarded(std::move(way)));
}

} // namespace godwit::executor
