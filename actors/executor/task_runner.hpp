// Brings the vehicle through the steps of one task, one after the other.
//
//   begin ──> proving ──> noting ──applied──> looking ──> asked ──answer──> showing ──seen──> closing ──applied──> next
//     ^   (flies a plan) (the intent)         (moves)       │                  │             (what came of it)
//     └──────────────────── pausing <────────not done───────┴──── not seen ────┘       after max_tries: it has failed
//                                                                              (an upload: as upload_tries says)
//
// A step whose intent progress has to know notes it first, and so it does with its end; an order goes out when what was
// noted before it is on the disk. What has no such intent skips noting and closing. Before an order that moves the
// vehicle the plan on it is proved and the vehicle is looked at (may_send.hpp); it is given once, and when the vehicle
// does not show it within its time it is not done: a person has to start again. Only what was refused is asked for
// again, and what stops the vehicle or moves nothing. A start or resume that nobody has looked after
// for starved_ns is not gone on with: whoever stands beside the vehicle thinks that nothing comes of it any more. Pure;
// the caller carries out what is in `out`. Thread: one at a time.
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
#include "actors/executor/steps.hpp"
#include "actors/executor/upload_tries.hpp"
#include "actors/executor/view.hpp"

namespace godwit::executor {

// How the plan on the vehicle ends.
[[nodiscard]] flight::plan_end end_of_plan(const flight::mode_owner& whose, const state& s);

// For HOME_POSITION.
[[nodiscard]] vehicle_link::send_command home_request();

class task_runner {
public:
  // What a step sees and leaves behind.
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

  // The process had no processor. The executor looks twice a second at least, and a look at the vehicle counts for as
  // long. A person's hold of a vehicle that stands in this mode shows in nothing but the answer to it: it may have been
  // on another line, or among what the socket had no room for.
  static constexpr std::int64_t starved_ns = vehicle_link::look_counts_ns;

  // INTENT: of the plan that bring_plan brings.
  void begin(const task& what, steps way, std::optional<progress::upload_intended> intent);
  // What is shown now is older than an order that was given up: the first step is asked for all the same.
  void ask_all_the_same() { must_ask_ = true; }
  // Ends it where it is.
  void drop(const world& w);

  // As far as it goes now. Done and failed are said once.
  [[nodiscard]] verdict advance(const world& w);
  // Why the last one failed; a sentence for people.
  [[nodiscard]] const std::string& why_failed() const { return why_failed_; }

  void on_command(const world& w, std::uint64_t number, const vehicle_link::command_outcome& outcome);
  // REFUSED: why the failsafe does not take the limits; empty: it does. No answer is a reason as well.
  void on_guarded(const world& w, std::uint64_t number, const std::string& refused, bool is_final);
  // Of an upload, or of a plan that was read to prove it.
  void on_transfer(const world& w, std::uint64_t number, const vehicle_link::transfer::outcome& outcome);
  void on_looked(const world& w, std::uint64_t number, const vehicle_link::looked& what);

  // Of the upload that was asked for last, also when its task was dropped since.
  [[nodiscard]] const upload_tries& uploads() const { return uploads_; }

  // It is still what the task waits for.
  [[nodiscard]] bool awaits(std::uint64_t order) const;
  // What the order that waited needs of the vehicle still holds; what it waits for otherwise.
  [[nodiscard]] permission may_go_out(const world& w) const;
  // The start of the plan has gone out at least once, and may come through.
  [[nodiscard]] bool has_asked_to_start() const;
  // What was asked last was refused, and may be done when it is asked again.
  [[nodiscard]] bool was_refused_for_now() const { return was_refused_for_now_; }
  // The plan of the task that began last came to the vehicle, which finds that it can not be flown.
  [[nodiscard]] bool was_infeasible() const { return was_infeasible_; }
  // Of the mission whose plan was to be brought.
  [[nodiscard]] std::int32_t brought_revision() const { return intent_ ? intent_->revision : 0; }
  // The vehicle is armed because of the task that began last, or may be.
  [[nodiscard]] bool has_armed() const { return has_armed_; }

  // What is under way holds the vehicle, or brings it home.
  [[nodiscard]] bool is_stop() const;
  [[nodiscard]] bool is_busy() const { return task_.has_value(); }
  // The step under way takes a vehicle that stands out of its mission mode.
  [[nodiscard]] bool is_standing_by() const {
    return task_ && at_ < way_.size() && std::holds_alternative<stand_by>(way_[at_]);
  }
  [[nodiscard]] const std::optional<task>& doing() const { return task_; }
  [[nodiscard]] std::int64_t next_deadline_ns() const;

private:
  enum class stage { begin, proving, noting, looking, asked, judging, showing, pausing, closing, resolving };

  static constexpr std::int64_t never_ns = std::numeric_limits<std::int64_t>::max();

