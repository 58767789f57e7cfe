// The task under way: what begins one, and what its end leads to.
//
// One at a time; its steps are run by task_runner. A task is noted before its first order goes out. Pure. Thread: one
// at a time.
#pragma once

#include <optional>
#include <string>

#include "actors/executor/flight/flight_context.hpp"
#include "actors/executor/flight/phase_table.hpp"

namespace godwit::executor {

class task_control {
public:
  task_control(flight_context& flight, phase_machine& phases) : flight_(flight), phases_(phases) {}

  // KEY: of the ground station's request.
  void begin(effects& out, task_kind kind, steps way, bool goes_on = false, std::optional<std::uint64_t> key = {});
  // GOES_ON: in flight, into the new plan. ASSIGNMENT: that the plan carries out.
  void begin_deploy(effects& out, const mission::document& mission, const plan::flight_plan& what,
                    const std::optional<std::string>& assignment, bool goes_on);
  // In flight: a part of a station's plan, for the station that waits for the answer to its start.
  void begin_part(effects& out, const station_plan_taken& part, const plan::flight_plan& what, std::uint64_t key);
  // In flight, held: the plan that a station has uploaded. It stays held.
  void begin_upload(effects& out, const station_plan_taken& next, const plan::flight_plan& what);
  // In flight: of no mission, and flown at once.
  void begin_way_home(effects& out, const plan::flight_plan& what);
  // At SEQUENCE of the vehicle.
  void begin_start(effects& out, std::optional<std::uint64_t> key, std::uint16_t sequence);

  // True: one is under way, or has just ended.
  [[nodiscard]] bool run(effects& out, instant now);
  // It returns by an order of ours.
  void follow_return(effects& out);
  // What a start has armed and nobody else can have. True: its disarm has begun.
  bool disarm_left_armed(effects& out);
  // What was ordered and not heard obeyed shows now.
  void follow_unheard(effects& out, instant now);
  // What is under way may still come through.
  void give_up(effects& out, instant now, const std::string& why);
  // The task that the record has, where nobody runs it. WHY: for the station that waits for its start.
  void end(effects& out, const std::string& why);

  void answer_start(effects& out, std::uint64_t key, start_verdict verdict, const std::string& reason);
  // The failsafe takes over the limits of the flight first; the same ones twice without harm.
  [[nodiscard]] steps guarded(steps way);

  // In flight, in the place of one that the vehicle can not fly; it stays held.
  void begin_bring_back(effects& out, const mission::document& mission, const plan::flight_plan& what);

private:
  void refuse_infeasible(effects& out, const std::string& why);
  void begin_plan(effects& out, const task& doing, deployment brings, const progress::plan_map& map,
                  const std::optional<std::string>& assignment = {});
  void finish_way_home(effects& out);
  [[nodiscard]] bool is_pointless(const task& what) const;
  void verify_plan(instant now);
  void finish(effects& out, const task& what, instant now);
  void finish_deploy(effects& out, const task& what);
  void fail(effects& out, const task& what, const std::string& why, instant now);
  [[nodiscard]] bool is_start_tried_on(const task& what, instant now);

  flight_context& flight_;
  phase_machine& phases_;
  std::uint32_t deploying_over_ = 0;        // the generation that the deployment under way takes the place of
  bool deploys_after_end_ = false;          // the plan before was done already when the deployment began
  bool gave_up_order_ = false;              // for a stop; it may still come through
  std::int64_t start_refused_since_ns_ = 0; // the automatic one; 0: it is not
  bool brings_back_ = false;                // the deployment under way: the plan before
};

} // namespace godwit::executor
