// The version of the contract that a mission states, when something is added to it. Thread: pure.
#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "messages/mission/document.hpp"

namespace godwit::mission {

// A service that sends missions of this version takes `outcome` and `pictures` in a report (2.1).
[[nodiscard]] inline bool knows_outcomes(std::string_view stated) {
  return !stated.empty() && !stated.starts_with("1.") && !stated.starts_with("2.0.");
}

// Such a service takes pictures of what was observed (2.2).
[[nodiscard]] inline bool takes_pictures(std::string_view stated) {
  return knows_outcomes(stated) && !stated.starts_with("2.1.");
}

// Such a service gives its map marks, and tells what has changed since one (2.3).
[[nodiscard]] inline bool gives_marks(std::string_view stated) {
  return takes_pictures(stated) && !stated.starts_with("2.2.");
}

// A mission states version 2 when something in it needs that.
inline void raise_version(document& value) {
  if (needs_version_2(value) && value.schema_version.starts_with("1."))
    value.schema_version = schema_version_2;
}

// Fences that come on their own take the place of those that the mission has.
inline void put_fences(document& value, std::vector<geofence> fences, std::optional<position> breach_return_point) {
  value.geofences = std::move(fences);
  value.breach_return_point = breach_return_point;
  raise_version(value);
}

} // namespace godwit::mission
