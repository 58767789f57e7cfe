#include "actors/executor/task_runner.hpp"

#include <algorithm>
#include <utility>

#include "actors/domain/control_authority/mode_tables.hpp"
#include "actors/domain/home/home.hpp"
#include "actors/executor/announced_modes.hpp"
#include "actors/executor/plan/vehicle_items.hpp"
#include "actors/executor/plan_proof.hpp"
#include "actors/executor/remaining.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::executor {
namespace {

using io::mavlink::mav_cmd;
using io::mavlink::mav_result;
using io::mavlink::number;
using vehicle_link::command_verdict;
namespace transfer = vehicle_link::transfer;

// Nothing goes out in these modes: whoever is seen in one is somebody else.
void withdraw_announced(const task_runner::world& w, std::vector<std::uint32_t> modes) {
  if (!modes.empty())
    w.out.emplace_back(say_to_failsafe{failsafe::expect_mode{std::move(modes), 0, true}});
}

// No order of ours brings the vehicle into these modes any more.
void withdraw(const task_runner::world& w, const std::vector<std::uint32_t>& modes) {
  w.authority.withdraw(modes);
  withdraw_announced(w, modes);
}

progress::start_intended start_at(const vehicle_view& view, std::uint16_t sequence) {
  return {sequence, view.says_incomplete(), !view.current() || view.current()->seq > sequence};
}

// The vehicle has looked at it and will not have it: to ask again the same would be answered the same.
bool is_final(const vehicle_link::command_outcome& outcome) {
  if (outcome.verdict == command_verdict::invalid)
    return true;
  return outcome.verdict == command_verdict::refused &&
         (outcome.result == number(mav_result::denied) || outcome.result == number(mav_result::unsupported));
}

} // namespace

flight::plan_end end_of_plan(const flight::mode_owner& whose, const state& s) {
  const auto* const last = last_flown_item(s);
  return last == nullptr || !plan::is_nav(*last) ? flight::plan_end{}
                                                 : flight::plan_end_of(whose, last->command, last->seq);
}

// -- a task -----------------------------------------------------------------------------------------

void task_runner::begin(const task& what, steps way, std::optional<progress::upload_intended> intent) {
  task_ = what;
  way_ = std::move(way);
  at_ = 0;
  intent_ = std::move(intent);
  tries_ = 0;
  outdated_ = 0;
  must_ask_ = false;
  is_intent_noted_ = false;
  has_armed_ = false;
  armed_ns_ = 0;
  begin_looking();
  looked_after_ns_ = 0;
  was_starved_ = false;
  was_infeasible_ = false;
  judged_.reset();
  ended_.reset();
  why_failed_.clear();
  enter(stage::begin);
}

// An intent that was noted has an end, too. That of a transfer under way comes with its outcome.
void task_runner::drop(const world& w) {
  if (!task_)
    return;
  const bool is_open = is_intent_noted_ && !ended_ && at_ < way_.size() && stage_ != stage::closing;
  if (is_open && !std::holds_alternative<bring_plan>(way_[at_]))
    w.out.emplace_back(note{progress::start_ended{false}});
  else if (is_open && stage_ == stage::asked)
    w.out.emplace_back(give_up_transfer{});
  else if (is_open && stage_ == stage::judging)
    w.out.emplace_back(note{end_of_upload(w.view)});
  else if (is_open && stage_ != stage::resolving)
    w.out.emplace_back(note{uploads_.end_unsent("it was given up")});
  if (!ended_ && at_ < way_.size() && std::holds_alternative<guard>(way_[at_]))
    withdraw_announced(w, announced_modes(task_->kind, way_, at_, w.view.owner()));
  task_.reset();
}

void task_runner::enter(stage next, std::int64_t deadline_ns) {
  stage_ = next;
  deadline_ns_ = deadline_ns;
}

