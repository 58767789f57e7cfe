#include "actors/executor/tasks/task_runner.hpp"

#include <algorithm>
#include <utility>

#include "actors/domain/control_authority/mode_tables.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::executor {
namespace {

using io::mavlink::mav_result;
using io::mavlink::number;
using vehicle_link::command_verdict;

// The vehicle will not do it: the same again would be answered the same.
bool is_final(const vehicle_link::command_outcome& outcome) {
  if (outcome.verdict == command_verdict::invalid)
    return true;
  return outcome.verdict == command_verdict::refused &&
         (outcome.result == number(mav_result::denied) || outcome.result == number(mav_result::unsupported));
}

// That it was accepted does not count: what it does it shows.
constexpr const char* not_shown = "does not show it";
constexpr const char* uncertain_hold =
    "no acknowledgement of godwit's hold came, and the vehicle holds: somebody may have stopped it; resume goes on";

progress::start_intended start_at(const vehicle_view& view, std::uint16_t sequence) {
  return {sequence, view.says_incomplete(), !view.current() || view.current()->seq > sequence};
}

} // namespace

// -- a task -----------------------------------------------------------------------------------------

void task_runner::begin(const task& what, steps way, std::optional<progress::upload_intended> intent) {
  task_ = what;
  way_ = std::move(way);
  at_ = 0;
  intent_ = std::move(intent);
  run_ns_ = 0;
  was_stalled_ = false;
  if (what.kind != task_kind::stand_down)
    armed_ns_ = 0;
  ended_.reset();
  why_failed_.clear();
  was_infeasible_ = false;
  unheard_.reset();
  judged_.reset();
  step_ = {};
  attempts_ = {};
  enter(stage::begin);
}

// An intent that was journalled has an end, too. That of a transfer under way comes with its outcome.
void task_runner::drop(const world& w) {
  if (!task_)
    return;
  const bool is_open = step_.is_intent_noted && !ended_ && at_ < way_.size() && stage_ != stage::closing;
  if (is_open && intent() != step_intent::upload)
    w.out.emplace_back(note{progress::start_ended{false}});
  else if (is_open && stage_ == stage::sent)
    w.out.emplace_back(give_up_transfer{});
  else if (is_open && stage_ == stage::judging)
    w.out.emplace_back(note{end_of_upload(w.view)});
  else if (is_open && stage_ != stage::resolving)
    w.out.emplace_back(note{uploads_.end_unsent("it was given up")});
  if (!ended_ && is_at<guard>())
    withdraw_announced(w);
  task_.reset();
}

void task_runner::enter(stage next, std::int64_t deadline_ns) {
  stage_ = next;
  deadline_ns_ = deadline_ns;
}

void task_runner::next_step() {
  ++at_;
  step_ = {};
  attempts_ = {};
  enter(stage::begin);
}

void task_runner::fail(std::string why) {
  why_failed_ = std::move(why);
  ended_ = verdict::failed;
}

task_runner::verdict task_runner::advance(const world& w) {
  if (!task_)
    return verdict::idle;
  watch_stall(w);
  on_noted();
  while (!ended_) {
    if (at_ == way_.size()) {
      ended_ = verdict::done;
      break;
    }
    const auto before = std::pair(at_, stage_);
    run_stage(w);
    if (before == std::pair(at_, stage_))
      break;
  }
  if (!ended_)
    return verdict::under_way;
  task_.reset();
  return *ended_;
}

// What is not here waits for an answer.
void task_runner::run_stage(const world& w) {
  const bool is_late = w.now_ns >= deadline_ns_;
  if (stage_ == stage::begin)
    begin_step(w);
  else if (stage_ == stage::confirming && is_done(w))
    succeed(w);
  else if (stage_ == stage::confirming && (is_late || (attempts_.lost_ns != 0 && is_heard_since(w))))
    retry_or_fail(w, last_reason_.empty() ? not_shown : last_reason_, is_return() && !is_heard_since(w));
  else if (stage_ == stage::confirming && w.now_ns >= step_.next_observation_ns)
    observe(w);
  else if (stage_ == stage::observing && is_late)
    on_unobserved(w, "vehicle_link did not answer");
  else if (stage_ == stage::pausing && is_late)
    enter(stage::begin);
  else if (stage_ == stage::judging)
    judge_upload(w);
  else if (stage_ == stage::resolving)
    resolve_upload(w);
}

