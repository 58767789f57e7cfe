// Every decision about a flight: from the mission to the delivery, through crashes, replans and pilots.
//
//   the vehicle's word ──> vehicle_view ──> control_authority: who has it?
//                               │               │
//   missions, assignments ──────┼──> wishes ────┼──> decide ──> a task, one at a time ──> task_runner ──> orders
//   operators, stations ────────┘               │       │
//                                               │       └──> notes: phase, task, progress ──> the journal
//   MISSION_CURRENT, ITEM_REACHED ──> progress ─┘
//
// What must survive is noted, and applied to the durable state before the next call. So what is decided depends on the
// durable state, on what the vehicle says, and on nothing else. The caller keeps what is to wait for the disk back.
//
// Rules that protect people, each with a test of its own name: a new incarnation looks at the vehicle before anything;
// it arms, starts and takes off nothing; on the ground it waits for a person. A mode change in flight or during a start
// that no word of ours has caused is a person's or the autopilot's failsafe's: from then on nothing is sent until an
// operator hands back, also behind a landing, and neither while a failsafe acts. The one exception is stand_by, which
// makes a disarmed vehicle safe to arm. A word that holds or returns gives up what is under way. What a step can not
// get done in a few tries ends in a pause with a reason; a hold or a return that is not obeyed leaves the phase as it
// is.
//
// Pure: no clock, no actor, no I/O. Thread: one at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "actors/domain/control_authority/control_authority.hpp"
#include "actors/executor/effects.hpp"
#include "actors/executor/plan/builder.hpp"
#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/settings.hpp"
#include "actors/executor/task_runner.hpp"
#include "actors/executor/view.hpp"
#include "messages/executor/types.hpp"
#include "messages/operator/types.hpp"

namespace godwit::executor {

struct instant {
  std::int64_t now_ns = 0;  // monotonic
  std::int64_t wall_ns = 0; // since 1970 (UTC)
};

// What of this process the preflight checks look at; asked for by the shell.
struct house {
  preflight::journal_facts journal;
  std::vector<preflight::actor_fact> actors;
  bool is_operator_session_alive = false;
};

class core {
public:
  // DURABLE outlives it, and changes only between two calls.
  core(settings configured, const state& durable) : settings_(std::move(configured)), s_(durable) {}

  [[nodiscard]] effects on_start();
  // The notes of the call before are applied to the durable state.
  void on_applied() { shown_.reset(); }
  // What is to be done now: to be asked after everything else until nothing comes of it, and no later than
  // next_deadline_ns.
  [[nodiscard]] effects advance(instant now);
  [[nodiscard]] std::int64_t next_deadline_ns(instant now) const;

  // -- the vehicle
  [[nodiscard]] effects on_vehicle(const vehicle_link::connection_changed& m, instant now);
  [[nodiscard]] effects on_vehicle(const vehicle_link::vehicle_restarted& m, instant now);
  [[nodiscard]] effects on_vehicle(const io::mavlink::heartbeat& m, instant now);
  [[nodiscard]] effects on_vehicle(const io::mavlink::mission_current& m, instant now);
  [[nodiscard]] effects on_vehicle(const io::mavlink::mission_item_reached& m, instant now);
  template <class M>
  [[nodiscard]] effects on_vehicle(const M& m, instant now) {
    if constexpr (requires { view_.take(m, now.now_ns); })
      view_.take(m, now.now_ns);
    else
      view_.take(m);
    return {};
  }
  // Whether an order that has waited for the disk still goes out: not behind a takeover, a failsafe or a newer order,
  // and not when its moment has passed or while it is unclear who has the vehicle. It is asked for again then, but for
  // a start or a resume.
  enum class release { now, revoked, too_late };
  static constexpr std::int64_t order_is_worth_ns = 3'000'000'000;
  [[nodiscard]] release lets_out(const order& what, instant now);
  [[nodiscard]] effects on_late(const order& what, instant now);
  [[nodiscard]] effects on_revoked(const order& what);
  [[nodiscard]] effects on_command(std::uint64_t number, const vehicle_link::command_outcome& outcome, instant now);
  [[nodiscard]] effects on_transfer(std::uint64_t number, const vehicle_link::transfer::outcome& outcome, instant now);