void task_runner::next_step() {
  ++at_;
  tries_ = 0;
  outdated_ = 0;
  must_ask_ = false;
  is_intent_noted_ = false;
  begin_looking();
  enter(stage::begin);
}

// Nothing that was seen for the step before counts for this one.
void task_runner::begin_looking() {
  looked_ns_ = 0;
  next_look_ns_ = never_ns;
  unseen_ = 0;
  proving_since_ns_ = 0;
  is_moving_ = false;
}

void task_runner::fail(std::string why) {
  why_failed_ = std::move(why);
  ended_ = verdict::failed;
}

task_runner::verdict task_runner::advance(const world& w) {
  if (!task_)
    return verdict::idle;
  look_at_time(w);
  go_on_behind_note();
  while (!ended_) {
    if (at_ == way_.size()) {
      ended_ = verdict::done;
      break;
    }
    const auto before = std::pair(at_, stage_);
    if (stage_ == stage::begin)
      begin_step(w);
    else if (stage_ == stage::showing && is_shown(w))
      was_obeyed(w);
    else if (stage_ == stage::showing && w.now_ns >= deadline_ns_)
      was_not_done(w, last_reason_.empty() ? "the vehicle does not show it" : last_reason_, false);
    else if (stage_ == stage::showing && w.now_ns >= next_look_ns_)
      look(w);
    else if (stage_ == stage::looking && w.now_ns >= deadline_ns_)
      was_not_seen(w, "vehicle_link did not answer");
    else if (stage_ == stage::pausing && w.now_ns >= deadline_ns_)
      enter(stage::begin);
    else if (stage_ == stage::judging)
      judge_upload(w);
    else if (stage_ == stage::resolving)
      resolve_upload(w);
    if (before == std::pair(at_, stage_))
      break;
  }
  if (!ended_)
    return verdict::under_way;
  task_.reset();
  return *ended_;
}

std::int64_t task_runner::next_deadline_ns() const {
  return task_ ? std::min(deadline_ns_, stage_ == stage::showing ? next_look_ns_ : never_ns) : never_ns;
}

// -- a step -----------------------------------------------------------------------------------------

bool task_runner::has_intent() const {
  const auto& what = way_[at_];
  return std::holds_alternative<bring_plan>(what) || std::holds_alternative<set_current_item>(what) ||
         std::holds_alternative<start_plan>(what);
}

bool task_runner::is_shown(const world& w) const {
  const auto& view = w.view;
  const auto& what = way_[at_];
  if (const auto* mode = std::get_if<change_mode>(&what))
    return view.obeys(mode->to) && (tries_ == 0 ? !must_ask_ : view.heartbeats() > asked_at_heartbeat_);
  if (std::holds_alternative<await_arming>(what))
    return view.is_in(flight::mode_kind::mission) && !view.is_armed();
  if (std::holds_alternative<stand_by>(what)) {
    const auto status = flight::standing_mode(view.owner());
    return status && view.is_in_one_of({*status});
  }
  if (std::holds_alternative<set_home>(what) || std::holds_alternative<free_home>(what))
    return tries_ > 0 && was_accepted_;
  if (std::holds_alternative<see_home>(what))
    return tries_ > 0 && view.home_heard_ns() > asked_ns_ && w.durable.home &&
           flight::is_same_home(plan::place_of(*view.home()), w.durable.home->at);
  if (std::holds_alternative<arm>(what))
    return view.is_armed();
  if (std::holds_alternative<disarm>(what))
    return !view.is_armed();
  if (const auto* item = std::get_if<set_current_item>(&what))
    return view.current() && view.current_heard_ns() > asked_ns_ &&
           view.current()->seq >= (item->anew ? 0 : item->sequence) &&
           (item->total == 0 || view.current()->total == 0 || view.current()->total == item->total);
  // A plan that begins with its end may be there before it was seen in its mode.
  const bool is_at_end = tries_ > 0 && was_accepted_ && w.authority.who() == flight::holder::autopilot_end;
  return std::holds_alternative<start_plan>(what) && (is_start_shown(view) || (view.is_armed() && is_at_end));
}

