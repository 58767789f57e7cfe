// The plan that the vehicle had before one that it can not fly.
#include "actors/executor/flight/plan_changes.hpp"

namespace godwit::executor {

bool plan_changes::bring_plan_before(effects& out, instant now) {
  const auto& s = flight_.s;
  if (!flight_.wanted.bring_back || flight_.runner.is_busy() || flight_.has_open_intent())
    return false;
  if (!flight_.may_plan(now) && flight_.is_in_flight())
    return false; // until the vehicle has sent where it is
  flight_.wanted.bring_back = false;
  if (!flight_.is_in_flight() || !flight_.is_held() || !s.mission)
    return false;
  const auto plan = flight_.plan_in_flight(*s.mission, now);
  if (plan)
    tasks_.begin_bring_back(out, *s.mission, *plan);
  else
    out.emplace_back(announce{"the plan before can not be brought back from here: " + plan.error(), true});
  return true;
}

} // namespace godwit::executor
