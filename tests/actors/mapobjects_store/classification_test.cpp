#include "actors/mapobjects_store/classification.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "tests/actors/domain/geo/places.hpp"

namespace godwit::mapobjects_store {
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
