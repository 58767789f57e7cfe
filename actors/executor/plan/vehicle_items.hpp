// The items of a plan in the words of the vehicle (MISSION_ITEM_INT).
//
// Positions are in frame 3, metres above the vehicle's home; commands without a position in frame 2. What is not given
// is NaN where MAVLink has it so, and 0 for ArduPilot, which refuses items with NaN. ArduPilot keeps waiting times as
// whole seconds in 16 bits: they are rounded up, so that nobody waits less than was asked for. Thread: pure. Source:
// MAVLink's common.xml, MAV_CMD; ArduPilot's AP_Mission, mavlink_int_to_mission_cmd.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "actors/executor/plan/setting.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "messages/mission/item.hpp"
#include "messages/mission/place.hpp"

namespace godwit::executor::plan {

using io::mavlink::mission_item_int;

[[nodiscard]] bool is_ardupilot(const plan_setting& setting);
// The plan begins with home, which has sequence 0 and is not flown to.
[[nodiscard]] bool keeps_home_as_item(const plan_setting& setting);
// The command locks home until the autopilot starts again, the item does not.
[[nodiscard]] bool sets_home_in_plan(const plan_setting& setting);
[[nodiscard]] double longest_wait_s(const plan_setting& setting);

[[nodiscard]] mission_item_int home_item(const plan_setting& setting);
// Moves home there when the plan comes to it.
[[nodiscard]] mission_item_int set_home_item(const plan_setting& setting);
[[nodiscard]] mission_item_int takeoff_item(const mission::position& towards, const plan_setting& setting);
[[nodiscard]] mission_item_int waypoint_item(const mission::position& at, double hold_s, double accept_radius_m,
                                             const plan_setting& setting);
[[nodiscard]] mission_item_int loiter_item(const mission::position& at, double duration_s, double radius_m,
                                           const plan_setting& setting);
[[nodiscard]] mission_item_int land_item(const mission::position& at, const plan_setting& setting);
[[nodiscard]] mission_item_int return_item();
[[nodiscard]] bool is_return_item(const mission_item_int& item);
[[nodiscard]] mission_item_int speed_item(double mps, const plan_setting& setting);
[[nodiscard]] mission_item_int landing_start_item();

// As it came. What is not given is NaN, and the largest coordinate, for PX4; 0 for ArduPilot, which refuses NaN. A
// height above home counts from the mission's own home, as in all items.
[[nodiscard]] mission_item_int command_item_of(const mission::command_item& item, const plan_setting& setting);
// Of a command with an altitude: above the place that the mission counts from. Above the ground is taken for above
// home.
[[nodiscard]] double altitude_of(const mission::command_item& item, const plan_setting& setting);
// Its target is filled in when all sequences are known.
[[nodiscard]] mission_item_int jump_item(std::int32_t times);

// What an item does to a camera that takes pictures by itself.
struct trigger_change {
  enum class by { distance, time };
  by how = by::distance;
  double value = 0; // metres by distance; by time 1: on; 0: it is switched off
};
// Nothing: it leaves it as it is. A single picture does, too.
[[nodiscard]] std::optional<trigger_change> trigger_change_of(std::uint16_t command, double param1, double param3);
[[nodiscard]] inline std::optional<trigger_change> trigger_change_of(const mission_item_int& item) {
  return trigger_change_of(item.command, item.param1, item.param3);
}

// What ends the pictures by distance or time that ITEMS have begun before SEQUENCE, and not ended. Nothing: there are
// none.
[[nodiscard]] std::optional<mission_item_int> camera_to_stop(std::span<const mission_item_int> items,
                                                             std::size_t sequence);

// The speed, region of interest and gimbal that ITEMS have set before SEQUENCE, each as it was set last.
[[nodiscard]] std::vector<mission_item_int> state_at(std::span<const mission_item_int> items, std::size_t sequence);

// It moves the vehicle, or holds it in its place for a time.
// So many seconds the vehicle stays for it, as far as it says so.
[[nodiscard]] double wait_of(const mission_item_int& item, const plan_setting& setting);
[[nodiscard]] bool is_nav(const mission_item_int& item);

// Vehicles take latitude and longitude 0 for "here".
[[nodiscard]] bool is_nowhere(const mission::position& at);

} // namespace godwit::executor::plan