  // -- the failsafe
  // Told at each change, and asked for by who begins anew: nothing is done before it is known.
  void on_stance(const failsafe::stance& m);
  [[nodiscard]] bool wants_stance() const { return !stance_; }
  [[nodiscard]] effects on_guarded(std::uint64_t number, const failsafe::guard_answer& answer, bool is_answered,
                                   instant now);

  // -- the service
  [[nodiscard]] effects on_mission(const mission_client::mission_loaded& m, instant now);
  [[nodiscard]] effects on_refused(const mission_client::mission_refused& m, instant now);
  [[nodiscard]] effects on_map(const mission_client::map_pulled& m, instant now);
  // How the service stands; asked for while a flight is prepared, because a restart forgets what was told.
  void on_service(const mission_client::service_status& m);
  [[nodiscard]] bool wants_service() const;
  [[nodiscard]] effects on_assignment(const mission_client::assignment_arrived& m, instant now);
  [[nodiscard]] effects on_change(const mission_client::change_outcome& m, instant now);
  [[nodiscard]] effects on_deleted(const mission_client::mission_deleted& m, instant now);
  [[nodiscard]] effects on_delivered(const mission_client::mission_settled& m, instant now);

  // -- people
  [[nodiscard]] effects on_station(const start_mission& m, instant now);
  [[nodiscard]] effects on_station(const plan_taken& m, instant now);
  [[nodiscard]] effects on_station(const plan_cleared& m, instant now);
  // What stations are to be told, when it has changed and once a second; to be asked after everything else.
  [[nodiscard]] effects tell_stations(instant now);
  // The answer tells whether the word is taken; what comes of it is told as the flight's standing.
  [[nodiscard]] operator_words::answer on_operator(const operator_words::word& m, instant now);

  // -- what a note has led to
  [[nodiscard]] effects on_news(const progress::look_at_vehicle& m, instant now);
  [[nodiscard]] effects on_news(const progress::read_plan_back& m, instant now);
  [[nodiscard]] effects on_news(const progress::settle_start& m, instant now);
  [[nodiscard]] effects on_news(const progress::news& m, instant now);

  void on_house(house seen) { house_ = std::move(seen); }
  [[nodiscard]] const vehicle_view& view() const { return view_; }
  [[nodiscard]] std::string sentence() const; // how the flight stands, for people

private:
  // At the place to which an operator has sent the vehicle; then the mission is over.
  static constexpr double stay_s = 3'600;
  // After so many in a row the policy for refused inserts counts.
  static constexpr int max_refused_inserts = 3;

  // What a restart or a lost answer left open about the vehicle.
  enum class question { none, plan_id, read_back, start };

  [[nodiscard]] task_runner::world world(instant now, effects& out) { return {s_, view_, authority_, now.now_ns, out}; }

  // core.cpp: in this order; true: something is under way, and the rest waits.
  [[nodiscard]] bool recover(effects& out, instant now);
  [[nodiscard]] bool settle(effects& out, instant now);
  [[nodiscard]] bool heed_others(effects& out, instant now);
  [[nodiscard]] bool stop(effects& out, instant now);
  [[nodiscard]] bool run_task(effects& out, instant now);
  [[nodiscard]] bool end_flight(effects& out, instant now);
  [[nodiscard]] bool answer_assignment(effects& out, instant now);
  [[nodiscard]] bool prepare(effects& out, instant now);
  [[nodiscard]] bool follow_started(effects& out);
  [[nodiscard]] bool has_nothing_left(const mission::document& next) const;
  [[nodiscard]] bool is_same_mission(const mission::document& next) const;
  [[nodiscard]] bool begin_wished(effects& out, instant now);

