#include "actors/mapobjects_store/object_view.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include "actors/domain/geo/bounding_box.hpp"
#include "actors/mapobjects_store/object_table.hpp"

namespace godwit::mapobjects_store {
namespace {

// Of one table of objects and its tree of places. Parameters: the box, the pulled observation, how many are looked at
// at most, and how many of these are wanted. The trees keep floats, rounded outwards.
struct question {
  std::string count; // how many were looked at, and how many of these count
  std::string list;
  bool is_loaded = false;
};

// SCOPE narrows what is looked at, COUNTS what is shown of it.
question about(const std::string& objects, const std::string& places, const std::string& scope,
               const std::string& counts) {
  const auto numbers = "(SELECT b.number FROM " + places +
                       " b WHERE b.max_latitude_deg >= ?1 AND b.min_latitude_deg <= ?2 AND b.max_longitude_deg >= ?3 "
                       "AND b.min_longitude_deg <= ?4" +
                       scope + " LIMIT ?6)";
  const auto from = " FROM " + numbers + " n CROSS JOIN " + objects + " o ON o.number = n.number";
  return {"SELECT count(*), sum(" + counts + ")" + from,
          "SELECT o.number, o.id, o.class_group, o.latitude_deg, o.longitude_deg, o.altitude_m, o.first_seen_ns, "
          "o.last_seen_ns, o.confidence, ''" +
              from + " WHERE " + counts + " ORDER BY o.last_seen_ns DESC, o.number DESC LIMIT ?7",
          objects == "loaded_object"};
}

const question& about_seen() {
  static const auto result = about("seen_object", "seen_place", " AND b.number > ?5", "1");
  return result;
}

// An object that was moved here hides the loaded one.
const question& about_loaded(std::int64_t tree) {
  const char* const is_shown = "NOT EXISTS (SELECT 1 FROM seen_object h WHERE h.id = o.id AND h.number > ?5)";
  static const std::array both{about("loaded_object", "loaded_place_0", "", is_shown),
                               about("loaded_object", "loaded_place_1", "", is_shown)};
  return tree == 0 ? both[0] : both[1];
}

std::vector<geo::bounding_box> boxes_of(const map_part& part) {
  if (part.west_deg <= part.east_deg)
    return {{part.south_deg, part.north_deg, part.west_deg, part.east_deg}};
  return {{part.south_deg, part.north_deg, part.west_deg, 180}, {part.south_deg, part.north_deg, -180, part.east_deg}};
}

shown_object shown_of(const sql::row& row, bool is_loaded) {
  auto what = object_of(row, is_loaded).what;
  return {std::move(what.class_group), what.position, what.last_seen_ns, what.confidence, !is_loaded};
}

map_result<void> look_at(map_tables& t, const question& text, const geo::bounding_box& box, std::uint64_t most,
                         objects_found& found) {
  const auto pulled = t.map.pulled_observation;
  const auto count = [&found](sql::row& row) {
    found.is_all = found.is_all && static_cast<std::uint64_t>(row.integer(0)) <= max_counted_objects;
    const auto counted = row.is_null(1) ? 0 : static_cast<std::uint64_t>(row.integer(1));
    found.counted += std::min(counted, max_counted_objects);
  };
  return t.q
      .each(text.count, count, box.south_deg, box.north_deg, box.west_deg, box.east_deg, pulled,
            max_counted_objects + 1)
      .and_then([&] {
        return t.q.each(
            text.list, [&](sql::row& row) { found.list.push_back(shown_of(row, text.is_loaded)); }, box.south_deg,
            box.north_deg, box.west_deg, box.east_deg, pulled, max_counted_objects, most);
      });
}

} // namespace

map_result<objects_found> look_at_objects(map_tables& t, const get_objects& asked) {
  const std::uint64_t most = std::min(asked.limit, max_shown_objects);
  objects_found found;
  for (const auto& box : boxes_of(asked.within)) {
    auto done = look_at(t, about_seen(), box, most, found);
    if (done && t.map.has_copy())
      done = look_at(t, about_loaded(t.map.tree), box, most, found);
    if (!done)
      return tl::unexpected(std::move(done.error()));
  }
  std::ranges::stable_sort(found.list, std::ranges::greater(), &shown_object::last_seen_ns);
  found.list.resize(std::min<std::size_t>(found.list.size(), most));
  return found;
}

} // namespace godwit::mapobjects_store
