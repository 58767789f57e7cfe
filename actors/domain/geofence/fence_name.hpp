// What people are told a fence is called: "geofence 2" is the second one in the list of the mission, everywhere.
//
// In data a fence is its index in that list, from 0 on. Thread: pure.
#pragma once

#include <cstddef>
#include <string>

namespace godwit::geofence {

[[nodiscard]] inline std::string fence_name(std::size_t index) { return "geofence " + std::to_string(index + 1); }

} // namespace godwit::geofence
