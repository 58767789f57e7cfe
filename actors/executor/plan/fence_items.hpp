// The fences of a mission as items for the vehicle's own fence: its last line, where neither godwit nor a person acts.
//
// The vehicle must hold nothing for a breach that godwit lets it fly: what its fence can not say as wide as the mission
// does is left out, and said.
//
//   a circle                      a circle
//   inclusion                     a polygon, without its floor and ceiling: wider than the mission's
//   several of them               left out: a vehicle has to be inside of all, and the mission means one of them
//   exclusion                     a polygon
//   with a floor or a ceiling     left out: the vehicle may fly over or under it, and its polygon is for all altitudes
//
// Pure. Source: MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION (5001), _EXCLUSION (5002); ArduPilot's FENCE_OPTIONS; PX4's
// Geofence::checkPolygons, which asks each polygon.
#pragma once

#include <string>
#include <vector>

#include "io/mavlink/messages/mission_transfer.hpp"
#include "messages/mission/document.hpp"

namespace godwit::executor::plan {

struct fence_list {
  std::vector<io::mavlink::mission_item_int> items; // numbered from 0
  std::vector<std::string> left_out;                // why, a sentence each; at most one of each kind
};

[[nodiscard]] fence_list fence_items(const std::vector<mission::geofence>& fences);

// After a fence, where the mission has one; a fence without items needs none.
void append_return_point(fence_list& to, const mission::document& mission);

[[nodiscard]] std::vector<io::mavlink::mission_item_int> rally_items(const mission::document& mission);

} // namespace godwit::executor::plan
