// One row for each MAV_CMD that can be met in a mission of a ground station: what it is called, what kind of thing it
// does, whether it has a place, which vehicles take it as an item, and which state of the vehicle it sets.
//
//   class     examples                                    a direct upload of it
//   moves     waypoint, loiter, take-off, land, spline    flies somewhere
//   acts      camera, gimbal, gripper, servo, speed       does something where the vehicle is
//   waits     NAV_DELAY, CONDITION_*                      holds back what follows
//   flow      DO_JUMP, JUMP_TAG, DO_LAND_START            changes what comes next, or where a return leads
//   guarded   DO_SET_HOME, DO_FENCE_ENABLE, parachute     can not be judged before the flight, or takes protection away
//   never     COMPONENT_ARM_DISARM, FLIGHTTERMINATION     stops motors or changes the mode: no mission may hold it
//   fence     NAV_FENCE_*                                 belongs to the fence, not to the items
//   rally     NAV_RALLY_POINT                             belongs to the rally points
//
// Thread: constants, pure. Source: acknowledgements of ArduPilot 4.7.0-dev and PX4 1.18.0-beta1, each command as an
// item of its own; MAVLink's common.xml, MAV_CMD. A number without a row is unknown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "messages/mission/vehicle_profile.hpp"

namespace godwit::mission {

enum class command_class { moves, acts, waits, flow, guarded, never, fence, rally };

// What a command sets for all that follows it, and what a vehicle forgets when it lands, starts again or gets another
// plan. The rest of a mission sets it again; outputs of servos, relays and grippers stay as they are, and are no state.
enum class command_state { none, speed, trigger, roi, gimbal };

enum class item_answer {
  taken,   // acknowledged, and executed
  skipped, // acknowledged, and passed over in flight
  refused  // the whole mission is refused for it
};

struct command_row {
  std::uint16_t id;
  std::string_view name;
  command_class kind;
  bool has_place;           // x and y say where
  std::string_view answers; // t, s or -: taken, skipped or refused, by vehicle_profile
  command_state state = command_state::none;

  [[nodiscard]] item_answer answer_of(vehicle_profile vehicle) const {
    const auto found = answers[static_cast<std::size_t>(vehicle)];
    return found == 't' ? item_answer::taken : found == 's' ? item_answer::skipped : item_answer::refused;
  }
  // Some vehicle does not refuse it.
  [[nodiscard]] bool is_taken_by_anyone() const { return answers.find_first_not_of('-') != std::string_view::npos; }
};

// Null: the number is unknown.
[[nodiscard]] const command_row* command_of(std::uint16_t id);
// By its name without MAV_CMD_. Null: there is none.
[[nodiscard]] const command_row* command_named(std::string_view name);

} // namespace godwit::mission
