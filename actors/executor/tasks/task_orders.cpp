// The orders of a task's steps: what is proved and observed before one goes out, and what goes out with it.
#include <cstdint>
#include <utility>

#include "actors/executor/announced_modes.hpp"
#include "actors/executor/tasks/plan_proof.hpp"
#include "actors/executor/tasks/task_runner.hpp"

namespace godwit::executor {

namespace transfer = vehicle_link::transfer;

namespace {

void withdraw_at_failsafe(const task_runner::world& w, std::vector<std::uint32_t> modes) {
  if (!modes.empty())
    w.out.emplace_back(send_to_failsafe{failsafe::expect_mode{std::move(modes), 0, true}});
}

} // namespace

// -- whether it may go out --------------------------------------------------------------------------

intended_order task_runner::intended(const world& w) const {
  const auto means = effect_of(way_[at_], context(w));
  intended_order result;
  if (means == step_effect::stops)
    result.kind = order_kind::stops;
  else if (means == step_effect::holds)
    result.kind = order_kind::holds;
  else if (means != step_effect::neutral)
    result.kind = order_kind::moves;
  result.is_by_itself = task_->kind == task_kind::deploy || task_->kind == task_kind::come_home_by_plan;
  result.flies_plan = means == step_effect::flies_plan;
  result.looked_ns = step_.observed_ns;
  result.proof_from_ns = w.now_ns - proof_counts_ns;
  // A vehicle without plan ids is read before it is armed: one that stands armed for as long may disarm itself.
  const auto& plan = w.durable.progress.plan;
  if (is_at<start_plan>() && armed_ns_ != 0 && plan && !plan->vehicle_plan_id)
    result.proof_from_ns = armed_ns_ - proof_counts_ns;
  return result;
}

permission task_runner::may_go_out(const world& w) const {
  if (at_ >= way_.size() || !why_not_now(way_[at_], context(w)).empty())
    return permission::not_ours;
  return may_send(intended(w), w.authority, w.seen, w.now_ns);
}

bool task_runner::has_asked_to_start() const { return task_ && attempts_.tries > 0 && is_at<start_plan>(); }

// -- the proof of the plan --------------------------------------------------------------------------

void task_runner::prove_plan(const world& w) {
  const auto& plan = w.durable.progress.plan;
  if (!plan || !w.durable.flown)
    return fail_unsent(w, "it is not known which plan the vehicle should hold");
  if (step_.proving_since_ns == 0)
    step_.proving_since_ns = w.now_ns;
  read_since_ns_ = w.now_ns;
  enter(stage::proving);
  w.out.emplace_back(order{goes::at_once, ++last_order_, w.now_ns, {}, proof_request(*plan)});
}

void task_runner::on_read(const world& w, const transfer::outcome& outcome) {
  const auto items = static_cast<std::int64_t>(w.durable.flown ? w.durable.flown->items.size() : 0);
  const bool is_read = outcome.verdict == transfer::verdict::accepted;
  const bool is_ours = is_read && holds_flown_plan(w.durable, outcome, w.view.owner());
  if (is_ours)
    w.seen.plan.prove(read_since_ns_, w.now_ns);
  if (is_ours && w.seen.plan.is_proved())
    return enter(stage::begin);
  if (is_ours || !is_read) {
    if (w.now_ns - step_.proving_since_ns < proof_within_ns + items * proof_item_ns)
      return enter(stage::pausing, w.now_ns + prove_again_ns);
    const auto why = is_read ? "somebody else goes on sending it plans" : outcome.reason;
    return fail_unsent(w,
                       "it could not be proved that the vehicle holds godwit's plan (" + why + "); nothing is started");
  }
  w.seen.plan.forget();
  w.out.emplace_back(note{progress::other_plan_found{}});
  fail_unsent(w, "the vehicle holds a plan that is not godwit's");
}

// -- the observation of the vehicle -----------------------------------------------------------------

void task_runner::observe(const world& w) {
  step_.next_observation_ns = never_ns;
  w.out.emplace_back(order{goes::at_once, ++last_order_, w.now_ns, {}, vehicle_link::look{}});
}

void task_runner::on_looked(const world& w, std::uint64_t number, const vehicle_link::looked& what) {
  if (!task_ || ended_ || number != last_order_)
    return;
  if (stage_ == stage::confirming)
    step_.next_observation_ns = w.now_ns + look_again_ns;
  if (stage_ != stage::observing)
    return;
  if (!what.is_seen)
    return on_unobserved(w, what.reason);
  step_.observed_ns = what.at_ns;
  enter(stage::begin);
}

void task_runner::on_unobserved(const world& w, const std::string& why) {
  if (++step_.unobserved >= max_looks)
    return fail_unsent(w, "the vehicle can not be observed before it is commanded: " + why);
  enter(stage::pausing, w.now_ns + look_again_ns);
}

// -- the order --------------------------------------------------------------------------------------

void task_runner::send(const world& w) {
  const bool is_moving = intended(w).kind == order_kind::moves;
  const bool was_heard = attempts_.tries == 0 || w.now_ns - w.view.heartbeat_ns() <= heard_just_now_ns;
  attempts_ = {.tries = attempts_.tries + 1,
               .must_ask = attempts_.must_ask,
               .sent_ns = w.now_ns,
               .sent_at_heartbeat = w.view.heartbeats(),
               .was_in_mission = w.view.is_armed() && w.view.is_in(flight::mode_kind::mission),
               .is_moving = is_moving};
  last_expected_.clear();
  last_reason_.clear();
  why_failed_.clear();
  was_refused_for_now_ = false;
  generation_before_ = w.durable.progress.last_generation; // what the service has reported may have raised it since
  enter(stage::sent);
  const auto& what = way_[at_];
  if (is_at<guard>())
    announce_modes(w);
  else if (is_at<upload_plan>())
    begin_upload(w);
  else if (is_at<arm>())
    armed_ns_ = w.now_ns;
  auto request = request_of(what, context(w));
  if (!request)
    return fail(std::move(request.error()));
  if (request->modes) {
    attempts_.changes_mode = was_heard && !w.view.is_in_one_of(*request->modes);
    expect(w, *request->modes);
  }
  if (auto* command = std::get_if<vehicle_link::send_command>(&request->what)) {
    command->confirmation = static_cast<std::uint8_t>(attempts_.tries - 1);
    if (is_stop())
      command->timeout_ms = stop_answer_ms;
    if (is_moving || new_mode() == flight::mode_kind::hold)
      command->copies = vehicle_link::copies_of_moving_order;
    command->only_while = known(w);
  } else if (auto* plan = std::get_if<vehicle_link::upload_plan>(&request->what)) {
    plan->only_while = known(w);
  } else if (auto* item = std::get_if<vehicle_link::set_current_item>(&request->what)) {
    item->only_while = known(w);
  }
  ++last_order_;
  if (is_at<arm>()) {
    arm_order_ = last_order_;
    is_arm_accepted_ = false;
  }
  w.out.emplace_back(order{urgency_of(task_->kind, &what), last_order_, w.now_ns,
                           std::move(request->modes).value_or(std::vector<std::uint32_t>{}), std::move(request->what)});
}

// The observation counts for the order that it was made for.
std::optional<vehicle_link::seen_state> task_runner::known(const world& w) const {
  auto result = w.known;
  if (result && step_.observed_ns != 0)
    result->looked_ns = step_.observed_ns;
  return result;
}

// The failsafe gets them with the order.
void task_runner::expect(const world& w, std::vector<std::uint32_t> modes) {
  last_expected_ = modes;
  if (is_stop()) { // it may have given up another order, which still comes through
    std::erase_if(last_expected_, [&](auto each) { return w.authority.expects({{}, each}, w.now_ns); });
    w.authority.expect_also(modes, w.now_ns, w.now_ns + flight::order_is_expected_ns);
  } else {
    w.authority.expect(std::move(modes), w.now_ns, w.now_ns + flight::order_is_expected_ns);
  }
}

void task_runner::announce_modes(const world& w) {
  auto modes = announced_modes(task_->kind, way_, at_, w.view.owner());
  if (!modes.empty())
    w.out.emplace_back(
        send_to_failsafe{failsafe::expect_mode{std::move(modes), flight::order_is_expected_ns / 1'000'000}});
}

void task_runner::withdraw_announced(const world& w) {
  withdraw_at_failsafe(w, announced_modes(task_->kind, way_, at_, w.view.owner()));
}

void task_runner::withdraw(const world& w, std::vector<std::uint32_t> modes) {
  w.authority.withdraw(modes);
  withdraw_at_failsafe(w, std::move(modes));
}

} // namespace godwit::executor
