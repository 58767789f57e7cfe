// The part of the core that is about plans. Their progress and the current item: core_current.cpp.
#include <algorithm>
#include <string>
#include <utility>

#include "actors/ground_port/core.hpp"
#include "actors/ground_port/decision_context.hpp"
#include "io/mavlink/plan_meaning.hpp"
#include "runtime/assert.hpp"

namespace godwit::ground_port {

namespace {

using mavlink::mav_mission_type;
using mavlink::mav_severity;

constexpr std::array all_types{mav_mission_type::mission, mav_mission_type::fence, mav_mission_type::rally};

std::optional<mavlink::mission_ack> ack_in(const mission_server::reaction& of) {
  for (const auto& each : of.messages)
    if (const auto* ack = std::get_if<mavlink::mission_ack>(&each))
      return *ack;
  return std::nullopt;
}

// Of an ArduPilot, whose home is its item 0.
bool says_same_after_home(std::vector<mavlink::mission_item_int> a, std::vector<mavlink::mission_item_int> b) {
  if (a.empty() || a.size() != b.size())
    return false;
  a.erase(a.begin());
  b.erase(b.begin());
  return mavlink::checksum_of(a) == mavlink::checksum_of(b);
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
  auto server_profile = mission_server::plain_profile();
  server_profile.capacity = settings_.max_items;
  server_profile.also_takes = settings_.allowed_commands;
  server_profile.accepts = mission_server::accepted_address::component_0_too;
  server_profile.when_partial = mission_server::partial_list::taken;
  server_.emplace(server_profile, ourselves());
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
  result.texts_if_taken = std::exchange(result.reaction.texts, {});
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
    views_.note({event.by, event.items.empty() ? 0 : event.plan_id});
  }
  ++waiting_for_disk_;
  t.note(std::move(event));
}

// With its last item a station has the whole of it.
void core::note_download(const mission_server::reaction& what) {
  const auto& plan = server_->plan(mav_mission_type::mission);
  const auto has_it = [&]<class M>(const M& m) {
    if constexpr (M::message_id == mavlink::mission_count::message_id)
      return m.count == 0;
    else if constexpr (requires { m.seq, m.z; })
      return m.seq + std::size_t{1} == plan.items.size();
    else
      return false;
  };
  for (const auto& each : what.messages)
    std::visit(
        [&](const auto& m) {
          if (m.mission_type == mavlink::number(mav_mission_type::mission) && has_it(m))
            views_.note({{m.target_system, m.target_component}, plan.id});
        },
        each);
}

void core::tell(decision_context& t, const mission_server::reaction& what) {
  note_download(what);
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
  for (const auto bad : {plan_verdict::refused, plan_verdict::no_space, plan_verdict::failed})
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
  if (verdict == plan_verdict::taken) {
    for (const auto& each : what.texts_if_taken)
      t.say(static_cast<mav_severity>(each.severity), each.text);
    return;
  }
  const bool has_no_room = verdict == plan_verdict::no_space;
  const bool is_refused = verdict == plan_verdict::refused || has_no_room;
  using mavlink::mav_mission_result;
  const auto answer = has_no_room  ? mav_mission_result::no_space
                      : is_refused ? mav_mission_result::denied
                                   : mav_mission_result::error;
  for (auto& each : what.reaction.messages)
    if (auto* const ack = std::get_if<mavlink::mission_ack>(&each)) {
      ack->type = mavlink::number(answer);
      ack->opaque_id = 0;
    }
  if (!verdict)
    t.say(mav_severity::warning, std::string(what.is_clear ? "Clear" : "Upload") + ": the executor does not answer");
  if (is_refused)
    ++counts_.plans_refused;
  for (const auto& each : what.verdicts)
    if (each.verdict == plan_verdict::refused || each.verdict == plan_verdict::no_space)
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
  GODWIT_ASSERT(waiting_for_disk_ > 0, "what was noted is resolved once");
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
    const auto before = server_->plan(mav_mission_type::mission);
    server_->put_plan(mav_mission_type::mission, m.items);
    const auto& plan = server_->plan(mav_mission_type::mission);
    if (owner_.autopilot == mavlink::mav_autopilot::ardupilotmega && says_same_after_home(before.items, plan.items))
      views_.replace(before.id, plan.id);
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

} // namespace godwit::ground_port
