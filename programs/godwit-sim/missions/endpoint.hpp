// The calls of the contract, by the names that faults and figures use. Thread: values.
#pragma once

#include "io/fields/field_table.hpp"

namespace godwit::sim::missions {

enum class endpoint {
  get_mission,
  delete_mission,
  get_map_objects,
  post_map_objects,
  get_ignored,
  post_ignored,
  post_waypoints,
  post_tail,
  get_progress,
  post_progress,
  get_assignments,
  post_response,
  none, // no call of the contract
};

constexpr auto enum_names(endpoint) {
  return io::names<endpoint>({{endpoint::get_mission, "get-mission"},
                              {endpoint::delete_mission, "delete-mission"},
                              {endpoint::get_map_objects, "get-mapobjects"},
                              {endpoint::post_map_objects, "post-mapobjects"},
                              {endpoint::get_ignored, "get-ignored"},
                              {endpoint::post_ignored, "post-ignored"},
                              {endpoint::post_waypoints, "post-waypoints"},
                              {endpoint::post_tail, "post-tail"},
                              {endpoint::get_progress, "get-progress"},
                              {endpoint::post_progress, "post-progress"},
                              {endpoint::get_assignments, "get-assignments"},
                              {endpoint::post_response, "post-response"},
                              {endpoint::none, "none"}});
}

} // namespace godwit::sim::missions
