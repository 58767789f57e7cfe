// A plan of QGroundControl (`.plan`: fileType Plan, version 1; mission of version 1 or 2, fence and rally points of
// version 2) to a mission; so is a `.mission` file, from before there were plans.
//
//   SimpleItem              as item_import.hpp says; seven parameters, or in older files four and a coordinate, or
//                           param1 to param4 and a coordinate (mission of version 1)
//   survey                  a survey, if it is flown at one height above home over a polygon with lines that do not
//                           cross; else the lines that the ground station had laid, as waypoints
//   CorridorScan            the lines that the ground station had laid, as waypoints
//   fwLandingPattern, vtolLandingPattern
//                           the commands that the ground station lays for it
//   StructureScan           left out, as a loss
//   fence polygons          geofences; circles are judged by polygons within them (inclusions) or around them
//   rally points            rally points
//   planned home position   the planned home: compared with the vehicle's, and never flown to; 0/0 is none
//
// Speeds of the file's head are not read; firmware and type are the vehicle of the mission. Errors: as
// values; the losses are in the error when it is `lossy`. Thread: pure. Source: QGroundControl's developer guide, "Plan
// File Format".
#pragma once

#include <cstddef>
#include <string_view>

#include "actors/domain/mission/convert/conversion.hpp"

namespace godwit::mission {

inline constexpr std::size_t max_plan_bytes = 16 * 1024 * 1024;
inline constexpr std::size_t max_plan_items = 20'000; // with those of the patterns

[[nodiscard]] import_result import_plan(std::string_view text, const import_options& options = {});

} // namespace godwit::mission
