// The objects of the map as rows, and which of them count now.
//
// Loaded objects and what was seen here lie apart. An object that was moved here has a row in both: the one that was
// seen hides the loaded one until a later load contains the move. Thread: the one of the database.
#pragma once

#include <vector>

#include "actors/domain/geo/bounding_box.hpp"
#include "actors/mapobjects_store/classification.hpp"
#include "actors/mapobjects_store/map_row.hpp"
#include "messages/mapobjects_store/object.hpp"

namespace godwit::mapobjects_store {

struct stored_object {
  std::int64_t number = 0; // among the loaded ones, or of the observation that has put it on the map
  bool is_loaded = false;
  map_object what;
};

// What of CLASS_GROUP counts now and lies in the boxes.
[[nodiscard]] map_result<std::vector<stored_object>>
objects_in(sql& q, const map_row& map, const std::vector<geo::bounding_box>& boxes, const std::string& class_group);

// The object as it counts now. LOADED_NUMBER: its row if it is a loaded one, which can not be found by the id.
[[nodiscard]] map_result<std::optional<stored_object>> object_with(sql& q, const map_row& map, const std::string& id,
                                                                   std::int64_t loaded_number);

// A load's, with a number that is not there yet. It is not on the map before it is in the tree that is shown.
[[nodiscard]] map_result<void> add_loaded(sql& q, const map_object& object, std::int64_t number);

// Seen here, by the observation with this number. What was seen of it before gives way.
[[nodiscard]] map_result<void> put_seen(sql& q, const map_object& object, std::int64_t number);
[[nodiscard]] map_result<void> remove_seen(sql& q, std::int64_t number);

// It is at its place still.
[[nodiscard]] map_result<void> note_seen_again(sql& q, const stored_object& object, std::int64_t at_ns);

// From a SELECT that has number, id, class_group, latitude_deg, longitude_deg, altitude_m, first_seen_ns, last_seen_ns,
// confidence and mission_id first.
[[nodiscard]] stored_object object_of(const sql::row& row, bool is_loaded);

} // namespace godwit::mapobjects_store
