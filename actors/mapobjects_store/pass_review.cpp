#include "actors/mapobjects_store/pass_review.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include "actors/domain/geo/bounding_box.hpp"
#include "actors/domain/uuid/uuid.hpp"
#include "actors/mapobjects_store/deliveries.hpp"
#include "actors/mapobjects_store/map_row.hpp"
#include "actors/mapobjects_store/object_table.hpp"
#include "actors/mapobjects_store/sightings.hpp"

namespace godwit::mapobjects_store {

pass_review::pass_review(pass_end pass, view_cursor in_view, callback done)
    : pass_(std::move(pass)), in_view_(std::move(in_view)), done_(std::move(done)) {
  counts_.id = pass_.id;
}

map_result<bool> pass_review::stage(map_tables& t, decision_context& now) {
  staged_ = counts_;
  for (const auto& each : uncommitted_)
    if (auto done = look_at(t, each); !done)
      return tl::unexpected(std::move(done.error()));
  for (;;) {
    auto row = in_view_.next();
    if (!row)
      return tl::unexpected(std::move(row.error()));
    if (!*row)
      return true;
    if ((*row)->in_view) {
      uncommitted_.push_back(std::move(**row));
      if (auto done = look_at(t, uncommitted_.back()); !done)
        return tl::unexpected(std::move(done.error()));
    }
    if (now.over_after_row())
      return false;
  }
}

// The object may have been seen, moved or dropped since the cursor was opened.
map_result<void> pass_review::look_at(map_tables& t, const view_cursor::row& seen_then) {
  ++staged_.in_view;
  const auto object = object_with(t.q, t.map, seen_then.object_id, seen_then.loaded_number);
  if (!object)
    return tl::unexpected(object.error());
  if (!*object)
    return {};
  const auto seen = was_seen(t.q, seen_then.object_id, pass_.started_ns);
  if (!seen)
    return tl::unexpected(seen.error());
  if (*seen)
    return {};
  const auto& what = (*object)->what;
  const auto ignored = is_ignored(t, what.position, what.class_group);
  if (!ignored)
    return tl::unexpected(ignored.error());
  return *ignored ? map_result<void>{} : miss(t, what);
}

map_result<void> pass_review::miss(map_tables& t, const map_object& object) {
  ++staged_.removed_candidates;
  const auto id = ids::derived_uuid(pass_.id, object.id);
  const auto known = observation_with(t.q, id);
  if (!known)
    return tl::unexpected(known.error());
  if (*known)
    return {};
  const observation what{.id = id,
                         .mission_id = pass_.mission_id,
                         .object_id = object.id,
                         .kind = observation_kind::removed_candidate,
                         .class_group = object.class_group,
                         .position = object.position,
                         .at_ns = pass_.ended_ns,
                         .confidence = pass_.confidence};
  return add_observation(t.q, what).map([](std::int64_t) {});
}

void pass_review::committed() {
  counts_ = staged_;
  uncommitted_.clear();
}

void pass_review::finish(const map_result<void>& result) {
  done_(result.map([&] { return counts_; }));
}

namespace {

constexpr const char* seen_in_view = "SELECT o.number, o.id, o.class_group, o.latitude_deg, o.longitude_deg "
                                     "FROM seen_place b CROSS JOIN seen_object o ON o.number = b.number "
                                     "WHERE b.max_latitude_deg >= ?1 AND b.min_latitude_deg <= ?2 "
                                     "AND b.max_longitude_deg >= ?3 AND b.min_longitude_deg <= ?4 AND o.number > ?5";

constexpr by_tree loaded_in_view = {"SELECT o.number, o.id, o.class_group, o.latitude_deg, o.longitude_deg "
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
  if (auto prepared = made.prepare(seen_in_view, false); !prepared)
    return tl::unexpected(std::move(prepared.error()));
  if (map->has_copy())
    if (auto prepared = made.prepare(of_tree(loaded_in_view, map->tree), true); !prepared)
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

std::vector<view_area> areas_of(const pass_end& pass) {
  std::vector<view_area> areas;
  for (const auto& each : pass.circles)
    areas.emplace_back(circle_area{point_of(each.centre), each.radius_m});
  for (const auto& each : pass.polygons) {
    std::vector<geo::point> vertices;
    for (const auto& vertex : each.vertices)
      vertices.push_back(point_of(vertex));
    areas.emplace_back(geo::polygon(vertices));
  }
  return areas;
}

bool contains(const view_area& area, const geo::point& at) {
  if (const auto* circle = std::get_if<circle_area>(&area))
    return geo::distance_m(circle->centre, at) <= circle->radius_m;
  return std::get<geo::polygon>(area).contains(at);
}

std::vector<geo::bounding_box> boxes_of(const view_area& area) {
  if (const auto* circle = std::get_if<circle_area>(&area))
    return geo::boxes_around(circle->centre, circle->radius_m);
  const auto& polygon = std::get<geo::polygon>(area);
  return geo::boxes_around(polygon.centre(), polygon.radius_m());
}

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
