// One sighting as a line of text:
//
//   {"id": "9a6c2b1e-0f4d-4b7a-8c3d-2e1f0a9b8c7d", "class_group": "vehicle", "latitude": 47.39895,
//   "longitude": 8.54722,
//    "altitude_m": 441.5, "confidence": 0.9, "at": "2026-05-04T10:15:44Z"}
//
// All but altitude_m (above mean sea level) has to be there, and nothing else may be. The id makes a line that is read
// again the same sighting. Errors: a sentence. Thread: pure.
#pragma once

#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "messages/mapobjects_store/observation.hpp"

namespace godwit::daemon {

inline constexpr std::size_t max_sighting_bytes = 4 * 1024; // a line has about 200

[[nodiscard]] tl::expected<mapobjects_store::sighting, std::string> read_sighting(std::string_view line,
                                                                                  const std::string& mission_id);

} // namespace godwit::daemon
