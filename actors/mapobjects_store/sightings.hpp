// A sighting becomes an observation, and changes the map. Thread: the one of the database.
#pragma once

#include <optional>
#include <vector>

#include "actors/mapobjects_store/map_tables.hpp"
#include "messages/mapobjects_store/object.hpp"
#include "messages/mapobjects_store/observation.hpp"
#include "messages/mapobjects_store/operator_verdict.hpp"

namespace godwit::mapobjects_store {

// Said again with the same id, the answer is the same and nothing changes.
[[nodiscard]] map_result<observed> record(map_tables& t, const sighting& seen);

// What the operator does not want to hear of again: class groups in cells. Thread: the one of the database.

// A cell of any size from 1 m to 10 km around AT may be on the list.
[[nodiscard]] map_result<bool> is_ignored(map_tables& t, const geo_position& at, const std::string& class_group);

// A decline puts the cell of what was shown on the list and says what it put there; all else changes nothing.
[[nodiscard]] map_result<std::optional<ignored_item>> judge(map_tables& t, const operator_verdict& said);

// From a SELECT that has the columns of an ignored item first, in the order of its fields.
[[nodiscard]] ignored_item ignored_item_of(const sql::row& row);

} // namespace godwit::mapobjects_store
