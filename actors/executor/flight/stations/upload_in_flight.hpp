// A plan that a station uploads in flight: while its own flight is held it takes the place of the one on the vehicle.
//
//   the station   pause ──> held ──> upload ──> (choose an item) ──> start, or resume
//   godwit                            └─> revision + 1, brought to the vehicle as it holds;
//                                       plan_judged when it is there
//
// An upload never moves the vehicle: it holds before and after it, and goes on at a person's word. What flies begins
// after the take-off of the new plan. The fences are those of the flight. Pure. Thread: one at a time. Source:
// docs/decisions/plans.md.
#pragma once

#include <string>

#include "actors/executor/flight/task_control.hpp"

namespace godwit::executor {

class upload_in_flight {
public:
  upload_in_flight(flight_context& flight, task_control& tasks) : flight_(flight), tasks_(tasks) {}

  // Of BY; empty: it is looked at.
  [[nodiscard]] std::string why_not(const station& by, bool has_looked) const;
  // Empty: it is on its way to the vehicle; what becomes of it is told as plan_judged, also over a crash. Else why not.
  [[nodiscard]] std::string begin(effects& out, const station_plan_taken& next, instant now);

  // A start after it waits for its last steps: its station has heard already that the plan is on the vehicle.
  [[nodiscard]] bool is_under_way() const;

private:
  flight_context& flight_;
  task_control& tasks_;
};

} // namespace godwit::executor
