// The part of the core that is about plans, their progress and the current item.
#include <algorithm>
#include <string>
#include <utility>

#include "actors/ground_port/core.hpp"
#include "actors/ground_port/decision_context.hpp"
#include "runtime/assert.hpp"

namespace godwit::ground_port {

namespace {

using executor::current_verdict;
using mavlink::mav_mission_type;
using mavlink::mav_result;
using mavlink::mav_severity;
using mavlink::mission_state;

constexpr std::uint16_t no_mission_total = 65'535;

constexpr std::array all_types{mav_mission_type::mission, mav_mission_type::fence, mav_mission_type::rally};

std::size_t place_of(mav_mission_type type) { return static_cast<std::size_t>(mavlink::number(type)); }

mav_result result_for(current_verdict verdict) {
  switch (verdict) {
  case current_verdict::going:
    return mav_result::accepted;
  case current_verdict::not_running:
  case current_verdict::not_now:
    return mav_result::temporarily_rejected;
  case current_verdict::no_such_item:
    return mav_result::denied;
  case current_verdict::failed:
    break;
  }
  return mav_result::failed;
}

std::optional<mavlink::mission_ack> ack_in(const mission_server::reaction& of) {
  for (const auto& each : of.messages)
    if (const auto* ack = std::get_if<mavlink::mission_ack>(&each))
      return *ack;
  return std::nullopt;
}

// Of those of the type one at most has no verdict yet.
template <class Verdicts>
bool take_verdict(Verdicts& of, const plan_judged& m) {
  const auto found = std::ranges::find_if(
      of, [&](const auto& each) { return each.type == m.type && each.plan_id == m.plan_id && !each.verdict; });
  if (found == of.end())
    return false;
  if (m.verdict == plan_verdict::bringing)
    found->is_brought = true;
  else
    found->verdict = m.verdict;
  return true;
}

} // namespace

void core::make_server() {
  auto autopilot_quirks = mission_server::plain_quirks();
  autopilot_quirks.capacity = settings_.max_items;
  autopilot_quirks.listens = mission_server::hears::component_0_too;
  server_.emplace(autopilot_quirks, ourselves());
}

// -- plans ----------------------------------------------------------------------------------------

void core::go_on(decision_context& t, mission_server::reaction next) {
  // To clear what is not there changes nothing that has to be written; but the vehicle may hold a mission of others.
  std::erase_if(next.changes, [&](const mission_server::plan_change& each) {
    const bool is_of_vehicle = has_executor_ && each.type == mav_mission_type::mission;
    return each.kind == mission_server::plan_change_kind::begun_replacing ||
           (each.kind == mission_server::plan_change_kind::cleared && waiting_for_disk_ == 0 && !is_of_vehicle &&
            shown_[place_of(each.type)].items == 0);
  });
  if (!next.changes.empty()) {
    if (repeats_clear(next))
      return;
    const auto ack = ack_in(next);
    for (std::size_t i = 0; i < next.changes.size(); ++i)
      note_change(t, next.changes[i], i + 1 == next.changes.size() ? ack : std::nullopt);
    held_.push_back(held_for(std::move(next)));
    return;
  }
  if (held_.empty()) {
    tell(t, next);
    return;
  }
  // What is said now may rest on a plan that is not on the disk: it waits too.
  auto& waiting = held_.back().reaction;
  if (waiting.messages.size() + next.messages.size() > max_held_messages) {
    counts_.held_dropped += next.messages.size();
    return;
  }
  waiting.messages.insert(waiting.messages.end(), next.messages.begin(), next.messages.end());
  waiting.texts.insert(waiting.texts.end(), next.texts.begin(), next.texts.end());
}

core::held core::held_for(mission_server::reaction&& next) const {
  held result{next_ticket_ - 1, std::move(next)};
  for (const auto& each : result.reaction.changes) {
    result.is_clear = result.is_clear || each.kind == mission_server::plan_change_kind::cleared;
    if (has_executor_)
      result.verdicts.push_back({each.type, each.plan_id});
  }
  return result;
}

// A station that waits for the answer says it again: it hears that of the first.
bool core::repeats_clear(const mission_server::reaction& next) const {
  const auto is_clear = [](const mission_server::plan_change& each) {
    return each.kind == mission_server::plan_change_kind::cleared;
  };
  if (held_.empty() || !held_.back().is_clear || !std::ranges::all_of(next.changes, is_clear))
    return false;
  const auto waits = ack_in(held_.back().reaction);
  const auto again = ack_in(next);
  return waits && again && waits->target_system == again->target_system &&
         waits->target_component == again->target_component && waits->mission_type == again->mission_type;
}

void core::note_change(decision_context& t, const mission_server::plan_change& change,
                       std::optional<mavlink::mission_ack> ack) {
  plan_noted event;
  event.ticket = next_ticket_++;
  event.type = change.type;
  event.plan_id = change.plan_id;
  event.items = keep(server_->plan(change.type).items);
  event.by = {change.by.system, change.by.component};
  event.ack = ack;
  if (change.type == mav_mission_type::mission) {
    if (change.marked_current)
      event.start_item = static_cast<std::uint16_t>(*change.marked_current);
    noted_start_item_ = event.start_item;
  }
  ++waiting_for_disk_;
  t.note(std::move(event));
}

void core::tell(decision_context& t, const mission_server::reaction& what) {
  for (const auto& each : what.messages)
    std::visit([&](const auto& m) { t.send(mavlink::sender{m.target_system, m.target_component}, m); }, each);
  for (const auto& each : what.texts)
    t.say(static_cast<mav_severity>(each.severity), each.text);
}

effects core::on_durable(const plan_resolved& m, instant now) {
  decision_context t(*this, now);
  if (!is_of_this_life(m.ticket)) {
    // The station has not been answered, unless it was between the answer and the crash.
    if (m.ack && now.wall_ns - m.at_ns < answer_is_worth_ns)
      answer_late(t, m);
    finish(t);
    return std::move(t.done);
  }
  note_on_disk();
  for (auto& each : held_)
    if (each.ticket == m.ticket)
      each.on_disk_ns = now.monotonic_ns;
  if (held_.empty())
    show_plans(); // of the executor's: no station waits for it
  tell_judged(t);
  finish(t);
  return std::move(t.done);
}

// Of an earlier life. The executor may have judged it by now; else it does, or the station hears that nobody knows.
void core::answer_late(decision_context& t, const plan_resolved& m) {
  if (!has_executor_)
    return t.send(mavlink::sender{m.ack->target_system, m.ack->target_component}, *m.ack);
  held late{m.ticket, {}};
  late.reaction.messages.emplace_back(*m.ack);
  late.verdicts.push_back({m.type, m.plan_id});
  late.is_clear = m.plan_id == 0;
  late.on_disk_ns = t.now.monotonic_ns;
  if (const auto judged = std::exchange(unawaited_verdict_, std::nullopt))
    (void)take_verdict(late.verdicts, *judged);
  held_.push_back(std::move(late));
  tell_judged(t);
}

effects core::on_plan_judged(const plan_judged& m, instant now) {
  decision_context t(*this, now);
  if (std::ranges::none_of(held_, [&](held& each) { return take_verdict(each.verdicts, m); }))
    unawaited_verdict_ = m;
  tell_judged(t);
  finish(t);
  return std::move(t.done);
}

bool core::held::is_judged() const {
  return std::ranges::all_of(verdicts, [](const awaited_verdict& each) { return each.verdict.has_value(); });
}

std::optional<plan_verdict> core::held::worst() const {
  if (!is_judged())
    return std::nullopt;
  for (const auto bad : {plan_verdict::refused, plan_verdict::failed})
    if (std::ranges::any_of(verdicts, [&](const awaited_verdict& each) { return each.verdict == bad; }))
      return bad;
  return plan_verdict::taken;
}

std::int64_t core::held::judged_by_ns() const {
  const bool is_brought = std::ranges::any_of(verdicts, [](const awaited_verdict& each) { return each.is_brought; });
  return on_disk_ns.value_or(0) + (is_brought ? brought_within_ns : is_clear ? cleared_within_ns : judged_within_ns);
}

// In order: what is on the disk, and judged where the executor has to say what became of it.
void core::tell_judged(decision_context& t) {
  while (!held_.empty() && held_.front().on_disk_ns) {
    auto& next = held_.front();
    if (!next.is_judged() && t.now.monotonic_ns < next.judged_by_ns())
      return;
    auto waits = std::move(next);
    held_.pop_front();
    tell_verdict(t, waits);
    if (held_.empty())
      show_plans();
    tell(t, waits.reaction);
  }
}

// Where it is refused, the plan from before is still the one, and the station hears so. Without an answer nobody knows:
// what is here stays.
void core::tell_verdict(decision_context& t, held& what) {
  const auto verdict = what.worst();
  for (const auto& each : what.reaction.changes)
    if (each.type == mav_mission_type::mission)
      tell_audit(t, each.by, what.is_clear ? "Clear" : "Upload",
                 verdict ? std::string(io::name_of(*verdict)) : "unknown", {});
  if (verdict == plan_verdict::taken)
    return;
  const bool is_refused = verdict == plan_verdict::refused;
  for (auto& each : what.reaction.messages)
    if (auto* const ack = std::get_if<mavlink::mission_ack>(&each)) {
      ack->type =
          mavlink::number(is_refused ? mavlink::mav_mission_result::denied : mavlink::mav_mission_result::error);
      ack->opaque_id = 0;
    }
  if (!verdict)
    t.say(mav_severity::warning, std::string(what.is_clear ? "Clear" : "Upload") + ": the executor does not answer");
  if (is_refused)
    ++counts_.plans_refused;
  for (const auto& each : what.verdicts)
    if (each.verdict == plan_verdict::refused)
      take_back(t, each);
}

void core::take_back(decision_context& t, const awaited_verdict& refused) {
  const auto type = refused.type;
  if (!held_.empty() || server_->is_receiving() || server_->plan(type).id != refused.plan_id)
    return; // another one has taken its place already
  server_->put_plan(type, resolved_[place_of(type)]);
  ++waiting_for_disk_;
  plan_noted event;
  event.ticket = next_ticket_++;
  event.type = type;
  event.plan_id = server_->plan(type).id;
  event.items = keep(server_->plan(type).items);
  event.from_executor = true;
  t.note(std::move(event));
}

void core::note_on_disk() {
  GODWIT_ASSERT(waiting_for_disk_ > 0, "what was noted is settled once");
  if (--waiting_for_disk_ == 0)
    start_item_ = noted_start_item_;
}

void core::show_plans() {
  for (const auto type : all_types) {
    const auto& plan = server_->plan(type);
    shown_[place_of(type)] = {plan.id, plan.items.size()};
    resolved_[place_of(type)] = plan.items;
  }
}

effects core::on_set_mission(const set_mission& m, instant now) {
  decision_context t(*this, now);
  if (m.items.size() > static_cast<std::size_t>(settings_.max_items)) {
    t.say(mav_severity::error, "The mission is too long for this port to show it");
  } else {
    server_->put_plan(mav_mission_type::mission, m.items);
    const auto& plan = server_->plan(mav_mission_type::mission);
    noted_start_item_.reset();
    ++waiting_for_disk_;
    plan_noted event;
    event.ticket = next_ticket_++;
    event.plan_id = plan.id;
    event.items = keep(plan.items);
    event.from_executor = true;
    t.note(std::move(event));
  }
  finish(t);
  return std::move(t.done);
}

// -- progress -------------------------------------------------------------------------------------

bool core::is_running() const {
  const auto& mission = shown_[place_of(mav_mission_type::mission)];
  return progress_ && mission.items != 0 && progress_->plan_id == mission.id &&
         progress_->state == mission_state::active;
}

mavlink::mission_current core::current() const {
  const auto& mission = shown_[place_of(mav_mission_type::mission)];
  mavlink::mission_current result;
  result.mission_id = mission.id;
  result.fence_id = shown_[place_of(mav_mission_type::fence)].id;
  result.rally_points_id = shown_[place_of(mav_mission_type::rally)].id;
  if (mission.items == 0) {
    result.total = no_mission_total;
    result.mission_state = mavlink::number(mission_state::no_mission);
    return result;
  }
  const bool is_known = progress_ && progress_->plan_id == mission.id;
  const auto state = is_known ? progress_->state : mission_state::not_started;
  const bool is_under_way = state == mission_state::active || state == mission_state::paused;
  auto seq = is_known ? progress_->current : std::uint16_t{0};
  if (start_item_ && state != mission_state::active)
    seq = *start_item_;
  result.total = static_cast<std::uint16_t>(mission.items);
  result.seq = std::min(seq, static_cast<std::uint16_t>(mission.items - 1));
  result.mission_state = mavlink::number(start_item_ && !is_under_way ? mission_state::not_started : state);
  result.mission_mode = mavlink::number(is_known ? progress_->mode : mavlink::mission_mode::unknown);
  return result;
}

// -- the current item -----------------------------------------------------------------------------

void core::take(decision_context& t, station& from, const mavlink::mission_set_current& m) {
  if (is_for_us(m.target_system, m.target_component))
    choose_current(t, {std::nullopt, from.who, m.seq});
  else
    ++counts_.not_for_us;
}

void core::refuse_current(decision_context& t, const set_current_request& set_current, mav_result result,
                          const std::string& text) {
  ++counts_.commands_refused;
  if (set_current.by_command)
    answer(t, *set_current.by_command, result);
  if (!text.empty())
    t.say(mav_severity::warning, text);
}

void core::choose_current(decision_context& t, const set_current_request& set_current) {
  const auto& mission = shown_[place_of(mav_mission_type::mission)];
  if (set_current.index >= mission.items) {
    refuse_current(t, set_current, mav_result::denied,
                   "Set current: there is no item " + std::to_string(set_current.index));
    return;
  }
  if (const auto objection = object_to(t, set_current.from, "Set current")) {
    refuse_current(t, set_current, objection->result, "Set current: " + objection->why);
    return;
  }
  if (!held_.empty() || is_busy_with_disk()) {
    refuse_current(t, set_current, mav_result::temporarily_rejected, "Set current: a plan is being stored");
    return;
  }
  if (set_current_) {
    const bool is_same = set_current_->from == set_current.from && set_current_->index == set_current.index;
    refuse_current(t, set_current, is_same ? mav_result::in_progress : mav_result::temporarily_rejected,
                   is_same ? "" : "Set current: another item was just asked for");
    return;
  }
  if (static_cast<mission_state>(current().mission_state) != mission_state::active) {
    if (start_item_ == set_current.index) { // nothing to write
      if (set_current.by_command)
        answer(t, *set_current.by_command, mav_result::accepted);
      t.send(io::link::every_peer, current());
      return;
    }
    noted_start_item_ = set_current.index;
    ++waiting_for_disk_;
    start_item_noted event{next_ticket_++, set_current.index, std::nullopt};
    if (set_current.by_command)
      event.ack = vehicle_role::answer_to(*set_current.by_command, mav_result::accepted);
    t.note(std::move(event));
    return;
  }
  if (!has_executor_) {
    refuse_current(t, set_current, mav_result::temporarily_rejected, "Set current: no executor is there");
    return;
  }
  set_current_ = set_current;
  t.done.emplace_back(start_request_to_executor{
      ++set_current_id_, {set_current.index, mission.id, {set_current.from.system, set_current.from.component}}});
}

effects core::on_durable(const start_item_resolved& m, instant now) {
  decision_context t(*this, now);
  if (is_of_this_life(m.ticket))
    note_on_disk();
  if (m.ack && now.wall_ns - m.at_ns < answer_is_worth_ns)
    t.send(mavlink::sender{m.ack->target_system, m.ack->target_component}, *m.ack);
  finish(t);
  return std::move(t.done);
}

effects core::on_current_answer(std::uint64_t request, const executor::current_answer& m, instant now) {
  decision_context t(*this, now);
  if (request == set_current_id_ && set_current_)
    end_set_current(t, result_for(m.verdict),
                    m.verdict == current_verdict::going ? ""
                                                        : "Set current: " + (m.reason.empty() ? "refused" : m.reason));
  finish(t);
  return std::move(t.done);
}

effects core::on_current_failed(std::uint64_t request, const std::string& reason, instant now) {
  decision_context t(*this, now);
  if (request == set_current_id_ && set_current_)
    end_set_current(t, mav_result::temporarily_rejected, "Set current: " + reason);
  finish(t);
  return std::move(t.done);
}

void core::end_set_current(decision_context& t, mav_result result, const std::string& text) {
  const auto set_current = *std::exchange(set_current_, std::nullopt);
  tell_audit(t, set_current.from, "Set current", result == mav_result::accepted ? "taken" : "refused", text);
  if (result != mav_result::accepted) {
    refuse_current(t, set_current, result, text);
    return;
  }
  if (set_current.by_command)
    answer(t, *set_current.by_command, result);
}

} // namespace godwit::ground_port
