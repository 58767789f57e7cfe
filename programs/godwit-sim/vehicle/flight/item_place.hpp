// Where an item of a mission lies. Thread: pure. Source: MAV_FRAME and MISSION_ITEM_INT of MAVLink's common.xml.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "io/mavlink/messages/mission_transfer.hpp"
#include "programs/godwit-sim/vehicle/world/position.hpp"

namespace godwit::sim {

struct item_place {
  position at;
  bool is_here = false;          // the item has no place of its own: where the vehicle is
  bool has_own_altitude = false; // otherwise that of the vehicle
};

// Frames 0 and 5 count altitudes from mean sea level, 3, 6 and (for want of hills) 10 and 11 from home; 2 has no
// position. The largest integer as a coordinate means here, as does 0, 0 for take-off, landing and loiter, and then an
// altitude of 0 is none either. The error is a sentence for people: no such frame, or not on Earth.
[[nodiscard]] tl::expected<item_place, std::string> place_of(const io::mavlink::mission_item_int& item,
                                                             const position& home, const position& here);

} // namespace godwit::sim
