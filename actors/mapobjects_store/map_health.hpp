// How the map is, in one word and a sentence for people. Thread: pure.
#pragma once

#include <optional>
#include <string>

#include "actors/mapobjects_store/map_access.hpp"
#include "messages/mapobjects_store/status.hpp"
#include "runtime/condition.hpp"

namespace godwit::mapobjects_store {

// KNOWN: nothing before it was looked at for the first time. Bad is only what keeps observations from being stored: an
// old map is the operator's to judge, in preflight.
[[nodiscard]] runtime::condition health_of(const map_result<map_writer_status>& writer,
                                           const std::optional<map_status>& known);

} // namespace godwit::mapobjects_store
