#include "actors/failsafe/health.hpp"

#include <algorithm>
#include <string_view>

namespace godwit::failsafe {

namespace {

class summary {
public:
  void add(wellness how, std::string_view sentence) {
    result_.how = std::max(result_.how, how);
    if (!result_.reason.empty())
      result_.reason += "; ";
    result_.reason += sentence;
  }
  [[nodiscard]] const health_changed& result() const { return result_; }

private:
  health_changed result_;
};

void add_vehicle(const findings& all, summary& out) {
  if (!all.flight.link_up) {
    out.add(wellness::impaired, "the autopilot is not heard: only its own failsafes act");
    return;
  }
  if (all.what == vehicle_class::unknown)
    out.add(wellness::bad, "it is not known what kind of vehicle this is, and so no failsafe can act");
  if (!all.flight.landed_known)
    out.add(wellness::impaired, "it is not known whether the vehicle is in the air, and so no failsafe can act");
}

void add_senses(const findings& all, summary& out) {
  if (!all.battery.known)
    out.add(wellness::impaired, "what is left in the battery is not known");
  if (all.fences == fence_finding::no_verdict)
    out.add(wellness::impaired, "the position is too old to judge the fences");
  if (all.fences == fence_finding::breached)
    out.add(wellness::impaired, "the vehicle is beyond a fence");
  if (all.limits_refused)
    out.add(wellness::bad, "the fences of the mission were refused");
  if (all.link == link_phase::degraded || all.link == link_phase::lost)
    out.add(wellness::impaired, "the operator's ground station is silent");
}

} // namespace

health_changed judge_health(const findings& all) {
  summary out;
  add_vehicle(all, out);
  add_senses(all, out);
  if (all.taken_over)
    out.add(wellness::impaired, "a pilot has the vehicle");
  if (all.reacts && all.reacts->stage == reaction_stage::failing)
    out.add(wellness::bad, "what the failsafe wants does not get through to the vehicle");
  else if (all.reacts)
    out.add(wellness::impaired, "a failsafe has acted: " + std::string(io::name_of(all.reacts->why)));
  return out.result();
}

} // namespace godwit::failsafe
