// How the map is, in one word and a sentence for people. Thread: pure.
#pragma once

#include <optional>
#include <string>

#include "actors/mapobjects_store/map_access.hpp"
#include "actors/mapobjects_store/map_tables.hpp"
#include "messages/mapobjects_store/status.hpp"
#include "runtime/condition.hpp"

namespace godwit::mapobjects_store {

// KNOWN: nothing before it was looked at for the first time. Bad is only what keeps observations from being stored: an
// old map is the operator's to judge, in preflight.
[[nodiscard]] runtime::condition health_of(const map_result<map_writer_status>& writer,
                                           const std::optional<map_status>& known);

// How the map is, counted. Thread: the one of the database.

// Looks at each row that is owed: some 5 ms for 50,000.
[[nodiscard]] map_result<map_status> summary(map_tables& t);

} // namespace godwit::mapobjects_store
