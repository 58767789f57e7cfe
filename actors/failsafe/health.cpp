#include "actors/failsafe/health.hpp"

#include <algorithm>
#include <string_view>

namespace godwit::failsafe {

namespace {

class summary {
public:
  void add(runtime::health_colour how, std::string_view sentence) {
    result_.how = std::max(result_.how, how);
    if (!result_.reason.empty())
      result_.reason += "; ";
    result_.reason += sentence;
  }
  [[nodiscard]] const runtime::condition& result() const { return result_; }

private:
  runtime::condition result_;
};

void add_vehicle(const findings& all, summary& out) {
  if (!all.flight.link_up) {
    out.add(runtime::health_colour::yellow, "no connection to the autopilot: only its own failsafes act");
    return;
  }
  if (all.what == vehicle_class::unknown)
    out.add(runtime::health_colour::red, "it is not known what kind of vehicle this is, and so no failsafe can act");
  if (!all.flight.landed_known)
    out.add(runtime::health_colour::yellow,
            "it is not known whether the vehicle is in the air, and so no failsafe can act");
}

void add_senses(const findings& all, summary& out) {
  if (!all.battery.known)
    out.add(runtime::health_colour::yellow, "what is left in the battery is not known");
  if (all.fences == fence_finding::no_verdict)
    out.add(runtime::health_colour::yellow, "the position is too old to judge the fences");
  if (all.fences == fence_finding::breached)
    out.add(runtime::health_colour::yellow, "the vehicle is beyond a fence");
  if (all.limits_refused)
    out.add(runtime::health_colour::red, "the fences of the mission were refused");
  if (all.link == link_phase::degraded || all.link == link_phase::lost)
    out.add(runtime::health_colour::yellow, "the operator's ground station is silent");
}

} // namespace

runtime::condition judge_health(const findings& all) {
  summary out;
  add_vehicle(all, out);
  add_senses(all, out);
  if (all.taken_over)
    out.add(runtime::health_colour::yellow, "a pilot has the vehicle");
  if (all.reacts && all.reacts->stage == reaction_stage::failing)
    out.add(runtime::health_colour::red, "what the failsafe wants does not get through to the vehicle");
  else if (all.reacts)
    out.add(runtime::health_colour::yellow, "a failsafe has acted: " + std::string(io::name_of(all.reacts->why)));
  if (all.returns_by_plan)
    out.add(runtime::health_colour::yellow,
            "a failsafe has the vehicle return by a plan: " + std::string(io::name_of(*all.returns_by_plan)));
  return out.result();
}

} // namespace godwit::failsafe