// A vehicle that was in its mission mode before (a rover that holds there) shows by its mission alone that a start
// whose answer was lost came through. One that was there already, at the only item of its plan, is through with it
// before it was seen in its mode.
bool task_runner::is_start_shown(const vehicle_view& view) const {
  using io::mavlink::mission_state;
  const auto says = [&](mission_state state) {
    return view.current() && view.current_heard_ns() > asked_ns_ && view.current()->mission_state == number(state);
  };
  const bool is_in_mission = view.is_armed() && view.is_in(flight::mode_kind::mission);
  if (!is_in_mission)
    return was_accepted_ && view.is_armed() && says(mission_state::complete);
  return !was_in_mission_before_ || was_accepted_ || says(mission_state::active);
}

void task_runner::begin_step(const world& w) {
  const bool begins_anew =
      std::holds_alternative<start_plan>(way_[at_]) || std::holds_alternative<set_current_item>(way_[at_]);
  if (is_shown(w) && (!begins_anew || tries_ > 0))
    return was_obeyed(w);
  if (const auto why = why_not_now(w.view); !why.empty())
    return fail(why);
  if (is_too_late_to_move())
    return end_too_late(w);
  const auto allowed = may_send(intended(w), w.authority, w.seen, w.now_ns);
  if (allowed == permission::not_ours || allowed == permission::wait) // the watch ends it, or goes on with it
    return enter(stage::pausing, w.now_ns + until_heartbeat_ns);
  if (allowed == permission::prove)
    return prove_plan(w);
  if (has_intent() && !is_intent_noted_) {
    is_intent_noted_ = true;
    if (const auto* item = std::get_if<set_current_item>(&way_[at_]))
      return note_and_wait(w, start_at(w.view, item->sequence));
    if (const auto* start = std::get_if<start_plan>(&way_[at_]))
      return note_and_wait(w, start_at(w.view, start->sequence));
    return note_and_wait(w, *intent_);
  }
  if (allowed == permission::look) {
    enter(stage::looking, w.now_ns + look_within_ns);
    return look(w);
  }
  ask(w);
}

// An order that moves the vehicle, or lets it move when somebody arms it.
bool task_runner::moves(const world& w) const {
  using flight::mode_kind;
  const auto& what = way_[at_];
  if (const auto* mode = std::get_if<change_mode>(&what))
    return mode->to == mode_kind::mission || mode->to == mode_kind::guided || mode->to == mode_kind::returning;
  const bool flies_plan = w.view.is_armed() && w.view.is_in(mode_kind::mission);
  if (std::holds_alternative<set_current_item>(what))
    return flies_plan; // else it only says where to go on
  if (std::holds_alternative<bring_plan>(what))
    return flies_plan && w.durable.status.in_flight; // PX4 flies it at once
  return std::holds_alternative<arm>(what) || std::holds_alternative<await_arming>(what) ||
         std::holds_alternative<start_plan>(what);
}

intended_order task_runner::intended(const world& w) const {
  intended_order result;
  const auto& what = way_[at_];
  if (is_stop() || std::holds_alternative<stand_by>(what))
    result.kind = order_kind::stops;
  else if (moves(w))
    result.kind = order_kind::moves;
  const auto* mode = std::get_if<change_mode>(&what);
  result.flies_plan = result.kind == order_kind::moves && !std::holds_alternative<bring_plan>(what) &&
                      (mode == nullptr || mode->to == flight::mode_kind::mission);
  result.looked_ns = looked_ns_;
  result.proof_from_ns = w.now_ns - proof_counts_ns;
  // A vehicle without plan ids is read before it is armed: one that stands armed for as long may disarm itself.
  const auto& plan = w.durable.progress.plan;
  if (std::holds_alternative<start_plan>(what) && armed_ns_ != 0 && plan && !plan->vehicle_plan_id)
    result.proof_from_ns = armed_ns_ - proof_counts_ns;
  return result;
}