std::int64_t task_runner::next_deadline_ns() const {
  if (!task_)
    return never_ns;
  return stage_ == stage::confirming ? std::min(deadline_ns_, step_.next_observation_ns) : deadline_ns_;
}

void task_runner::watch_stall(const world& w) {
  was_stalled_ = was_stalled_ || (run_ns_ != 0 && w.now_ns - run_ns_ > stall_limit_ns);
  run_ns_ = w.now_ns;
}

// It counts for what lets a vehicle move that stood, or was held by a command.
bool task_runner::has_stalled() const {
  const auto kind = task_->kind;
  const bool lets_move = kind == task_kind::start || kind == task_kind::resume || kind == task_kind::await_arming;
  return was_stalled_ && lets_move && !is_at<guard>();
}

// -- a step -----------------------------------------------------------------------------------------

void task_runner::begin_step(const world& w) {
  if (is_done(w))
    return succeed(w);
  if (const auto why = why_not_now(way_[at_], context(w)); !why.empty())
    return fail_unsent(w, why);
  if (has_stalled())
    return fail_unsent(
        w, "godwit stood still, or did not hear the vehicle, for more than a second; a person has to repeat the "
           "command");
  const auto allowed = may_send(intended(w), w.authority, w.seen, w.now_ns);
  if (allowed == permission::not_ours || allowed == permission::wait) // control_watch ends it, or continues it
    return enter(stage::pausing, w.now_ns + until_heartbeat_ns);
  if (allowed == permission::uncertain)
    return fail_unsent(w, uncertain_hold);
  if (allowed == permission::prove)
    return prove_plan(w);
  if (intent() != step_intent::none && !std::exchange(step_.is_intent_noted, true)) {
    generation_before_ = w.durable.progress.last_generation; // only the end of this intent opens another one
    if (const auto* item = std::get_if<set_current_item>(&way_[at_]))
      return note_and_wait(w, start_at(w.view, item->sequence));
    if (const auto* start = std::get_if<start_plan>(&way_[at_]))
      return note_and_wait(w, start_at(w.view, start->sequence));
    return note_and_wait(w, *intent_);
  }
  if (allowed == permission::look) {
    enter(stage::observing, w.now_ns + look_within_ns);
    return observe(w);
  }
  send(w);
}

void task_runner::note_and_wait(const world& w, durable_core::event what) {
  w.out.emplace_back(note{std::move(what)});
  enter(stage::noting);
}

// What the call before has journalled is applied.
void task_runner::on_noted() {
  if (stage_ == stage::noting)
    return enter(stage::begin);
  if (stage_ != stage::closing)
    return;
  if (intent() == step_intent::upload)
    enter(stage::resolving);
  else if (why_failed_.empty())
    next_step();
  else
    ended_ = verdict::failed;
}

void task_runner::succeed(const world& w) {
  if (intent() == step_intent::none)
    return next_step();
  note_and_wait(w, progress::start_ended{true});
  enter(stage::closing);
}

void task_runner::retry_or_fail(const world& w, const std::string& why, bool is_final) {
  const bool was_refused = stage_ == stage::sent;
  const bool may_send_again = was_refused || !attempts_.is_moving; // what may have moved the vehicle is sent once
  if (!is_final && may_send_again &&
      attempts_.tries < (is_stop() || attempts_.was_lost ? max_tries_of_lost : max_tries))
    return was_refused ? enter(stage::pausing, w.now_ns + pause_between_ns) : enter(stage::begin);
  const auto warned = w.view.warned_since(attempts_.sent_ns);
  const auto sentence = "the vehicle was asked " + description_of(way_[at_]) + ", and " +
                        (why == not_shown ? why : (attempts_.was_lost ? "gave " : "did not: ") + why) +
                        (warned.empty() ? "" : "; it reports \"" + warned + "\"");
  const auto mode = new_mode();
  if (mode && mode != flight::mode_kind::hold && !is_heard_since(w))
    unheard_ = task_->kind;
  else if (mode) // late, it can not be distinguished from a person's
    withdraw(w, flight::modes_obeying(w.view.owner(), *mode));
  if (intent() == step_intent::none)
    return fail(sentence);
  why_failed_ = sentence;
  note_and_wait(w, progress::start_ended{false});
  enter(stage::closing);
}

