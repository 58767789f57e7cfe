// The end of an upload: the vehicle has answered, may check the plan, and progress applies what came of it.
#include "actors/executor/tasks/task_runner.hpp"

namespace godwit::executor {

namespace transfer = vehicle_link::transfer;

void task_runner::begin_upload(const world& w) {
  if (attempts_.tries == 1)
    uploads_.begin(w.now_ns);
  held_infeasible_ = w.view.finds_infeasible();
  w.seen.plan.forget();
}

void task_runner::on_transfer(const world& w, std::uint64_t number, const transfer::outcome& outcome) {
  if (!task_ || ended_ || number != last_order_)
    return;
  if (stage_ == stage::proving)
    return on_read(w, outcome);
  if (stage_ != stage::sent)
    return;
  last_reason_ = outcome.reason;
  step_.observed_ns = 0;
  if (is_at<clear_plan>())
    return outcome.verdict == transfer::verdict::accepted ? next_step() : retry_or_fail(w, outcome.reason, false);
  uploaded_ns_ = w.now_ns;
  if (uploads_.go_on(outcome, w.now_ns))
    return enter(stage::pausing, w.now_ns + pause_between_ns);
  judged_ = outcome;
  // The way home has no time for that: where it can not be flown the mission mode is refused, and it returns straight.
  const bool is_judged = outcome.verdict == transfer::verdict::accepted && outcome.plan_id.value_or(0) != 0 &&
                         task_->kind != task_kind::come_home_by_plan &&
                         w.view.owner().autopilot == io::mavlink::mav_autopilot::px4;
  enter(stage::judging, is_judged ? w.now_ns + judged_within_ns : w.now_ns);
  judge_upload(w);
}

// What it reports right after the upload may still be about the plan before: that counts where the two differ.
std::optional<bool> task_runner::is_judged_infeasible(const vehicle_view& view) const {
  const auto& current = view.current();
  if (!judged_ || judged_->verdict != transfer::verdict::accepted || !current ||
      view.current_heard_ns() < uploaded_ns_ || current->mission_id != judged_->plan_id.value_or(0))
    return std::nullopt;
  const bool is_infeasible = view.finds_infeasible();
  const bool has_looked = is_infeasible != held_infeasible_;
  return has_looked || view.current_heard_ns() >= uploaded_ns_ + judged_after_ns ? std::optional(is_infeasible)
                                                                                 : std::nullopt;
}

progress::upload_ended task_runner::end_of_upload(const vehicle_view& view) {
  auto result = uploads_.end(*judged_);
  was_infeasible_ = is_judged_infeasible(view).value_or(false);
  if (!was_infeasible_)
    return result;
  const auto words = view.warned_since(attempts_.sent_ns);
  last_reason_ =
      "the vehicle has taken the plan, and finds that it can not be flown" +
      (words.empty() ? ", by its own fence, its parameters or its state; it reports why to ground stations alone"
                     : ": \"" + words + "\"");
  result.verdict = progress::upload_verdict::infeasible;
  result.reason = last_reason_;
  return result;
}

void task_runner::judge_upload(const world& w) {
  if (!is_judged_infeasible(w.view) && w.now_ns < deadline_ns_)
    return;
  note_and_wait(w, end_of_upload(w.view));
  enter(stage::closing);
}

// The upload's end is applied; where it was not known, progress reads the plan back.
void task_runner::resolve_upload(const world& w) {
  if (w.durable.progress.upload)
    return;
  if (w.durable.progress.last_generation != generation_before_) {
    w.seen.plan.prove(uploaded_ns_, uploaded_ns_);
    next_step();
  } else {
    fail(was_infeasible_ ? last_reason_ : "the plan did not come to the vehicle: " + last_reason_);
  }
}

} // namespace godwit::executor