void task_runner::prove_plan(const world& w) {
  const auto& plan = w.durable.progress.plan;
  if (!plan || !w.durable.flown)
    return end_step(w, "it is not known which plan the vehicle should hold");
  if (proving_since_ns_ == 0)
    proving_since_ns_ = w.now_ns;
  read_since_ns_ = w.now_ns;
  enter(stage::proving);
  w.out.emplace_back(order{goes::at_once, ++last_order_, w.now_ns, {}, proof_request(*plan)});
}

void task_runner::on_read(const world& w, const transfer::outcome& outcome) {
  const auto items = static_cast<std::int64_t>(w.durable.flown ? w.durable.flown->items.size() : 0);
  const auto is_read = outcome.verdict == transfer::verdict::accepted;
  const auto is_ours = is_read && holds_flown_plan(w.durable, outcome, w.view.owner());
  if (is_ours)
    w.seen.plan.prove(read_since_ns_, w.now_ns);
  if (is_ours && w.seen.plan.is_proved())
    return enter(stage::begin);
  if (is_ours || !is_read) {
    if (w.now_ns - proving_since_ns_ < proof_within_ns + items * proof_item_ns)
      return enter(stage::pausing, w.now_ns + prove_again_ns);
    const auto why = is_read ? "somebody else goes on sending it plans" : outcome.reason;
    return end_step(w, "it could not be proved that the vehicle holds godwit's plan (" + why + "); nothing is started");
  }
  w.seen.plan.forget();
  w.out.emplace_back(note{progress::other_plan_found{}});
  end_step(w, "the vehicle holds a plan that is not godwit's");
}

void task_runner::look(const world& w) {
  next_look_ns_ = never_ns;
  w.out.emplace_back(order{goes::at_once, ++last_order_, w.now_ns, {}, vehicle_link::look{}});
}

void task_runner::on_looked(const world& w, std::uint64_t number, const vehicle_link::looked& what) {
  if (!task_ || ended_ || number != last_order_)
    return;
  if (stage_ == stage::showing)
    next_look_ns_ = w.now_ns + look_again_ns;
  if (stage_ != stage::looking)
    return;
  if (what.is_seen) {
    looked_ns_ = what.at_ns;
    return enter(stage::begin);
  }
  was_not_seen(w, what.reason);
}

void task_runner::was_not_seen(const world& w, const std::string& why) {
  if (++unseen_ >= max_looks)
    return end_step(w, "the vehicle can not be looked at before it is moved: " + why);
  enter(stage::pausing, w.now_ns + look_again_ns);
}

// Before its order has gone out.
void task_runner::end_step(const world& w, std::string why) {
  was_refused_for_now_ = false;
  if (!has_intent() || !is_intent_noted_)
    return fail(std::move(why));
  last_reason_ = why;
  why_failed_ = std::move(why);
  if (std::holds_alternative<bring_plan>(way_[at_])) {
    if (tries_ == 0)
      uploads_.begin(w.now_ns);
    note_and_wait(w, uploads_.end_unsent(why_failed_));
  } else {
    note_and_wait(w, progress::start_ended{false});
  }
  enter(stage::closing);
}

// Before each send. PX4 arms by itself when it is started, and whoever has armed a vehicle that stood flies it. What
// was disarmed in its flight stays where it is: a start alone changes the mode of a vehicle that it arms then.
std::string task_runner::why_not_now(const vehicle_view& view) const {
  const auto* mode = std::get_if<change_mode>(&way_[at_]);
  const bool goes_on = mode != nullptr && task_->kind != task_kind::start && !is_stop() &&
                       (mode->to == flight::mode_kind::mission || mode->to == flight::mode_kind::guided);
  if ((goes_on || std::holds_alternative<start_plan>(way_[at_])) && !view.is_armed())
    return "the vehicle is disarmed";
  const auto* status = std::get_if<stand_by>(&way_[at_]);
  const bool needs_disarmed = std::holds_alternative<await_arming>(way_[at_]) ||
                              std::holds_alternative<clear_plan>(way_[at_]) || (status != nullptr && !status->is_armed);
  return needs_disarmed && view.is_armed() ? "it was armed meanwhile" : "";
}