  [[nodiscard]] bool is_down(instant now) const;
  [[nodiscard]] bool was_brought_down(instant now) const;
  void read_back(effects& out, instant now);
  [[nodiscard]] std::vector<std::uint32_t> left_in(const std::optional<task>& doing) const;
  [[nodiscard]] bool is_starting() const { return s_.doing && s_.doing->kind == task_kind::start; }
  [[nodiscard]] std::vector<std::uint32_t> modes_behind_disarm() const;
  void know_plan_end();
  // The mode and the place in the plan that were heard last.
  void judge_mode(instant now);
  void judge_place(instant now);
  [[nodiscard]] bool came_down_as_planned(instant now) const;
  [[nodiscard]] bool is_complete_credible(instant now) const;
  [[nodiscard]] bool hovers() const;
  [[nodiscard]] bool ends_on_ground() const; // the plan on the vehicle, by a landing or a return
  [[nodiscard]] bool leave_mission_mode(effects& out, instant now);
  void end_mission(effects& out);
  void end_task(effects& out, const std::string& why);
  void yield(effects& out, pause_cause to, const std::string& why);
  void say_taken_over(effects& out);
  void recover_on_ground(effects& out, instant now);
  void recover_in_flight(effects& out, instant now);
  void take_read_back(effects& out, std::uint64_t number, const vehicle_link::transfer::outcome& outcome, instant now);

  // core_changes.cpp
  struct wished_change {
    change_kind kind = change_kind::go_to;
    std::optional<std::string> after_item_id; // absent: in front of all items
    std::vector<mission::item> items;
    std::vector<mission::item> set_aside;
  };
  using change_or_reason = tl::expected<wished_change, std::string>;
  [[nodiscard]] operator_words::answer take_change(const operator_words::word& m, instant now);
  [[nodiscard]] change_or_reason wish_to_go(const mission::position& to, instant now) const;
  [[nodiscard]] change_or_reason wish_to_cancel() const;
  [[nodiscard]] change_or_reason wish_to_insert(const operator_words::word& m) const;
  [[nodiscard]] tl::expected<mission::document, std::string> changed(const wished_change& wish) const;
  [[nodiscard]] std::string why_not_there(const mission::position& to) const;
  [[nodiscard]] std::string why_not_changed(const wished_change& wish, instant now) const;
  [[nodiscard]] std::size_t first_item(const mission::document& mission) const; // to go on with
  [[nodiscard]] plan::plan_from going_on(const mission::document& mission, std::size_t first_item) const;
  [[nodiscard]] tl::expected<plan::flight_plan, std::string> plan_in_flight(const mission::document& mission,
                                                                            instant now) const;
  [[nodiscard]] bool begin_change(effects& out, instant now);
  void drop_change(effects& out, const std::string& why);
  [[nodiscard]] bool deploy_arrived(effects& out, instant now);

  // core_stations.cpp
  struct shown_plan {
    std::uint32_t plan_id = 0; // 0: none
    std::size_t items = 0;
    bool is_upload = false; // as it came; else as the vehicle has it
  };
  [[nodiscard]] const shown_plan& shown();
  [[nodiscard]] effects take_plan(const plan_taken& m, instant now);
  [[nodiscard]] effects take_fence(const std::vector<io::mavlink::mission_item_int>& items);
  [[nodiscard]] effects not_taken(const std::string& why);
  [[nodiscard]] std::string why_not_meant(const start_mission& m);
  [[nodiscard]] bool fly_again(effects& out, instant now);
  [[nodiscard]] bool begins_with_home(const std::vector<io::mavlink::mission_item_int>& items) const;

  // core_tasks.cpp
  void stand(effects& out, const stood& next); // noted when it is another standing
  void stand_as(effects& out, phase now, bool in_flight);
  void stand(effects& out, phase now, pause_cause cause = pause_cause::none, const std::string& reason = {});
  void stand_paused(effects& out, pause_cause cause, const std::string& reason);
  void begin(effects& out, task_kind kind, steps way, bool goes_on = false);
  void begin_deploy(effects& out, const mission::document& mission, const plan::flight_plan& what,
                    const std::optional<std::string>& assignment, bool goes_on);
  void begin_start(effects& out, std::optional<std::uint64_t> key);
  void begin_going_on(effects& out);
  void begin_at_start(effects& out);
  void begin_again(effects& out, instant now);
  [[nodiscard]] bool begin_wanted(effects& out, task_kind what, instant now);
  [[nodiscard]] bool begin_asked_start(effects& out, const start_mission& asked, instant now);
  [[nodiscard]] std::string why_not_start(effects& out, instant now);
  void task_done(effects& out, const task& what);
  void task_failed(effects& out, const task& what, const std::string& why, instant now);
  [[nodiscard]] bool is_start_tried_on(const task& what, instant now);
  [[nodiscard]] std::optional<plan::plan_setting> setting(instant now) const;
  [[nodiscard]] steps start_steps() const;
  [[nodiscard]] bool is_copter() const;
  [[nodiscard]] bool is_in_air() const;
  [[nodiscard]] steps out_of_mission_steps() const;
  [[nodiscard]] steps guarded(steps way);
  [[nodiscard]] steps going_on_steps() const;
  [[nodiscard]] bool starts_in_mission_mode() const;
  [[nodiscard]] steps deploy_steps(const progress::plan_map& map, bool goes_on) const;
  [[nodiscard]] preflight::report look_at_all(instant now);
  void answer_start(effects& out, std::uint64_t key, start_verdict verdict, const std::string& reason);

