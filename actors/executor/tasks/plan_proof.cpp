#include "actors/executor/tasks/plan_proof.hpp"

#include "io/mavlink/enums/vehicle.hpp"
#include "io/mavlink/plan_meaning.hpp"

namespace godwit::executor {

vehicle_link::download_plan proof_request(const progress::followed_plan& plan) {
  vehicle_link::download_plan result;
  result.id_suffices = plan.vehicle_plan_id.has_value();
  return result;
}

bool holds_flown_plan(const state& s, const vehicle_link::transfer::outcome& read, const flight::mode_owner& whose) {
  const auto& items = s.flown->items;
  if (read.proof == vehicle_link::transfer::proof::plan_id)
    return read.plan_id == s.progress.plan->vehicle_plan_id && read.items_on_vehicle == items.size();
  const bool has_home = whose.autopilot == io::mavlink::mav_autopilot::ardupilotmega;
  return !io::mavlink::first_difference(items, read.items, has_home);
}

} // namespace godwit::executor