void task_runner::look_at_time(const world& w) {
  was_starved_ = was_starved_ || (looked_after_ns_ != 0 && w.now_ns - looked_after_ns_ > starved_ns);
  looked_after_ns_ = w.now_ns;
}

// What lets a vehicle move that stood, or was held by a word.
bool task_runner::is_too_late_to_move() const {
  const auto kind = task_->kind;
  const bool lets_move = kind == task_kind::start || kind == task_kind::resume || kind == task_kind::await_arming;
  return was_starved_ && lets_move && !std::holds_alternative<guard>(way_[at_]);
}

void task_runner::end_too_late(const world& w) {
  end_step(w, "godwit stood still for more than a second; a person has to repeat the command");
}

void task_runner::note_and_wait(const world& w, durable_core::event what) {
  w.out.emplace_back(note{std::move(what)});
  enter(stage::noting);
}

// The note of the call before is applied.
void task_runner::go_on_behind_note() {
  if (stage_ == stage::noting)
    enter(stage::begin);
  else if (stage_ == stage::closing && std::holds_alternative<bring_plan>(way_[at_]))
    enter(stage::resolving);
  else if (stage_ == stage::closing && why_failed_.empty())
    next_step();
  else if (stage_ == stage::closing)
    ended_ = verdict::failed;
}

void task_runner::ask(const world& w) {
  ++tries_;
  last_reason_.clear();
  why_failed_.clear();
  asked_ns_ = w.now_ns;
  generation_before_ = w.durable.progress.last_generation; // an intent is noted: only its end opens another one
  is_moving_ = !is_stop() && moves(w);
  asked_at_heartbeat_ = w.view.heartbeats();
  was_in_mission_before_ = w.view.is_armed() && w.view.is_in(flight::mode_kind::mission);
  was_accepted_ = false;
  was_refused_for_now_ = false;
  was_lost_ = false;
  enter(stage::asked);
  std::visit([&](const auto& what) { ask(w, what); }, way_[at_]);
}

// Nothing that lets the vehicle go on is sent before its reason is on the disk; a stop does not wait for that.
goes task_runner::urgency() const {
  const auto kind = task_->kind;
  const auto* mode = at_ < way_.size() ? std::get_if<change_mode>(&way_[at_]) : nullptr;
  if (kind == task_kind::come_home_by_plan && mode != nullptr && mode->to == flight::mode_kind::hold)
    return goes::at_once;
  return kind == task_kind::hold || kind == task_kind::come_home || kind == task_kind::stand_down ? goes::at_once
                                                                                                  : goes::after_notes;
}

bool task_runner::has_asked_to_start() const {
  return task_ && at_ < way_.size() && tries_ > 0 && std::holds_alternative<start_plan>(way_[at_]);
}

permission task_runner::may_go_out(const world& w) const {
  if (at_ >= way_.size() || !why_not_now(w.view).empty())
    return permission::not_ours;
  return may_send(intended(w), w.authority, w.seen, w.now_ns);
}

bool task_runner::awaits(std::uint64_t order) const {
  const bool is_out = stage_ == stage::asked || stage_ == stage::proving || stage_ == stage::looking;
  return task_ && !ended_ && is_out && order == last_order_;
}

// It goes out at once, and is said again as soon as it seems lost.
bool task_runner::is_stop() const { return urgency() == goes::at_once && task_->kind != task_kind::stand_down; }