  [[nodiscard]] bool is_in_flight() const { return s_.standing.in_flight; }
  // A person, a failsafe or the autopilot's own has had it, and nobody has handed it back.
  [[nodiscard]] bool has_person() const { return needs_hand_back(s_.standing.cause); }
  // Of an upload or a start: what became of it is not known yet.
  [[nodiscard]] bool has_open_intent() const { return s_.progress.upload || s_.progress.start; }
  [[nodiscard]] bool may_change_plan() const; // of a flight
  [[nodiscard]] bool is_plan_finished() const;
  [[nodiscard]] bool is_mission_finished() const;
  [[nodiscard]] bool plan_has_home() const;

  settings settings_;
  const state& s_;
  vehicle_view view_;
  flight::control_authority authority_;
  task_runner runner_;

  bool has_looked_ = false; // at the vehicle, since this incarnation began
  std::optional<failsafe::stance> stance_;
  question looking_ = question::none;
  std::int64_t looking_since_ns_ = 0;
  std::uint64_t reading_back_ = 0; // the number of the download
  std::int64_t read_again_ns_ = 0;
  bool may_upload_go_on_ = false; // in the link: one that the incarnation before has begun
  std::uint64_t last_reading_back_ = 1ULL << 32U;
  std::int64_t down_since_ns_ = 0;          // 0: it is not
  bool was_up_ = false;                     // it has been in the air, as far as this incarnation knows
  std::uint32_t deploying_over_ = 0;        // the generation that the deployment under way takes the place of
  bool finishes_intent_ = false;            // of an earlier incarnation: it is held, and meant to fly on
  bool must_guard_ = false;                 // it may fly a plan whose fences the failsafe was not told
  std::optional<std::uint32_t> known_end_;  // the generation whose end authority_ knows
  bool deploys_behind_end_ = false;         // the plan before was done already when the deployment began
  std::int64_t disarmed_since_ns_ = 0;      // 0: it is armed
  bool gave_up_order_ = false;              // for a stop; it may still come through
  bool was_armed_ = false;                  // in the start that is under way
  bool has_stood_by_ = false;               // tried, since it was armed last
  bool must_choose_item_ = false;           // it holds the plan, and is elsewhere in it
  std::uint64_t last_task_before_ = 0;      // this incarnation began
  std::int64_t start_refused_since_ns_ = 0; // the automatic one; 0: it is not
  std::optional<start_mission> asked_start_;
  bool is_start_wanted_ = false;    // by an operator
  std::optional<task_kind> wanted_; // by an operator: hold, resume, come home
  std::optional<wished_change> wanted_change_;
  bool is_held_for_change_ = false;
  int refused_inserts_ = 0; // in a row
  bool is_handed_back_ = false;
  bool wants_checks_ = false;
  std::optional<preflight::acknowledged> acknowledged_;
  mission_client::pull_state map_ = mission_client::pull_state::not_started;
  std::string map_problem_;
  std::string refusal_;
  std::optional<preflight::plan_result> plans_; // of the mission, from its first remaining item on
  std::int64_t checked_ns_ = 0;
  std::optional<shown_plan> shown_;
  std::uint32_t told_plan_id_ = 0;
  std::string refused_upload_; // why the last upload of a station was not taken; empty: it was
  ground_port::mission_progress told_progress_;
  std::int64_t told_progress_ns_ = 0;
  house house_;
};

} // namespace godwit::executor
