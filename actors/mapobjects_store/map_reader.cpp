#include "actors/mapobjects_store/map_reader.hpp"

#include <algorithm>

#include "actors/mapobjects_store/deliveries.hpp"
#include "actors/mapobjects_store/map_file.hpp"
#include "actors/mapobjects_store/object_table.hpp"

namespace godwit::mapobjects_store {

namespace {

// Several statements that see the same state.
class one_state {
public:
  explicit one_state(io::sqlite::database& db) : db_(db), begun_(db.exec("BEGIN")) {}
  ~one_state() { static_cast<void>(db_.exec("END")); }
  one_state(const one_state&) = delete;
  one_state& operator=(const one_state&) = delete;

  [[nodiscard]] map_result<void> begun() const {
    if (!begun_)
      return tl::unexpected(from_sqlite(begun_.error(), "reading the map"));
    return {};
  }

private:
  io::sqlite::database& db_;
  io::sqlite::result<void> begun_;
};

} // namespace

map_reader::map_reader(io::sqlite::database db)
    : db_(std::make_unique<io::sqlite::database>(std::move(db))), q_(std::make_unique<sql>(*db_)) {}

map_result<map_reader> map_reader::open(const std::string& path) {
  auto db = open_map_for_reading(path);
  if (!db)
    return tl::unexpected(std::move(db.error()));
  return map_reader(std::move(*db));
}

map_result<map_row> map_reader::map() { return load_map_row(*q_); }

namespace {

constexpr const char* seen_objects =
    "SELECT number, id, class_group, latitude_deg, longitude_deg, altitude_m, first_seen_ns, last_seen_ns, confidence, "
    "mission_id FROM seen_object WHERE number > max(?1, ?2) ORDER BY number LIMIT ?3";
constexpr const char* loaded_objects =
    "SELECT o.number, o.id, o.class_group, o.latitude_deg, o.longitude_deg, o.altitude_m, o.first_seen_ns, "
    "o.last_seen_ns, o.confidence, ?5 FROM loaded_object o WHERE o.number > ?1 AND o.number <= ?4 "
    "AND NOT EXISTS (SELECT 1 FROM seen_object h WHERE h.id = o.id AND h.number > ?2) ORDER BY o.number LIMIT ?3";

} // namespace

map_result<object_page> map_reader::objects(const object_place& after) {
  const one_state state(*db_);
  const auto map = state.begun().and_then([&] { return load_map_row(*q_); });
  if (!map)
    return tl::unexpected(map.error());
  object_page page{.generation = map->shown_generation(), .objects = {}, .next = std::nullopt};
  object_place last = after;
  const auto take = [&](sql::row& row) {
    auto stored = object_of(row, after.among_loaded);
    last.number = stored.number;
    page.objects.push_back(std::move(stored.what));
  };
  const auto done = after.among_loaded
                        ? q_->each(loaded_objects, take, std::max(after.number, map->first_object - 1),
                                   map->pulled_observation, max_objects, map->last_object, map->pulled_mission_id)
                        : q_->each(seen_objects, take, after.number, map->pulled_observation, max_objects);
  if (!done)
    return tl::unexpected(done.error());
  if (page.objects.size() == max_objects)
    page.next = last;
  else if (!after.among_loaded && map->has_copy())
    page.next = object_place{.among_loaded = true};
  return page;
}

} // namespace godwit::mapobjects_store
