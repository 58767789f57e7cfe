#include "actors/mapobjects_store/geo_point.hpp"
#include "actors/mapobjects_store/object_table.hpp"

#include <algorithm>

#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace object_table_test {

using namespace godwit::tests;

class object_table : public tests::map_test {
protected:
  std::vector<std::string> near(const geo_position& at, double radius_m, const std::string& group = "vehicle") {
    const auto found = store->transact(
        [&](map_tables& t) { return objects_in(t.q, t.map, geo::boxes_around(point_of(at), radius_m), group); });
    EXPECT_TRUE(found.has_value());
    std::vector<std::string> ids;
    for (const auto& each : *found)
      ids.push_back(each.what.id);
    std::sort(ids.begin(), ids.end());
    return ids;
  }
  std::optional<stored_object> with(std::uint64_t id, std::int64_t loaded_number) {
    return store->transact([&](map_tables& t) { return object_with(t.q, t.map, uuid(id), loaded_number); }).value();
  }
};

TEST_F(object_table, what_is_near_is_found_among_loaded_and_seen_ones) {
  load({object(1, place(0)), object(2, place(5000))});
  record(seen(10, place(50)));
  EXPECT_EQ(near(place(0), 100), (std::vector{uuid(1), uuid(10)}));
  EXPECT_TRUE(near(place(0), 100, "person").empty());
}

TEST_F(object_table, a_loaded_object_comes_with_all_that_the_service_said_of_it) {
  auto given = object(1, {47.5, 8.25, 430.5});
  given.first_seen_ns = 5;
  given.last_seen_ns = 7;
  given.confidence = 0.75;
  load({given});
  const auto found = with(1, store->map().first_object);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_loaded);
  EXPECT_TRUE(io::equal(found->what, given));
}

TEST_F(object_table, what_was_seen_of_it_comes_first) {
  load({object(1, place(0))});
  record(seen(10, place(20)));
  EXPECT_FALSE(with(1, store->map().first_object)->is_loaded);
}

TEST_F(object_table, a_row_of_an_earlier_load_does_not_count) {
  load({object(1, place(0))});
  const auto number = store->map().first_object;
  load({object(1, place(0))});
  EXPECT_FALSE(with(1, number));
}

TEST_F(object_table, seen_again_at_its_place_it_keeps_the_place_and_gets_the_time) {
  load({object(1, place(0))});
  record(seen(10, place(3), 99));
  const auto found = with(1, store->map().first_object);
  EXPECT_EQ(found->what.last_seen_ns, 99);
  EXPECT_EQ(found->what.position.longitude_deg, place(0).longitude_deg);
  record(seen(11, place(3), 50)); // an older one, late
  EXPECT_EQ(with(1, store->map().first_object)->what.last_seen_ns, 99);
}

} // namespace object_table_test
} // namespace godwit::mapobjects_store
