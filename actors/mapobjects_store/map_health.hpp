// How the map is, in one word and a sentence for people. Thread: pure.
#pragma once

#include <optional>
#include <string>

#include "actors/mapobjects_store/map_access.hpp"
#include "messages/mapobjects_store/status.hpp"

namespace godwit::mapobjects_store {

enum class wellness { well, impaired, bad };

struct map_health {
  wellness how = wellness::well;
  std::string reason;
  friend bool operator==(const map_health&, const map_health&) = default;
};

// KNOWN: nothing before it was looked at for the first time. Bad is only what keeps observations from being stored: an
// old map is the operator's to judge, in preflight.
[[nodiscard]] map_health health_of(const map_result<map_writer_status>& writer, const std::optional<map_status>& known);

} // namespace godwit::mapobjects_store
