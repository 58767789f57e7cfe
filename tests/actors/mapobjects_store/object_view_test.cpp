#include "actors/mapobjects_store/object_view.hpp"

#include "actors/mapobjects_store/mission_scope.hpp"
#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace object_view_test {

using namespace godwit::tests;

class object_view : public tests::map_test {
protected:
  objects_found look(const get_objects& asked = {}) {
    auto found = store->transact([&](map_tables& t) { return look_at_objects(t, asked); });
    EXPECT_TRUE(found.has_value());
    return found.value_or(objects_found{});
  }
  static map_part around(const geo_position& at, double degrees) {
    return {at.longitude_deg - degrees, at.latitude_deg - degrees, at.longitude_deg + degrees,
            at.latitude_deg + degrees};
  }
  static map_object seen_last_at(std::uint64_t id, const geo_position& at, std::int64_t last_seen_ns) {
    auto result = object(id, at);
    result.last_seen_ns = last_seen_ns;
    return result;
  }
  static std::vector<std::int64_t> times_of(const objects_found& found) {
    std::vector<std::int64_t> result;
    for (const auto& each : found.list)
      result.push_back(each.last_seen_ns);
    return result;
  }
};

TEST_F(object_view, what_was_pulled_and_what_was_seen_here_are_shown_the_newest_first) {
  load({seen_last_at(1, place(0), 30), seen_last_at(2, place(1000), 10)});
  record(seen(10, place(2000), 20));
  const auto found = look();
  EXPECT_EQ(times_of(found), (std::vector<std::int64_t>{30, 20, 10}));
  EXPECT_EQ(found.counted, 3U);
  EXPECT_TRUE(found.is_all);
  EXPECT_FALSE(found.list[0].is_seen_here);
  EXPECT_TRUE(found.list[1].is_seen_here);
  EXPECT_EQ(found.list[1].class_group, "vehicle");
  EXPECT_NEAR(found.list[1].position.latitude_deg, place(2000).latitude_deg, 1e-9);
}

TEST_F(object_view, only_what_lies_in_the_part_that_is_looked_at_counts) {
  load({seen_last_at(1, place(0), 1), seen_last_at(2, place(50'000), 2)});
  record(seen(10, place(51'000), 3));
  EXPECT_EQ(times_of(look({.within = around(place(0), 0.01)})), std::vector<std::int64_t>{1});
  EXPECT_EQ(look({.within = around(place(50'500), 0.02)}).counted, 2U);
  EXPECT_EQ(look({.within = around(place(0, 100'000), 0.01)}).counted, 0U);
}

TEST_F(object_view, a_part_may_lie_across_the_antimeridian) {
  load({seen_last_at(1, {10, 179.9, {}}, 1), seen_last_at(2, {10, -179.9, {}}, 2), seen_last_at(3, {10, 0, {}}, 3)});
  EXPECT_EQ(times_of(look({.within = {179, 9, -179, 11}})), (std::vector<std::int64_t>{2, 1}));
}

TEST_F(object_view, an_object_that_was_moved_here_is_shown_once_where_it_is_now) {
  load({seen_last_at(1, place(0), 1)});
  record(seen(10, place(20), 5));
  const auto found = look();
  ASSERT_EQ(found.list.size(), 1U);
  EXPECT_EQ(found.counted, 1U);
  EXPECT_TRUE(found.list[0].is_seen_here);
}

TEST_F(object_view, more_than_the_limit_are_counted_and_the_oldest_are_not_listed) {
  std::vector<map_object> many;
  for (std::uint64_t n = 1; n <= max_shown_objects + 20; ++n)
    many.push_back(seen_last_at(n, place(static_cast<double>(100 * n)), static_cast<std::int64_t>(n)));
  load(many);
  const auto all = look({.within = {}, .limit = 1'000'000});
  EXPECT_EQ(all.list.size(), max_shown_objects);
  EXPECT_EQ(all.list.front().last_seen_ns, static_cast<std::int64_t>(many.size()));
  EXPECT_EQ(all.list.back().last_seen_ns, 21);
  EXPECT_EQ(all.counted, many.size());
  EXPECT_TRUE(all.is_all);
  EXPECT_EQ(look({.within = {}, .limit = 3}).list.size(), 3U);
  EXPECT_EQ(look({.within = {}, .limit = 3}).counted, many.size());
}

TEST_F(object_view, of_a_large_map_no_more_than_the_bound_is_looked_at_and_that_is_said) {
  const auto load_number = begin_load();
  std::uint64_t id = 0;
  for (std::int64_t page = 0; page < 3; ++page) {
    load_page next{load_number, page, {}, {}};
    for (int i = 0; i < 4'000; ++i) {
      ++id;
      next.objects.push_back(object(id, place(static_cast<double>(id % 100), static_cast<double>(id / 100))));
    }
    ASSERT_TRUE(add_page(std::move(next)));
  }
  ASSERT_TRUE(finish(load_number, 12'000));
  const auto found = look();
  EXPECT_EQ(found.list.size(), max_shown_objects);
  EXPECT_EQ(found.counted, max_counted_objects);
  EXPECT_FALSE(found.is_all);
}

TEST_F(object_view, a_map_that_was_pulled_for_another_mission_is_not_shown) {
  load({seen_last_at(1, place(0), 1)}, {}, mission_a);
  ASSERT_TRUE(store->transact([](map_tables& t) { return choose(t, {mission_b}); }));
  EXPECT_EQ(look().counted, 0U);
}

} // namespace object_view_test
} // namespace godwit::mapobjects_store
