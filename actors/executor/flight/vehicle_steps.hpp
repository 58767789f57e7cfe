// What each class of vehicle needs for a task: the steps of starts, deployments and goings-on.
//
//   Copter    can not be armed in AUTO: guided first
//   PX4       activates a new plan itself, at the item that is marked in it
//   ArduPilot is held while its plan is replaced, and told where to go on
//   text      a vehicle by MAVLink's text alone stays in its mission mode when it holds, and goes on when it is started
//
// Pure. Thread: any.
#pragma once

#include "actors/executor/flight/flight_context.hpp"
#include "actors/executor/tasks/steps.hpp"

namespace godwit::executor {

// SEQUENCE: where the plan on the vehicle begins, or an item of it.
[[nodiscard]] steps start_steps(const flight_context& flight, std::uint16_t sequence);
// Of a flight under way: to this item of the plan that it flies.
[[nodiscard]] steps jump_steps(const flight_context& flight, std::uint16_t sequence);
// IS_SAME: the vehicle holds these very items.
[[nodiscard]] steps deploy_steps(const flight_context& flight, const progress::plan_map& map, bool goes_on,
                                 bool is_same);
// Into the plan that it flies. In the return with which that ends a PX4 has finished its mission, and would hold in the
// mission mode: it returns.
[[nodiscard]] flight::mode_kind going_on_mode(const flight_context& flight);
// Back into the plan that the vehicle holds, or into one that was brought to it in flight.
[[nodiscard]] steps going_on_steps(const flight_context& flight);
// To the first item of the plan. MAY_START: a vehicle by the text alone may be started for it.
[[nodiscard]] steps at_start_steps(const flight_context& flight, bool may_start);
// One by the text alone goes on only when it is started.
[[nodiscard]] bool starts_in_mission_mode(const flight_context& flight);
} // namespace godwit::executor
