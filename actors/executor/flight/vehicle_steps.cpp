#include "actors/executor/flight/vehicle_steps.hpp"

#include <utility>

#include "actors/executor/remaining.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::executor {
namespace {

using flight::mode_kind;
using io::mavlink::mav_autopilot;

// A vehicle that is left in its mission mode on the ground would begin what it holds as soon as somebody arms it (PX4),
// or does not begin at all when it is started in the mode in which it is (ArduPilot's rover).
steps out_of_mission_steps(const flight_context& flight) {
  const bool stands_after_it = flight.view.says_complete() && !flight.is_in_air();
  if (!flight.view.is_in(mode_kind::mission) || (flight.view.is_armed() && !stands_after_it))
    return {};
  return {safe_ground_mode{flight.view.is_armed()}};
}

// An ArduPilot counts its jumps by their place in the plan, also in a plan that has replaced another one, until it is
// set back to its very beginning.
set_current_item set_to(const flight_context& flight, const progress::plan_map& map, std::uint16_t sequence) {
  return {sequence, map.total, flight.is_ardupilot() && sequence == map.first_sequence};
}

steps way_to_plan(const flight_context& flight, const progress::plan_map& map, bool goes_on, bool is_same) {
  if (!flight.is_in_flight()) {
    steps result = out_of_mission_steps(flight);
    if (flight.view.finds_infeasible())
      result.emplace_back(clear_plan{});
    result.emplace_back(upload_plan{});
    return result;
  }
  if (flight.view.owner().autopilot == mav_autopilot::px4) {
    steps result;
    if (!goes_on && flight.view.is_in(mode_kind::mission))
      result = {guard{}, change_mode{mode_kind::hold}};
    result.emplace_back(upload_plan{});
    result.emplace_back(guard{});
    if (goes_on && is_same && flight.view.says_complete()) // it is not begun anew, and would be held
      result.emplace_back(set_to(flight, map, map.start_sequence));
    if (goes_on)
      result.emplace_back(change_mode{mode_kind::mission});
    return result;
  }
  // Whose hold that is, is on the disk first.
  steps result{guard{}, change_mode{mode_kind::hold}, upload_plan{}, guard{}};
  if (flight.is_ardupilot()) {
    result.emplace_back(set_to(flight, map, map.start_sequence));
    if (goes_on)
      result.emplace_back(change_mode{mode_kind::mission});
  } else if (goes_on) {
    result.emplace_back(start_plan{map.start_sequence});
  }
  return result;
}

} // namespace

bool starts_in_mission_mode(const flight_context& flight) {
  const auto autopilot = flight.view.owner().autopilot;
  return autopilot != mav_autopilot::px4 && autopilot != mav_autopilot::ardupilotmega;
}

steps start_steps(const flight_context& flight, std::uint16_t sequence) {
  steps result{guard{}};
  const bool commands_home = flight.commands_home();
  if (commands_home)
    result.emplace_back(restore_home{});
  if (!flight.view.is_armed()) {
    for (auto& each : out_of_mission_steps(flight))
      result.push_back(std::move(each));
    if (flight.is_copter())
      result.emplace_back(change_mode{mode_kind::guided});
    result.emplace_back(arm{});
  }
  if (commands_home)
    result.emplace_back(confirm_home{});
  // In its mission mode a PX4 goes on where it was in the same plan, or is through with it: it is told where to begin.
  const auto& current = flight.view.current();
  const bool goes_on_elsewhere = flight.view.owner().autopilot == mav_autopilot::px4 && current &&
                                 (current->seq != sequence || flight.view.says_complete());
  const auto& map = flight.s.progress.plan->map;
  const bool is_chosen = sequence != map.start_sequence && !starts_in_mission_mode(flight);
  const bool may_have_counts = flight.is_ardupilot() && (map.enters_at || !map.loops.empty());
  if (!is_chosen && may_have_counts)
    result.emplace_back(set_to(flight, map, map.start_sequence));
  else if (is_chosen || goes_on_elsewhere)
    result.emplace_back(set_current_item{sequence});
  result.emplace_back(start_plan{sequence});
  return result;
}

steps jump_steps(const flight_context& flight, std::uint16_t sequence) {
  if (starts_in_mission_mode(flight))
    return {start_plan{sequence}};
  if (going_on_mode(flight) == mode_kind::returning && sequence == last_flown_item(flight.s)->seq)
    return {change_mode{mode_kind::returning}};
  return {set_current_item{sequence}, change_mode{mode_kind::mission}};
}

steps deploy_steps(const flight_context& flight, const progress::plan_map& map, bool goes_on, bool is_same) {
  auto result = way_to_plan(flight, map, goes_on, is_same);
  if (flight.is_failsafe_gone) // nobody is there who would take the limits, and what is brought then is the way home
    std::erase_if(result, [](const step& each) { return std::holds_alternative<guard>(each); });
  return result;
}

mode_kind going_on_mode(const flight_context& flight) {
  const bool is_px4 = flight.view.owner().autopilot == mav_autopilot::px4;
  return is_px4 && flight.is_in_return_of_plan() ? mode_kind::returning : mode_kind::mission;
}

steps going_on_steps(const flight_context& flight) {
  const auto& plan = flight.s.progress.plan;
  const bool is_new =
      plan && !plan->generation.was_active && plan->generation.origin != progress::generation_origin::start;
  if (is_new && starts_in_mission_mode(flight))
    return {start_plan{plan->generation.start_sequence}};
  const bool is_finished =
      is_new && plan->generation.origin == progress::generation_origin::same_plan && flight.view.says_complete();
  if (is_new && (flight.is_ardupilot() || is_finished)) // it goes on where it was in the plan before
    return at_start_steps(flight, false);
  return {change_mode{is_new ? mode_kind::mission : going_on_mode(flight)}};
}

steps at_start_steps(const flight_context& flight, bool may_start) {
  const auto& plan = *flight.s.progress.plan;
  const auto start = plan.generation.start_sequence;
  if (may_start && starts_in_mission_mode(flight))
    return {start_plan{start}};
  return {set_to(flight, plan.map, start), change_mode{mode_kind::mission}};
}

} // namespace godwit::executor
