#include <algorithm>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/mapobjects_store/map_row.hpp"
#include "actors/mapobjects_store/object_table.hpp"
#include "tests/actors/domain/geo/places.hpp"
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

namespace place_tree_test {

using namespace godwit::tests;

class place_tree : public tests::map_test {
protected:
  void fill(std::int64_t tree, std::int64_t places) {
    const auto done = store->transact([&](map_tables& t) -> map_result<void> {
      for (std::int64_t i = 1; i <= places; ++i)
        if (auto added = add_place(t.q, tree, {{}, i, 0.001 * static_cast<double>(i), 16, 0}); !added)
          return added;
      return {};
    });
    ASSERT_TRUE(done.has_value());
  }
  void clear(std::int64_t tree) {
    ASSERT_TRUE(store->transact([&](map_tables& t) { return clear_tree(t.q, tree); }));
  }
};

TEST_F(place_tree, one_is_cleared_and_the_other_one_stays) {
  fill(0, 200);
  fill(1, 100);
  clear(0);
  EXPECT_EQ(count("loaded_place_0"), 0);
  EXPECT_EQ(count("loaded_place_1"), 100);
}

TEST_F(place_tree, a_cleared_one_can_be_filled_again_also_when_it_was_empty) {
  clear(1);
  fill(1, 5);
  clear(1);
  fill(1, 7);
  EXPECT_EQ(count("loaded_place_1"), 7);
}

TEST_F(place_tree, what_was_cleared_in_a_transaction_that_is_rolled_back_is_there_again) {
  fill(0, 50);
  ASSERT_TRUE(store->begin());
  ASSERT_TRUE(store->apply([](map_tables& t) { return clear_tree(t.q, 0); }));
  store->roll_back();
  EXPECT_EQ(count("loaded_place_0"), 50);
  fill(1, 1);
}

} // namespace place_tree_test

namespace classification_test {

candidate at_distance(const geo::point& from, std::string id, double metres, double bearing_deg = 90) {
  return {std::move(id), geo::destination(from, bearing_deg, metres)};
}

observation_kind kind_at(double metres, const settings& rules = {}) {
  const geo::point here{48, 16};
  const std::vector known{at_distance(here, "a", metres)};
  return kind_of(nearest_match(here, known, rules), false, rules);
}

TEST(classification, up_to_8_m_it_is_existing_up_to_30_m_moved_and_beyond_new) {
  EXPECT_EQ(kind_at(0), observation_kind::existing);
  EXPECT_EQ(kind_at(7.999), observation_kind::existing);
  EXPECT_EQ(kind_at(8.001), observation_kind::moved);
  EXPECT_EQ(kind_at(29.999), observation_kind::moved);
  EXPECT_EQ(kind_at(30.001), observation_kind::found);
}

TEST(classification, both_distances_are_settings) {
  const settings wide{.match_within_m = 100, .moved_above_m = 50};
  EXPECT_EQ(kind_at(49, wide), observation_kind::existing);
  EXPECT_EQ(kind_at(99, wide), observation_kind::moved);
  EXPECT_EQ(kind_at(101, wide), observation_kind::found);
}

TEST(classification, the_nearest_one_is_meant) {
  const geo::point here{48, 16};
  const std::vector known{at_distance(here, "a", 12), at_distance(here, "b", 5), at_distance(here, "c", 20)};
  EXPECT_EQ(nearest_match(here, known, {})->index, 1U);
}

TEST(classification, of_equally_near_ones_the_smallest_id_is_meant) {
  const geo::point here{0, 16}; // on the equator a way to the north is as long as the same way to the south
  const std::vector known{candidate{"b", {0.0001, 16}}, candidate{"a", {-0.0001, 16}}};
  const std::vector reversed{known[1], known[0]};
  EXPECT_EQ(known[nearest_match(here, known, {})->index].id, "a");
  EXPECT_EQ(reversed[nearest_match(here, reversed, {})->index].id, "a");
}

TEST(classification, what_is_ignored_is_neither_new_nor_moved) {
  EXPECT_EQ(kind_of(std::nullopt, true, {}), observation_kind::ignored);
  EXPECT_EQ(kind_of(match{0, 20}, true, {}), observation_kind::ignored);
}

TEST(classification, only_what_changes_the_map_is_a_finding) {
  EXPECT_TRUE(is_finding(observation_kind::found));
  EXPECT_TRUE(is_finding(observation_kind::moved));
  EXPECT_TRUE(is_finding(observation_kind::removed_candidate));
  EXPECT_FALSE(is_finding(observation_kind::existing));
  EXPECT_FALSE(is_finding(observation_kind::ignored));
}

RC_GTEST_PROP(classification_property, the_order_of_the_candidates_does_not_matter, ()) {
  const auto here = *tests::anywhere();
  std::vector<candidate> known;
  const auto several = *rc::gen::inRange(0, 12);
  for (int i = 0; i < several; ++i) {
    // Few different places, so that many are equally near.
    const auto metres = *rc::gen::element(0.0, 5.0, 12.0, 29.0, 31.0);
    const auto bearing_deg = *rc::gen::element(0.0, 90.0, 270.0);
    known.push_back(at_distance(here, std::string(1, static_cast<char>('a' + i)), metres, bearing_deg));
  }
  auto shuffled = known;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937_64(*rc::gen::arbitrary<std::uint64_t>()));
  const auto one = nearest_match(here, known, {});
  const auto other = nearest_match(here, shuffled, {});
  RC_ASSERT(one.has_value() == other.has_value());
  if (one) {
    RC_ASSERT(known[one->index].id == shuffled[other->index].id);
    RC_ASSERT(one->distance_m == other->distance_m);
  }
}

} // namespace classification_test

} // namespace godwit::mapobjects_store
