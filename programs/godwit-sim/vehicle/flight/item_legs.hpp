// What a NAV item of a mission means for a vehicle.
//
// | Item | Multirotor | Fixed wing | Rover |
// |---|---|---|---|
// | waypoint, spline waypoint | there, hold | there, or past it; no hold | there, hold |
// | loiter: unlimited, time, turns | there, wait; the time that the turns take | the same, on circles | there, wait |
// | take-off | up, then there | straight on and up | skipped |
// | land | there, down | straight down to there, and stays: no end | there, stop |
// | return to launch | up to the return altitude, home, down | home, circles: no end | home, stop |
// | delay | wait | circles | wait |
// | loiter to altitude | there, then up or down | the same, circling | skipped |
// | VTOL take-off and landing | as take-off and landing | the same | the same |
// | ... of a VTOL | up on its rotors; 90 m before the place to its rotors, there, down | | |
// | continue and change altitude | skipped | straight on and up | skipped |
// | payload place | there, and on | the same | the same |
//
// A multirotor on the ground takes off first, to the altitude of the item; a fixed wing stays on the ground.
// A VTOL is in between what its mission wants it to be and what it is: it changes before it goes to the place. A
// take-off is on its rotors but for a quadplane's NAV_TAKEOFF. Thread: pure. Source: recordings of PX4's standard VTOL
// (1.18) and a quadplane (ArduPlane 4.7), which changed 93 m before the place of its landing; MAV_CMD of MAVLink's
// common.xml; ArduPlane's verify_land and do_loiter_time, which takes its own radius for all circles but those of
// loiter turns.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "io/mavlink/messages/mission_transfer.hpp"
#include "programs/godwit-sim/vehicle/flight/maneuver.hpp"
#include "programs/godwit-sim/vehicle/flight/mover.hpp"

namespace godwit::sim {

struct item_setting {
  const mover& vehicle;
  position home;
  position here; // where the item began: what `here` means for it, also when it goes on after a pause
  pace how_fast;
  bool goes_on = true; // another item follows at once: it need not stop
  bool hovers = false; // a VTOL: its mission wants it on its rotors
};

// The error says why the vehicle does not fly it.
[[nodiscard]] tl::expected<leg_list, std::string> legs_of(const io::mavlink::mission_item_int& item,
                                                          const item_setting& setting);

// To a place, from the ground or in the air.
[[nodiscard]] leg_list legs_to(const go_leg& place, const mover& vehicle);
// To the return altitude, home or to a rally point that is nearer, and down; a rover: there; a fixed wing: circles over
// it. On the ground who flies is back. Seen of PX4 1.17: 33 m from home.
[[nodiscard]] leg_list legs_home(const position& home, const mover& vehicle);

} // namespace godwit::sim
