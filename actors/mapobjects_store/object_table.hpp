// The objects of the map as rows, and which of them count now.
//
// Loaded objects and what was seen here lie apart. An object that was moved here has a row in both: the one that was
// seen hides the loaded one until a later load contains the move. Thread: the one of the database.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "actors/domain/geo/bounding_box.hpp"
#include "actors/domain/geo/point.hpp"
#include "actors/mapobjects_store/map_row.hpp"
#include "actors/mapobjects_store/map_tables.hpp"
#include "messages/mapobjects_store/object.hpp"
#include "messages/mapobjects_store/observation.hpp"

namespace godwit::mapobjects_store {

// The two R*Trees over the places of loaded objects: one is shown, the next load fills the other one.
//
// Names of tables can not be bound, so each statement on a tree is there twice. Thread: the one of the database.
using by_tree = std::array<const char*, 2>;

[[nodiscard]] inline const char* of_tree(const by_tree& texts, std::int64_t tree) {
  return tree == 0 ? texts[0] : texts[1];
}

[[nodiscard]] inline std::int64_t other_tree(std::int64_t tree) { return 1 - tree; }

// Empty afterwards, at once: a tree has no faster way than to be made anew. For 100,000 places 2 ms.
[[nodiscard]] map_result<void> clear_tree(sql& q, std::int64_t tree);

[[nodiscard]] map_result<void> add_place(sql& q, std::int64_t tree, const loaded_place& place);

// Which known object a sighting is, and what that makes of it.
//
// The nearest candidate within reach; of equally near ones the one with the smallest id, so that the order in which
// candidates came on the map, or are read from it, does not matter. Distances are geodesic, altitude does not count.
// Thread: pure.

// A known object of the sighting's class group.
struct candidate {
  std::string id;
  geo::point at;
};

struct match {
  std::size_t index = 0; // among the candidates
  double distance_m = 0;
};

[[nodiscard]] std::optional<match> nearest_match(const geo::point& seen_at, std::span<const candidate> candidates,
                                                 const settings& rules);

// IGNORED: the ignore list names the cell of the sighting, or that of the object which it is.
[[nodiscard]] observation_kind kind_of(const std::optional<match>& found, bool ignored, const settings& rules);

// Whether an observation of this kind is news for the operator.
[[nodiscard]] bool is_finding(observation_kind kind);

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
