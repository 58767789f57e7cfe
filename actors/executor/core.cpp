#include "actors/executor/core.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <utility>

#include "actors/domain/energy/energy.hpp"
#include "actors/domain/vehicle_text/vehicle_text.hpp"
#include "actors/executor/flight/new_run.hpp"
#include "actors/executor/progress/acts.hpp"
#include "actors/executor/remaining.hpp"
#include "actors/executor/state_token.hpp"
#include "io/mavlink/enums.hpp"
#include "runtime/planted_bug.hpp"

namespace godwit::executor {
effects core::on_start(bool is_new_process) {
  recovery_.begin(is_new_process);
  auto out = on_client_back();
  out.emplace_back(watch_vehicle{false}); // the incarnation before may have begun a start
  if (flight_.s.preflight.now != preflight::phase::idle)
    out.emplace_back(note{preflight::restarted{}});
  return out;
}

effects core::on_client_back() {
  const auto& s = flight_.s;
  effects out;
  service_.forget_told();
  if (const auto id = service_.mission_under_way(); !id.empty())
    out.emplace_back(send_to_client{mission_client::begin_mission{id}});
  const bool has_ended = s.status.now == phase::post_flight || s.status.now == phase::aborted;
  if (flight_.has_service() && has_ended && s.mission)
    out.emplace_back(send_to_client{mission_client::push_map{s.mission->mission_id}});
  return out;
}

// -- the vehicle ------------------------------------------------------------------------------------

effects core::on_connection(const vehicle_link::connection& m, instant now) {
  recovery_.on_heard_for(m.heard_for_ms, now);
  auto out = on_vehicle(vehicle_link::connection_changed{m.phase, m.reason}, now);
  std::ranges::move(on_vehicle(m.line, now), std::back_inserter(out));
  return out;
}

effects core::on_vehicle(const vehicle_link::connection_changed& m, instant) {
  flight_.view.take(m);
  return {};
}

effects core::on_vehicle(const vehicle_link::vehicle_restarted&, instant) {
  effects out;
  if (progress::matters(flight_.s.progress, progress::vehicle_rebooted{}, 0))
    out.emplace_back(note{progress::vehicle_rebooted{}});
  return out;
}

effects core::on_vehicle(const vehicle_link::foreign_act& m, instant) {
  effects out;
  watch_.on_foreign(m);
  if (m.kind != vehicle_link::foreign_kind::plan)
    ground_.on_act(out);
  return out;
}

effects core::on_vehicle(const io::mavlink::global_position_int& m, instant now) {
  flight_.view.take(m, now.now_ns);
  flight_.traffic.take(m, now.now_ns);
  plan_.on_position(now);
  return {};
}

effects core::on_vehicle(const io::mavlink::heartbeat& m, instant now) {
  flight_.view.take(m, now.now_ns);
  flight_.was_up = flight_.was_up || flight_.view.is_under_way();
  end_.on_heartbeat(now);
  effects out;
  if (recovery_.has_looked()) {
    watch_.on_mode(now);
    ground_.on_mode(out, now);
  }
  return out;
}

effects core::on_vehicle(const io::mavlink::current_mode& m, instant now) {
  flight_.view.take(m);
  effects out;
  if (recovery_.has_looked() && flight_.view.mode()) {
    watch_.on_current_mode(m.intended_custom_mode, now);
    ground_.on_mode(out, now);
  }
  return out;
}

effects core::on_vehicle(const io::mavlink::mission_current& m, instant now) {
  flight_.view.take(m, now.now_ns);
  watch_.on_place(now);
  const auto& s = flight_.s;
  effects out;
  progress::current_told told{m, !flight_.view.is_armed(), !flight_.has_person() && flight_.authority.is_ours(), {}};
  const bool believes_all = GODWIT_PLANTED(complete_on_foreign_landing);
  told.is_ours = told.is_ours || believes_all;
  if (flight_.view.says_complete() && !flight_.is_complete_credible(now) && !believes_all)
    told.message.mission_state = io::mavlink::number(io::mavlink::mission_state::active);
  if (s.progress.plan && told.is_ours)
    told.never_near =
        plan_.never_near(m.seq, told.message.mission_state == io::mavlink::number(io::mavlink::mission_state::complete)
                                    ? plan_watch::told::complete
                                    : plan_watch::told::at);
  if (s.progress.plan && progress::matters(s.progress, told, now.wall_ns))
    out.emplace_back(note{told});
  return out;
}

effects core::on_vehicle(const io::mavlink::mission_item_reached& m, instant now) {
  const auto& s = flight_.s;
  const bool is_early = flight_.ends_on_ground() && m.seq >= end_of_plan(flight_.view.owner(), s).from_sequence &&
                        !flight_.came_down_as_planned(now);
  effects out;
  progress::reached_told told{m.seq, {}};
  if (!is_early && s.progress.plan)
    told.never_near = plan_.never_near(m.seq, plan_watch::told::reached);
  if (!is_early)
    note_of_mission(out, told, now);
  return out;
}

effects core::on_vehicle(const io::mavlink::statustext& m, instant now) {
  // That a person takes the vehicle does not wait for the rest of a text.
  flight_.authority.on_text(flight_.view.owner(), flight::text_of(m), now.now_ns);
  if (flight::tells_new_plan(flight::text_of(m)) && !flight_.s.progress.upload)
    flight_.evidence.plan.doubt(now.now_ns);
  effects out;
  for (const auto& each : messages_.take(out, m, now.now_ns)) {
    flight_.view.take(each, now.now_ns);
    if (const auto act = progress::act_in(each.text))
      note_of_mission(out, *act, now);
  }
  return out;
}

// Not while anybody else has the vehicle: what it does then is no progress of the mission.
void core::note_of_mission(effects& out, const progress::event& what, instant now) {
  const auto& s = flight_.s;
  if (!flight_.has_person() && flight_.authority.is_ours() && s.progress.plan &&
      progress::matters(s.progress, what, now.wall_ns))
    std::visit([&](const auto& each) { out.emplace_back(note{each}); }, what);
}

effects core::on_vehicle(const vehicle_link::picture_taken& m, instant now) {
  effects out;
  note_of_mission(out, progress::picture_told{m.index, m.is_good, m.at}, now);
  return out;
}

effects core::on_vehicle(const io::mavlink::sys_status& m, instant now) {
  flight_.view.take(m);
  return energy_.on_battery(now);
}

effects core::on_vehicle(const io::mavlink::home_position& m, instant now) {
  flight_.view.take(m, now.now_ns);
  auto out = return_place_.on_home();
  ground_.on_home(out, now);
  return out;
}

// -- people -----------------------------------------------------------------------------------------

effects core::on_station(const plan_cleared& m, instant now) {
  auto out = last_line_.stop(); // the vehicle is cleared in its place
  const auto more = stations_.on_cleared(m, recovery_.has_looked(), now);
  out.insert(out.end(), more.begin(), more.end());
  return out;
}

operators::answer core::on_operator(const operators::command& m, instant now) {
  using operators::command_kind;
  if (auto stands = state_token(flight_.s); !m.state.empty() && m.state != stands && !operators::is_stop(m.kind))
    return {false, "the flight stands otherwise by now: " + sentence(), std::move(stands)};
  if (m.kind == command_kind::acknowledge)
    preparation_.acknowledge({m.report, m.by});
  else if (m.kind == command_kind::check)
    preparation_.check_again();
  else if (m.kind == command_kind::pull) {
    auto why = service_.pull();
    return {why.empty(), std::move(why)};
  } else {
    auto answer = operators_.take(m, recovery_.has_looked(), now);
    if (answer.is_taken)
      answer.advice = advice_on_way(m, now);
    return answer;
  }
  return {true, {}};
}

std::string core::advice_on_way(const operators::command& m, instant now) const {
  if (!m.place)
    return {};
  return flight_.traffic.on_way(*m.place, energy::pace_of(flight_.view.owner().vehicle).cruise_mps,
                                flight_.configured.close_traffic, now.now_ns);
}

// What is paused, or is to be, stays so: whoever chooses an item has not said that it goes on.
effects core::on_station(const set_current& m, std::uint64_t key, instant now) {
  const auto at = flight_.s.status.now;
  if (flight_.is_in_flight() && at != phase::paused && at != phase::pausing)
    return stations_.on_start({key, m.index, std::numeric_limits<std::uint16_t>::max(), m.plan_id, m.asked_by,
                               now.wall_ns + order_is_worth_ns},
                              now);
  effects out;
  tasks_.answer_start(out, key, start_verdict::not_ready,
                      flight_.is_in_flight() ? "the flight is paused; resume it first" : "the mission does not run");
  return out;
}

std::pair<effects, act_answer> core::on_station(const station_act& m, instant now) {
  effects out;
  auto answer = acts_.take(out, m, recovery_.has_looked(), now);
  return {std::move(out), std::move(answer)};
}

effects core::on_station(const act_acknowledged& m, instant) {
  effects out;
  acts_.on_acknowledged(out, m);
  return out;
}

// -- what a note has led to -------------------------------------------------------------------------

effects core::on_news(const progress::look_at_vehicle& m, instant now) {
  recovery_.on_news(m, now);
  return {};
}

effects core::on_news(const progress::read_plan_back& m, instant now) {
  recovery_.on_news(m, now);
  return {};
}

effects core::on_news(const progress::resolve_start& m, instant now) {
  recovery_.on_news(m, now);
  return {};
}

// Who has the vehicle still has it; after the hand-back the plan counts. What is over stays so: its plan is not needed
// any more, and somebody else's is not replaced without a word. What would fly the vehicle's plan is given
// up, but for a start that may have come through.
void core::lose_plan(effects& out, trigger what, instant now) {
  if (what != trigger::foreign_plan_found && is_over(flight_.s.status.now))
    return;
  const bool is_infeasible = what == trigger::infeasible_plan_found;
  const std::string why = is_infeasible ? "the vehicle finds that the plan can not be flown"
                                        : "the vehicle does not hold our plan any more";
  if (flight_.has_person() && is_infeasible && flight_.view.is_in(flight::mode_kind::hold))
    out.emplace_back(announce{why + ": that it holds may be its own doing, and no pilot's", true});
  if (flight_.has_person())
    return;
  const auto& runner = flight_.runner;
  const auto kind = runner.doing() ? runner.doing()->kind : task_kind::stand_by;
  const bool flies_it = kind == task_kind::resume || kind == task_kind::await_arming ||
                        (kind == task_kind::start && !runner.has_asked_to_start());
  if (flies_it)
    tasks_.give_up(out, now, why);
  flight_.wanted.go_on = false;
  start_.refuse(out, why);
  phases_.go(out, what);
  if (flies_it && !flight_.is_in_flight())
    tasks_.disarm_left_armed(out);
}

effects core::on_news(const progress::progress_event& m, instant now) {
  using progress::progress_event_kind;
  effects out;
  switch (m.kind) {
  case progress_event_kind::not_at_start:
    flight_.wanted.set_current_item = m.generation == flight_.s.progress.last_generation;
    break;
  case progress_event_kind::foreign_plan:
    lose_plan(out, trigger::foreign_plan_found, now);
    break;
  case progress_event_kind::infeasible_plan:
    lose_plan(out, trigger::infeasible_plan_found, now);
    break;
  case progress_event_kind::vehicle_restarted:
    lose_plan(out, trigger::autopilot_restarted, now);
    break;
  case progress_event_kind::plan_done:
  case progress_event_kind::mission_complete:
    if (flight_.is_in_flight() && flight_.s.status.now == phase::flying)
      phases_.go(out, trigger::plan_done);
    break;
  case progress_event_kind::act_failed:
  case progress_event_kind::pictures_missing:
    out.emplace_back(announce{m.reason, true});
    break;
  case progress_event_kind::place_missed:
    out.emplace_back(announce{plan_.missed_sentence(m.reason), true});
    flight_.evidence.plan.doubt(now.now_ns);
    break;
  case progress_event_kind::generation_opened:
  case progress_event_kind::armed:
  case progress_event_kind::upload_failed:
    break;
  }
  return out;
}

} // namespace godwit::executor
