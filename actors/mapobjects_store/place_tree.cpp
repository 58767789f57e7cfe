#include "actors/mapobjects_store/place_tree.hpp"

namespace godwit::mapobjects_store {

namespace {

constexpr by_tree any_place = {"SELECT number FROM loaded_place_0 LIMIT 1",
                               "SELECT number FROM loaded_place_1 LIMIT 1"};
constexpr by_tree drop = {"DROP TABLE loaded_place_0", "DROP TABLE loaded_place_1"};
constexpr by_tree create = {"CREATE VIRTUAL TABLE loaded_place_0 USING rtree(number, min_latitude_deg, "
                            "max_latitude_deg, min_longitude_deg, max_longitude_deg)",
                            "CREATE VIRTUAL TABLE loaded_place_1 USING rtree(number, min_latitude_deg, "
                            "max_latitude_deg, min_longitude_deg, max_longitude_deg)"};
constexpr by_tree insert = {"INSERT INTO loaded_place_0 VALUES (?1, ?2, ?2, ?3, ?3)",
                            "INSERT INTO loaded_place_1 VALUES (?1, ?2, ?2, ?3, ?3)"};

} // namespace

map_result<void> clear_tree(sql& q, std::int64_t tree) {
  const auto any = q.first(of_tree(any_place, tree), [](sql::row& row) { return row.integer(0); });
  if (!any)
    return tl::unexpected(any.error());
  if (!*any)
    return {};
  return q.run(of_tree(drop, tree)).and_then([&] { return q.run(of_tree(create, tree)); });
}

map_result<void> add_place(sql& q, std::int64_t tree, const loaded_place& place) {
  return q.run(of_tree(insert, tree), place.number, place.latitude_deg, place.longitude_deg);
}

} // namespace godwit::mapobjects_store
