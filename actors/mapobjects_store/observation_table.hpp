// Observations as rows. Thread: the one of the database.
#pragma once

#include <optional>

#include "actors/mapobjects_store/sql.hpp"
#include "messages/mapobjects_store/observation.hpp"

namespace godwit::mapobjects_store {

// From a SELECT that has the columns of an observation first, in the order of its fields.
[[nodiscard]] observation observation_of(const sql::row& row);

// Also one that was orphaned since.
[[nodiscard]] map_result<std::optional<observation>> observation_with(sql& q, const std::string& id);

// As pending; answers its number. The id is not known yet.
[[nodiscard]] map_result<std::int64_t> add_observation(sql& q, const observation& what);

// Whether something other than a missing was observed of the object from then on.
[[nodiscard]] map_result<bool> was_seen(sql& q, const std::string& object_id, std::int64_t since_ns);

} // namespace godwit::mapobjects_store
