// Distances and directions as people read them: "350 m", "12.4 km", "16,600 km", "south-east".
//
// Rounded, so that a sentence does not change with each position of a vehicle that stands: to 1 m below 100 m, to 10 m
// below 1 km, to 100 m below 100 km, else to three digits. Thread: pure.
#pragma once

#include <string>
#include <string_view>

namespace godwit::geo {

// METRES are finite and not negative.
[[nodiscard]] std::string distance_text(double metres);

// The nearest of the eight points of the compass; BEARING_DEG clockwise from north.
[[nodiscard]] std::string_view direction_text(double bearing_deg);

// A whole number with a comma between each three digits: "11,000".
[[nodiscard]] std::string grouped(double value);

} // namespace godwit::geo