void task_runner::on_command(const world& w, std::uint64_t number, const vehicle_link::command_outcome& outcome) {
  if (!task_ || ended_ || number != last_order_ || stage_ != stage::asked)
    return;
  last_reason_ = outcome.reason;
  looked_ns_ = 0; // whatever goes out next is looked at anew
  was_lost_ = outcome.verdict == command_verdict::timed_out;
  const bool may_have_acted =
      outcome.verdict == command_verdict::accepted || outcome.verdict == command_verdict::timed_out;
  was_refused_for_now_ = outcome.verdict == command_verdict::refused && !is_final(outcome);
  // A look asks for a message, too: what asks for another one waits for its answer.
  const bool is_unsent =
      outcome.verdict == command_verdict::outdated || outcome.verdict == command_verdict::already_running;
  if (is_unsent && was_outdated(w))
    return;
  if (!may_have_acted)
    return was_not_done(w, outcome.reason, is_final(outcome));
  has_armed_ = has_armed_ || std::holds_alternative<arm>(way_[at_]);
  const bool goes_on_at_once = w.view.is_in(flight::mode_kind::mission);
  if (outcome.verdict == command_verdict::accepted && std::holds_alternative<set_current_item>(way_[at_]) &&
      goes_on_at_once)
    return was_obeyed(w);
  was_accepted_ = outcome.verdict == command_verdict::accepted;
  if (!was_accepted_ && is_stop() && !is_shown(w)) // lost, as far as anybody can tell
    return enter(stage::showing, w.now_ns);
  if (is_moving_)
    next_look_ns_ = w.now_ns;
  const auto not_moving_ns = was_accepted_ ? again_after_ns : lost_after_ns;
  enter(stage::showing, w.now_ns + (is_moving_ ? shown_within_ns : not_moving_ns));
}

// It has not gone out: that was no try, and nothing comes of it. True: it is judged anew with the heartbeat that is on
// its way here.
bool task_runner::was_outdated(const world& w) {
  withdraw(w, std::exchange(last_expected_, {}));
  if (++outdated_ >= max_tries_of_lost)
    return false;
  --tries_;
  enter(stage::pausing, w.now_ns + until_heartbeat_ns);
  return true;
}

void task_runner::on_guarded(const world& w, std::uint64_t number, const std::string& refused, bool is_final) {
  if (!task_ || ended_ || number != last_order_ || stage_ != stage::asked)
    return;
  if (refused.empty())
    return was_obeyed(w);
  if (!is_final && tries_ < max_tries)
    return enter(stage::pausing, w.now_ns + pause_between_ns);
  withdraw_announced(w, announced_modes(task_->kind, way_, at_, w.view.owner()));
  fail("the failsafe does not watch over this flight: " + refused);
}

void task_runner::was_obeyed(const world& w) {
  if (!has_intent())
    return next_step();
  note_and_wait(w, progress::start_ended{true});
  enter(stage::closing);
}

void task_runner::was_not_done(const world& w, const std::string& why, bool is_final) {
  const bool was_refused = stage_ == stage::asked;
  const bool may_ask_again = was_refused || !is_moving_; // what may have moved the vehicle is not said twice
  if (!is_final && may_ask_again && tries_ < (is_stop() || was_lost_ ? max_tries_of_lost : max_tries))
    return was_refused ? enter(stage::pausing, w.now_ns + pause_between_ns) : enter(stage::begin);
  const auto warned = w.view.warned_since(asked_ns_);
  const auto sentence = "the vehicle was asked " + what_is_asked() + ", and did not: " + why +
                        (warned.empty() ? "" : "; it says \"" + warned + "\"");
  if (const auto* mode = std::get_if<change_mode>(&way_[at_])) // late, it can not be told from a person's
    withdraw(w, flight::modes_obeying(w.view.owner(), mode->to));
  if (!has_intent())
    return fail(sentence);
  why_failed_ = sentence;
  note_and_wait(w, progress::start_ended{false});
  enter(stage::closing);
}

} // namespace godwit::executor
