#include "actors/mapobjects_store/view_cursor.hpp"

#include "actors/mapobjects_store/place_tree.hpp"

namespace godwit::mapobjects_store {

namespace {

constexpr const char* seen_in_box = "SELECT o.number, o.id, o.class_group, o.latitude_deg, o.longitude_deg "
                                    "FROM seen_place b CROSS JOIN seen_object o ON o.number = b.number "
                                    "WHERE b.max_latitude_deg >= ?1 AND b.min_latitude_deg <= ?2 "
                                    "AND b.max_longitude_deg >= ?3 AND b.min_longitude_deg <= ?4 AND o.number > ?5";

constexpr by_tree loaded_in_box = {"SELECT o.number, o.id, o.class_group, o.latitude_deg, o.longitude_deg "
                                   "FROM loaded_place_0 b CROSS JOIN loaded_object o ON o.number = b.number "
                                   "WHERE b.max_latitude_deg >= ?1 AND b.min_latitude_deg <= ?2 "
                                   "AND b.max_longitude_deg >= ?3 AND b.min_longitude_deg <= ?4 "
                                   "AND NOT EXISTS (SELECT 1 FROM seen_object h WHERE h.id = o.id AND h.number > ?5)",
                                   "SELECT o.number, o.id, o.class_group, o.latitude_deg, o.longitude_deg "
                                   "FROM loaded_place_1 b CROSS JOIN loaded_object o ON o.number = b.number "
                                   "WHERE b.max_latitude_deg >= ?1 AND b.min_latitude_deg <= ?2 "
                                   "AND b.max_longitude_deg >= ?3 AND b.min_longitude_deg <= ?4 "
                                   "AND NOT EXISTS (SELECT 1 FROM seen_object h WHERE h.id = o.id AND h.number > ?5)"};

constexpr const char* doing = "reading what is in view";

} // namespace

view_cursor::view_cursor(io::sqlite::database reader, const pass_end& pass)
    : reader_(std::make_unique<io::sqlite::database>(std::move(reader))), areas_(areas_of(pass)),
      groups_(pass.class_groups.begin(), pass.class_groups.end()) {}

map_result<view_cursor> view_cursor::open(io::sqlite::database reader, const pass_end& pass) {
  view_cursor made(std::move(reader), pass);
  if (auto begun = made.reader_->exec("BEGIN"); !begun)
    return tl::unexpected(from_sqlite(begun.error(), doing));
  sql q(*made.reader_);
  auto map = load_map_row(q); // the first reading: from now on the file stands still for this connection
  if (!map)
    return tl::unexpected(std::move(map.error()));
  made.pulled_observation_ = map->pulled_observation;
  if (auto prepared = made.prepare(seen_in_box, false); !prepared)
    return tl::unexpected(std::move(prepared.error()));
  if (map->has_copy())
    if (auto prepared = made.prepare(of_tree(loaded_in_box, map->tree), true); !prepared)
      return tl::unexpected(std::move(prepared.error()));
  return made;
}

map_result<void> view_cursor::prepare(const char* text, bool is_loaded) {
  auto query = reader_->prepare(text);
  if (!query)
    return tl::unexpected(from_sqlite(query.error(), doing));
  queries_.push_back({std::move(*query), is_loaded});
  for (std::size_t i = 0; i < areas_.size(); ++i)
    for (const auto& box : boxes_of(areas_[i]))
      questions_.push_back({queries_.size() - 1, i, box});
  return {};
}

view_cursor::row view_cursor::judge() {
  const auto& asked = questions_[question_];
  const auto& [query, is_loaded] = queries_[asked.query];
  const geo::point at{query.real(3), query.real(4)};
  const auto number = query.integer(0);
  const bool in_view = groups_.contains(query.text(2)) && contains(areas_[asked.area], at) &&
                       known_numbers_.insert(is_loaded ? number : -number).second;
  return {.object_id = query.text(1), .loaded_number = is_loaded ? number : 0, .in_view = in_view};
}

map_result<std::optional<view_cursor::row>> view_cursor::next() {
  while (question_ < questions_.size()) {
    const auto& box = questions_[question_].box;
    auto& query = queries_[questions_[question_].query].prepared;
    if (!asked_) {
      query.with(box.south_deg, box.north_deg, box.west_deg, box.east_deg, pulled_observation_);
      asked_ = true;
    }
    const auto there = query.step();
    if (!there)
      return tl::unexpected(from_sqlite(there.error(), doing));
    if (*there)
      return std::optional(judge());
    query.reset();
    asked_ = false;
    ++question_;
  }
  return std::optional<row>();
}

} // namespace godwit::mapobjects_store
