// What operators say about the flight under way: hold, come home, resume, hand back, start. Hold and come home give up
// what is under way, and wait for nothing. Pure. Thread: one at a time.
#pragma once

#include "actors/executor/flight/homecoming.hpp"
#include "actors/executor/flight/plan_changes.hpp"
#include "actors/executor/flight/watches/control_watch.hpp"

namespace godwit::executor {

class operator_control {
public:
  operator_control(flight_context& flight, phase_machine& phases, task_control& tasks, plan_changes& changes,
                   homecoming& returns, control_watch& watch)
      : flight_(flight), phases_(phases), tasks_(tasks), changes_(changes), returns_(returns), watch_(watch) {}

  // HAS_LOOKED: at the vehicle, since this incarnation began. The answer tells whether the command is taken; what comes
  // of it is told as the flight's status.
  [[nodiscard]] operators::answer take(const operators::command& m, bool has_looked, instant now);
  // The halt that is wanted. Before the vehicle has moved there is nothing to hold, and the start ends.
  [[nodiscard]] bool halt(effects& out, instant now);
  // The resume that is wanted.
  [[nodiscard]] bool go_on(effects& out, instant now);

private:
  [[nodiscard]] std::string why_not(const operators::command& m, bool has_looked) const;
  [[nodiscard]] std::string why_not_resume() const;
  [[nodiscard]] bool interrupt(effects& out, instant now);
  [[nodiscard]] bool flies_our_plan() const;
  [[nodiscard]] bool leads_elsewhere() const;
  void begin_halt(effects& out, instant now);
  void drop_change(effects& out);

  flight_context& flight_;
  phase_machine& phases_;
  task_control& tasks_;
  plan_changes& changes_;
  homecoming& returns_;
  control_watch& watch_;
};

} // namespace godwit::executor
