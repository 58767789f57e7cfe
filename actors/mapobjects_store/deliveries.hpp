// What is owed to the missions service, handed over in batches. The way of a batch and the states of a row are told in
// messages/mapobjects_store/delivery.hpp. Thread: the one of the database.
#pragma once

#include <optional>
#include <vector>

#include "actors/mapobjects_store/map_row.hpp"
#include "actors/mapobjects_store/map_tables.hpp"
#include "messages/mapobjects_store/delivery.hpp"
#include "messages/mapobjects_store/observation.hpp"

namespace godwit::mapobjects_store {

// Rows in one batch: bounds the transaction and the message. The service is told of 500 at a time.
inline constexpr std::size_t max_taken = 1000;

// Batches that are taken and neither delivered nor orphaned. A deliverer has a few under way.
inline constexpr std::int64_t max_open_batches = 256;

// So many keys of delivered batches are remembered, so that a take that comes late does not take rows under a key that
// the service knows already.
inline constexpr std::int64_t max_delivered_keys = 1000;

[[nodiscard]] map_result<batch> take(map_tables& t, const take_batch& asked);

// Answered in one list. Those whose mission is gone lie until a person delivers them.
inline constexpr std::int64_t max_listed_batches = 1024;

// Oldest first, at most max_listed_batches.
[[nodiscard]] map_result<std::vector<open_batch>> all_open(sql& q);

[[nodiscard]] map_result<void> deliver(map_tables& t, const batch_delivered& said);

[[nodiscard]] map_result<void> give_back(map_tables& t, const return_batch& said);

// One line for each mission and destination that has something.
[[nodiscard]] map_result<std::vector<owed>> all_owed(sql& q);

// Observations as rows. Thread: the one of the database.

// From a SELECT that has the columns of an observation first, in the order of its fields.
[[nodiscard]] observation observation_of(const sql::row& row);

// Also one that was orphaned since.
[[nodiscard]] map_result<std::optional<observation>> observation_with(sql& q, const std::string& id);

// As pending; answers its number. The id is not known yet.
[[nodiscard]] map_result<std::int64_t> add_observation(sql& q, const observation& what);

// Whether something other than a missing was observed of the object from then on.
[[nodiscard]] map_result<bool> was_seen(sql& q, const std::string& object_id, std::int64_t since_ns);

} // namespace godwit::mapobjects_store