  void enter(stage next, std::int64_t deadline_ns = never_ns);
  void next_step();
  void note_and_wait(const world& w, durable_core::event what);
  void go_on_behind_note();
  void fail(std::string why);
  [[nodiscard]] goes urgency() const;

  void begin_step(const world& w);
  void prove_plan(const world& w);
  void on_read(const world& w, const vehicle_link::transfer::outcome& outcome);
  void begin_looking();
  void look(const world& w);
  void was_not_seen(const world& w, const std::string& why);
  void end_step(const world& w, std::string why);
  [[nodiscard]] intended_order intended(const world& w) const;
  [[nodiscard]] std::optional<vehicle_link::seen_state> known(const world& w) const;
  [[nodiscard]] bool moves(const world& w) const;
  void ask(const world& w);
  void ask(const world& w, const change_mode& what);
  void ask(const world& w, const stand_by& what);
  void ask(const world& w, const await_arming& what);
  void ask(const world& w, const guard& what);
  void ask(const world& w, const clear_plan& what);
  void ask(const world& w, const bring_plan& what);
  void ask(const world& w, const set_current_item& what);
  void ask(const world& w, const set_home& what);
  void ask(const world& w, const see_home& what);
  void ask(const world& w, const free_home& what);
  void ask(const world& w, const arm& what);
  void ask(const world& w, const disarm& what);
  void ask(const world& w, const start_plan& what);
  void ask_for_mode(const world& w, flight::mode_kind to);
  void expect(const world& w, std::vector<std::uint32_t> modes);
  void give_order(const world& w, vehicle_link::send_command what);
  void was_obeyed(const world& w);
  void was_not_done(const world& w, const std::string& why, bool is_final);
  // Whether the vehicle can fly what it has taken; nothing: it has not told yet.
  [[nodiscard]] std::optional<bool> is_judged_infeasible(const vehicle_view& view) const;
  [[nodiscard]] progress::upload_ended end_of_upload(const vehicle_view& view);
  void judge_upload(const world& w);
  void resolve_upload(const world& w);
  [[nodiscard]] bool was_outdated(const world& w);

  [[nodiscard]] bool has_intent() const;
  [[nodiscard]] std::string why_not_now(const vehicle_view& view) const;
  void look_at_time(const world& w);
  [[nodiscard]] bool is_too_late_to_move() const;
  void end_too_late(const world& w);
  [[nodiscard]] bool is_shown(const world& w) const;
  [[nodiscard]] bool is_start_shown(const vehicle_view& view) const;
  [[nodiscard]] std::string what_is_asked() const;

  std::optional<task> task_;
  steps way_;
  std::size_t at_ = 0;
  std::optional<progress::upload_intended> intent_;
  stage stage_ = stage::begin;
  std::int64_t deadline_ns_ = never_ns;
  int tries_ = 0;
  upload_tries uploads_;
  bool is_intent_noted_ = false;
  bool has_armed_ = false;
  bool was_refused_for_now_ = false;   // what was asked last
  std::int64_t asked_ns_ = 0;          // the step under way, last
  bool was_in_mission_before_ = false; // armed and in its mission mode, when it was asked
  bool was_accepted_ = false;          // what was asked last
  bool was_lost_ = false;              // the same: no answer came
  std::uint64_t last_order_ = 0;
  bool must_ask_ = false;
  std::uint64_t asked_at_heartbeat_ = 0;
  std::int64_t looked_ns_ = 0;                            // for the order that is next; 0: not yet
  std::int64_t next_look_ns_ = 0;                         // while the vehicle does not show what it was asked for
  int unseen_ = 0;                                        // looks for this order in which nothing was seen
  bool is_moving_ = false;                                // what was asked last moves the vehicle
  std::int64_t proving_since_ns_ = 0;                     // this step; 0: not
  std::int64_t read_since_ns_ = 0;                        // the reading that is under way
  std::int64_t armed_ns_ = 0;                             // when arming was asked for, by this task
  std::int64_t uploaded_ns_ = 0;                          // when the answer to the upload came
  std::optional<vehicle_link::transfer::outcome> judged_; // the upload that the vehicle has taken, and looks at
  bool held_infeasible_ = false;                          // the plan before that
  bool was_infeasible_ = false;
  std::vector<std::uint32_t> expected_;      // by the order that is made
  std::vector<std::uint32_t> last_expected_; // by the last order, and by no earlier one
  int outdated_ = 0;                         // the step under way, so often
  std::uint32_t generation_before_ = 0;
  std::int64_t looked_after_ns_ = 0; // the task, last; 0: not yet
  bool was_starved_ = false;
  std::string last_reason_;
  std::optional<verdict> ended_;
  std::string why_failed_;
};

} // namespace godwit::executor