// Before its order has gone out.
void task_runner::fail_unsent(const world& w, std::string why) {
  was_refused_for_now_ = false;
  if (intent() == step_intent::none || !step_.is_intent_noted)
    return fail(std::move(why));
  last_reason_ = why;
  why_failed_ = std::move(why);
  if (intent() == step_intent::upload) {
    if (attempts_.tries == 0)
      uploads_.begin(w.now_ns);
    note_and_wait(w, uploads_.end_unsent(why_failed_));
  } else {
    note_and_wait(w, progress::start_ended{false});
  }
  enter(stage::closing);
}

// -- the answers ------------------------------------------------------------------------------------

bool task_runner::awaits(std::uint64_t order) const {
  const bool is_out = stage_ == stage::sent || stage_ == stage::proving || stage_ == stage::observing;
  return task_ && !ended_ && is_out && order == last_order_;
}

void task_runner::on_command(const world& w, std::uint64_t number, const vehicle_link::command_outcome& outcome) {
  if (number == arm_order_) {
    is_arm_accepted_ = outcome.verdict == command_verdict::accepted;
    if (!is_arm_accepted_ && outcome.verdict != command_verdict::timed_out)
      armed_ns_ = 0;
  }
  if (!task_ || ended_ || number != last_order_ || stage_ != stage::sent)
    return;
  last_reason_ = outcome.reason;
  step_.observed_ns = 0; // the vehicle is observed anew before whatever is sent next
  attempts_.was_lost = outcome.verdict == command_verdict::timed_out;
  const bool is_accepted = outcome.verdict == command_verdict::accepted;
  was_refused_for_now_ = outcome.verdict == command_verdict::refused && !is_final(outcome);
  // An observation asks for a message, too: what asks for another one waits for its answer.
  const bool is_unsent =
      outcome.verdict == command_verdict::outdated || outcome.verdict == command_verdict::already_running;
  if (is_unsent && retry_outdated(w))
    return;
  if (!is_accepted && !attempts_.was_lost)
    return retry_or_fail(w, outcome.reason, is_final(outcome));
  if (is_accepted && is_done_by_answer(way_[at_], context(w)))
    return succeed(w);
  attempts_.was_accepted = is_accepted;
  if (is_accepted && attempts_.changes_mode)
    w.authority.acknowledge();
  if (attempts_.was_lost && is_stop() && !is_done(w))
    return look_before_repeating(w);
  if (attempts_.is_moving)
    step_.next_observation_ns = w.now_ns;
  const auto not_moving_ns = is_accepted ? again_after_ns : lost_after_ns;
  enter(stage::confirming, w.now_ns + (attempts_.is_moving ? shown_within_ns : not_moving_ns));
}

// A stop is repeated as soon as the vehicle is heard in its old mode: by then nobody else has taken it. One that holds
// it does not wait long for that. One that brings it home moves it, and is not repeated unheard.
void task_runner::look_before_repeating(const world& w) {
  attempts_.lost_ns = w.now_ns;
  step_.next_observation_ns = w.now_ns;
  enter(stage::confirming, w.now_ns + (is_return() ? shown_within_ns : heard_just_now_ns));
}

// It has not gone out: that was no try, and has no effect. True: it is decided anew with the heartbeat that is on its
// way here.
bool task_runner::retry_outdated(const world& w) {
  withdraw(w, std::exchange(last_expected_, {}));
  if (++step_.outdated >= max_tries_of_lost)
    return false;
  --attempts_.tries;
  enter(stage::pausing, w.now_ns + until_heartbeat_ns);
  return true;
}

void task_runner::on_guarded(const world& w, std::uint64_t number, const std::string& refused, bool is_final) {
  if (!task_ || ended_ || number != last_order_ || stage_ != stage::sent)
    return;
  if (refused.empty())
    return succeed(w);
  if (!is_final && attempts_.tries < max_tries)
    return enter(stage::pausing, w.now_ns + pause_between_ns);
  withdraw_announced(w);
  fail("the failsafe does not watch over this flight: " + refused);
}

} // namespace godwit::executor
