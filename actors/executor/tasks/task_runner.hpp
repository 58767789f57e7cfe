// Runs the steps of one task, one after the other. What each kind of step sends and waits for, and its limits, are the
// tables of step_rules.hpp.
//
//   begin ──> proving ──> noting ──applied──> observing ──> sent ──answer──> confirming ──done──> closing ──> next
//     ^   (flies a plan) (the intent)          (moves)       │                  │               (its end)
//     └──────────────────── pausing <─────────not done───────┴─────not done─────┘
//
//   upload_plan: sent ──answer──> judging ──the vehicle has checked it──> closing ──applied──> resolving ──> next
//
// A step with an intent journals it before its order, and its end after it; an order goes out when what was journalled
// before it is on the disk. A step without one skips noting and closing. Before an order that moves the vehicle the
// plan on it is proved and the vehicle is observed (may_send.hpp). A start or resume for which nothing was run for
// stall_limit_ns fails: whoever stands beside the vehicle no longer expects it to move. Pure; the caller executes what
// is in `out`. Thread: one at a time.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "actors/domain/control_authority/control_authority.hpp"
#include "actors/executor/effects.hpp"
#include "actors/executor/evidence.hpp"
#include "actors/executor/may_send.hpp"
#include "actors/executor/tasks/step_rules.hpp"
#include "actors/executor/tasks/steps.hpp"
#include "actors/executor/tasks/upload_tries.hpp"
#include "actors/executor/view.hpp"

namespace godwit::executor {

class task_runner {
public:
  // What a step decides by, and where its effects go.
  struct world {
    const state& durable;
    const vehicle_view& view;
    flight::control_authority& authority;
    evidence& seen;
    std::int64_t now_ns; // monotonic
    effects& out;
    std::optional<vehicle_link::seen_state> known; // goes with each order
  };

  enum class verdict { idle, under_way, done, failed };

  // The process had no processor. The executor runs twice a second at least, and an observation of the vehicle counts
  // for as long. A person's hold of a vehicle that stands in this mode shows in nothing but the answer to it: it may
  // have been on another line, or among what the socket had no room for.
  static constexpr std::int64_t stall_limit_ns = vehicle_link::look_counts_ns;

  // INTENT: of the plan that upload_plan uploads.
  void begin(const task& what, steps way, std::optional<progress::upload_intended> intent);
  // What is shown now is older than an order that was given up: the first step is sent all the same.
  void ask_all_the_same() { attempts_.must_ask = true; }
  // Ends it where it is.
  void drop(const world& w);

  // As far as it goes now. Done and failed are returned once.
  [[nodiscard]] verdict advance(const world& w);
  // Why the last one failed; a sentence for people.
  [[nodiscard]] const std::string& why_failed() const { return why_failed_; }

  void on_command(const world& w, std::uint64_t number, const vehicle_link::command_outcome& outcome);
  // REFUSED: why the failsafe does not take the limits; empty: it does. No answer is a reason as well.
  void on_guarded(const world& w, std::uint64_t number, const std::string& refused, bool is_final);
  // Of an upload, or of a plan that was read to prove it.
  void on_transfer(const world& w, std::uint64_t number, const vehicle_link::transfer::outcome& outcome);
  void on_looked(const world& w, std::uint64_t number, const vehicle_link::looked& what);

  // Of the last upload, also when its task was dropped since.
  [[nodiscard]] const upload_tries& uploads() const { return uploads_; }

  // It is still what the task waits for.
  [[nodiscard]] bool awaits(std::uint64_t order) const;
  // What the order that waited needs of the vehicle still holds; what it waits for otherwise.
  [[nodiscard]] permission may_go_out(const world& w) const;
  // The start of the plan has gone out at least once, and may come through.
  [[nodiscard]] bool has_asked_to_start() const;
  // What was sent last was refused, and may be done when it is sent again.
  [[nodiscard]] bool was_refused_for_now() const { return was_refused_for_now_; }
  // The plan of the task that began last came to the vehicle, which finds that it can not be flown.
  [[nodiscard]] bool was_infeasible() const { return was_infeasible_; }
  // The task that failed last: nothing was heard of the vehicle since its last order, which it may have obeyed.
  [[nodiscard]] const std::optional<task_kind>& unheard() const { return unheard_; }
  void forget_unheard() { unheard_.reset(); }
  // Of the mission whose plan was to be uploaded.
  [[nodiscard]] std::int32_t brought_revision() const { return intent_ ? intent_->revision : 0; }
  // The vehicle is armed because of the task that began last, or may be.
  [[nodiscard]] bool has_armed() const { return armed_ns_ != 0; }
  [[nodiscard]] std::int64_t armed_ns() const { return armed_ns_; }
  // The vehicle has acknowledged it, also when its task has ended meanwhile, and was heard throughout since: nobody
  // else has armed it.
  [[nodiscard]] bool is_armed_by_it(const vehicle_view& view) const {
    return has_armed() && is_arm_accepted_ && view.unbroken_since_ns() <= armed_ns_;
  }
  // The start of an incarnation before may have.
  void assume_armed() {
    armed_ns_ = 1; // long ago
    is_arm_accepted_ = false;
  }
  // It is disarmed, or never was armed.
  void forget_armed() { armed_ns_ = 0; }

