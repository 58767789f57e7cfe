// Changes of the plan in flight: what operators change (go there, cancel, insert), what the service assigns, and
// revisions that come. The service numbers the revision; where there is none, or none answers in time, we do.
//
//   command ──> held, stands ──> asked ──┬─ the service's revision ───────────────> flown
//                                        ├─ refused ──────────────────────────────> not changed, held
//                                        ├─ something else is commanded, or
//                                        │  somebody else has the vehicle ────────> not changed
//                                        └─ silent for flight.service_wait_ms ────> flown; the service is asked until
//                                        it
//                                                                                   answers (state::flown_changes)
//
// Pure. Thread: one at a time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "actors/executor/flight/task_control.hpp"
#include "actors/executor/remaining.hpp"
#include "messages/operator/types.hpp"

namespace godwit::executor {

class plan_changes {
public:
  plan_changes(flight_context& flight, phase_machine& phases, task_control& tasks)
      : flight_(flight), phases_(phases), tasks_(tasks) {}

  // A command of an operator.
  [[nodiscard]] operators::answer take(const operators::command& m, instant now);
  [[nodiscard]] bool begin_wanted(effects& out, instant now);
  // What is wanted outlives a crash, as long as nothing else was commanded and nobody else has the vehicle.
  void keep_commanded(effects& out, bool has_looked, instant now);
  // The service has not answered for as long as it is waited for: until next_deadline_ns().
  [[nodiscard]] bool fly_unanswered(effects& out, instant now);
  [[nodiscard]] std::int64_t next_deadline_ns() const;
  [[nodiscard]] effects on_change(const mission_client::change_outcome& m);
  [[nodiscard]] effects on_assignment(const mission_client::assignment_arrived& m);
  // One at a time, and only while a plan may be changed.
  [[nodiscard]] bool answer_assignment(effects& out, instant now);
  // A new revision of the mission that is flown.
  [[nodiscard]] bool deploy_arrived(effects& out, instant now);
  // The vehicle holds another plan, or none: a person wants the rest of the mission flown all the same.
  void deploy_again(effects& out, instant now);
  // The plan that the vehicle had before the one that it can not fly; it stays held.
  [[nodiscard]] bool bring_plan_before(effects& out, instant now);
  // Home was moved in flight: the rest of the mission, with a way to its home in the place of the vehicle's own return.
  [[nodiscard]] bool bring_return_anew(effects& out, instant now);

private:
  // After so many in a row the policy for refused inserts counts.
  static constexpr int max_refused_inserts = 3;

  using change_or_reason = tl::expected<plan_change, std::string>;
  [[nodiscard]] change_or_reason change_of(const operators::command& m, instant now) const;
  [[nodiscard]] change_or_reason go_there(const mission::position& to, instant now) const;
  [[nodiscard]] change_or_reason cancel(instant now) const;
  [[nodiscard]] std::vector<mission::item> items_of(const std::vector<geo::point>& turns, double altitude_m,
                                                    const std::string& name) const;
  [[nodiscard]] std::optional<mission::position> first_place(const plan_change& what, instant now) const;
  [[nodiscard]] bool stands_for_change(effects& out, instant now);
  void begin_from_here(effects& out, instant now);
  [[nodiscard]] change_or_reason insert(const operators::command& m) const;
  [[nodiscard]] tl::expected<mission::document, std::string> changed(const plan_change& what) const;
  [[nodiscard]] std::string why_not_there(const mission::position& to, instant now) const;
  [[nodiscard]] std::string why_not_changed(const plan_change& what, instant now) const;
  // Of the service, or by ourselves where there is none.
  void ask_for(effects& out, const plan_change& what, instant now);
  void take_up_commanded(effects& out, instant now);
  [[nodiscard]] static bool is_too_old(std::int64_t said_ns, instant now);
  [[nodiscard]] std::int64_t service_wait_ns() const;
  [[nodiscard]] std::int64_t fly_at_ns(std::int64_t said_ns, instant now) const;
  [[nodiscard]] bool may_fly_unanswered() const;
  [[nodiscard]] bool is_wait_over(instant now);
  [[nodiscard]] bool is_flown_unanswered(const std::string& key) const;
  [[nodiscard]] effects on_answer_to_flown(const mission_client::change_outcome& m) const;
  void drop(effects& out, const std::string& why);
  [[nodiscard]] bool reject(effects& out, const mission::assignment& asked, const std::string& why);
  [[nodiscard]] bool take_on_ground(effects& out, const mission::assignment& asked, const mission::document& mission);
  [[nodiscard]] bool deploy_assigned(effects& out, const mission::assignment& asked, const reassigned& wanted,
                                     instant now);

  flight_context& flight_;
  phase_machine& phases_;
  task_control& tasks_;
  int refused_inserts_ = 0; // in a row
  bool may_take_up_ = true; // what an incarnation before was commanded
  struct awaited {
    std::string key;
    std::int64_t until_ns = 0; // monotonic
  };
  std::optional<awaited> waits_for_; // the answer to the change that was asked for last
};

} // namespace godwit::executor
