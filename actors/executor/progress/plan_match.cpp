#include "actors/executor/progress/plan_match.hpp"

#include "io/mavlink/enums.hpp"
#include "runtime/planted_bug.hpp"

namespace godwit::executor::progress {

namespace {

constexpr std::uint16_t total_of_no_plan = 65535;
constexpr std::uint16_t total_not_told = 0;

bool says_no_plan(const io::mavlink::mission_current& message) {
  return message.total == total_of_no_plan ||
         message.mission_state == io::mavlink::number(io::mavlink::mission_state::no_mission);
}

bool is_infeasible(const io::mavlink::mission_current& message, const followed_plan& plan) {
  return plan.vehicle_plan_id && message.mission_id == *plan.vehicle_plan_id && message.total == plan.map.total &&
         message.mission_state == io::mavlink::number(io::mavlink::mission_state::no_mission);
}

} // namespace

plan_match match_of(const io::mavlink::mission_current& message, const followed_plan& plan) {
  if (GODWIT_PLANTED(old_plans_progress))
    return plan_match::ours;
  if (is_infeasible(message, plan))
    return plan_match::infeasible;
  if (says_no_plan(message))
    return plan_match::other;
  if (plan.vehicle_plan_id) {
    if (message.mission_id == 0)
      return plan_match::not_told;
    return message.mission_id == *plan.vehicle_plan_id ? plan_match::ours : plan_match::other;
  }
  if (message.mission_id != 0 && message.mission_id == plan.id_before)
    return plan_match::other;
  return message.total == total_not_told || message.total == plan.map.total ? plan_match::ours : plan_match::other;
}

bool may_be_uploaded(const io::mavlink::mission_current& message, const pending_upload& upload) {
  return message.mission_id != 0 && message.mission_id != upload.intent.id_before;
}

} // namespace godwit::executor::progress