  // What is under way holds the vehicle, or brings it home.
  [[nodiscard]] bool is_stop() const {
    return executor::is_stop(task_->kind, at_ < way_.size() ? &way_[at_] : nullptr);
  }
  [[nodiscard]] bool is_busy() const { return task_.has_value(); }
  // The step under way takes a vehicle that stands out of its mission mode.
  [[nodiscard]] bool is_standing_by() const { return task_ && is_at<safe_ground_mode>(); }
  [[nodiscard]] const std::optional<task>& doing() const { return task_; }
  [[nodiscard]] std::int64_t next_deadline_ns() const;

private:
  enum class stage { begin, proving, noting, observing, sent, judging, confirming, pausing, closing, resolving };

  static constexpr std::int64_t never_ns = std::numeric_limits<std::int64_t>::max();

  // Of the step under way, before and after its orders. Nothing that was observed for one step counts for the next.
  struct step_progress {
    bool is_intent_noted = false;
    int outdated = 0;                            // orders that vehicle_link found outdated
    std::int64_t observed_ns = 0;                // for the next order; 0: not yet
    int unobserved = 0;                          // observations for this order that saw nothing
    std::int64_t next_observation_ns = never_ns; // while the vehicle does not show what was sent
    std::int64_t proving_since_ns = 0;           // 0: not
  };

  template <class Step>
  [[nodiscard]] bool is_at() const {
    return at_ < way_.size() && std::holds_alternative<Step>(way_[at_]);
  }
  [[nodiscard]] step_context context(const world& w) const {
    return {w.durable, w.view, w.authority, task_->kind, attempts_, is_armed_by_it(w.view)};
  }
  // What the step under way changes the mode to.
  [[nodiscard]] std::optional<flight::mode_kind> new_mode() const {
    return is_at<change_mode>() ? std::optional(std::get<change_mode>(way_[at_]).to) : std::nullopt;
  }
  // A stop that moves the vehicle.
  [[nodiscard]] bool is_return() const { return new_mode() == flight::mode_kind::returning; }
  [[nodiscard]] step_intent intent() const { return intent_of(way_[at_]); }
  [[nodiscard]] bool is_done(const world& w) const { return executor::is_done(way_[at_], context(w)); }

  void enter(stage next, std::int64_t deadline_ns = never_ns);
  void run_stage(const world& w);
  void begin_step(const world& w);
  void note_and_wait(const world& w, durable_core::event what);
  void on_noted();
  void next_step();
  void succeed(const world& w);
  void retry_or_fail(const world& w, const std::string& why, bool is_final);
  void look_before_repeating(const world& w);
  // Since its last order went out, or since it was known to be lost.
  [[nodiscard]] bool is_heard_since(const world& w) const {
    return attempts_.lost_ns != 0 ? w.view.heartbeat_ns() > attempts_.lost_ns
                                  : w.view.heartbeats() > attempts_.sent_at_heartbeat;
  }
  [[nodiscard]] bool retry_outdated(const world& w);
  void fail(std::string why);
  void fail_unsent(const world& w, std::string why);
  void watch_stall(const world& w);
  [[nodiscard]] bool has_stalled() const;

  // -- task_orders.cpp
  [[nodiscard]] intended_order intended(const world& w) const;
  void prove_plan(const world& w);
  void on_read(const world& w, const vehicle_link::transfer::outcome& outcome);
  void observe(const world& w);
  void on_unobserved(const world& w, const std::string& why);
  void send(const world& w);
  void expect(const world& w, std::vector<std::uint32_t> modes);
  [[nodiscard]] std::optional<vehicle_link::seen_state> known(const world& w) const;
  void announce_modes(const world& w);
  void withdraw_announced(const world& w);
  // No order brings the vehicle into these modes any more: whoever is seen in one is somebody else.
  static void withdraw(const world& w, std::vector<std::uint32_t> modes);

  // -- task_uploads.cpp
  void begin_upload(const world& w);
  // Whether the vehicle can fly what it has accepted; nothing: it has not reported it yet.
  [[nodiscard]] std::optional<bool> is_judged_infeasible(const vehicle_view& view) const;
  [[nodiscard]] progress::upload_ended end_of_upload(const vehicle_view& view);
  void judge_upload(const world& w);
  void resolve_upload(const world& w);

  // -- the task
  std::optional<task> task_;
  steps way_;
  std::size_t at_ = 0;
  std::optional<progress::upload_intended> intent_;
  std::int64_t run_ns_ = 0; // last; 0: not yet
  bool was_stalled_ = false;
  std::uint64_t arm_order_ = 0; // the newest
  bool is_arm_accepted_ = false;
  std::int64_t armed_ns_ = 0; // when arming was sent, and not refused; 0: it was not
  std::optional<verdict> ended_;
  std::string why_failed_;
  std::optional<task_kind> unheard_;

  // -- the step
  stage stage_ = stage::begin;
  std::int64_t deadline_ns_ = never_ns;
  step_progress step_;
  step_attempts attempts_;

  // -- the last order, also of a step or task before
  std::uint64_t last_order_ = 0;
  std::string last_reason_;
  bool was_refused_for_now_ = false;
  std::vector<std::uint32_t> last_expected_; // by it, and by no earlier one

  // -- the plan on the vehicle
  std::int64_t read_since_ns_ = 0; // the reading that is under way
  upload_tries uploads_;
  std::uint32_t generation_before_ = 0;
  std::int64_t uploaded_ns_ = 0;                          // when the answer to the upload came
  std::optional<vehicle_link::transfer::outcome> judged_; // the upload that the vehicle has accepted, and checks
  bool held_infeasible_ = false;                          // the plan before that
  bool was_infeasible_ = false;
};

} // namespace godwit::executor
