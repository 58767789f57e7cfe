#include "actors/mapobjects_store/garbage.hpp"

#include "actors/mapobjects_store/mission_scope.hpp"
#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace garbage_test {

using namespace godwit::tests;

using garbage = tests::map_test;

TEST_F(garbage, rows_of_replaced_and_abandoned_loads_go_and_the_shown_map_stays) {
  load({object(1, place(0)), object(2, place(100))}, {{uuid(70), mission_a, "33UXP04", "vehicle", 1}});
  load({object(1, place(0))});
  ASSERT_TRUE(add_page({.load = begin_load(), .objects = {object(5, place(0))}, .ignored = {}}));
  begin_load();
  collect_garbage();
  EXPECT_EQ(count("loaded_object"), 1);
  EXPECT_EQ(count("loaded_place_0") + count("loaded_place_1"), 1);
  EXPECT_EQ(count("ignored_item"), 0);
  EXPECT_EQ(shown(), std::vector{uuid(1)});
}

TEST_F(garbage, a_load_under_way_is_none) {
  const auto number = begin_load();
  ASSERT_TRUE(add_page({.load = number, .objects = {object(1, place(0))}, .ignored = {}}));
  collect_garbage();
  EXPECT_EQ(count("loaded_object"), 1);
  ASSERT_TRUE(finish(number, 1));
  EXPECT_EQ(shown(), std::vector{uuid(1)});
}

TEST_F(garbage, between_two_loads_their_rows_stay_apart) {
  load({object(1, place(0))});
  ASSERT_TRUE(add_page({.load = begin_load(), .objects = {object(5, place(0))}, .ignored = {}})); // given up
  const auto number = begin_load();
  ASSERT_TRUE(add_page({.load = number, .objects = {object(2, place(0))}, .ignored = {}}));
  collect_garbage();
  EXPECT_EQ(shown(), std::vector{uuid(1)});
  EXPECT_EQ(count("loaded_object"), 2);
  ASSERT_TRUE(finish(number, 1));
  EXPECT_EQ(shown(), std::vector{uuid(2)});
}

TEST_F(garbage, the_map_of_a_deleted_mission_goes_whole) {
  load({object(1, place(0))});
  ASSERT_TRUE(store->transact([](map_tables& t) { return forget(t, {mission_a, 9, "deleted"}); }));
  collect_garbage();
  EXPECT_EQ(count("loaded_object") + count("loaded_place_0") + count("loaded_place_1"), 0);
}

TEST_F(garbage, what_was_seen_here_goes_when_a_load_contains_it) {
  record(seen(10, place(0)));
  record(seen(11, place(100)));
  take(900, 1);
  delivered(900);
  load({object(10, place(0))});
  collect_garbage();
  EXPECT_EQ(count("seen_object"), 1);
  EXPECT_EQ(shown(), (std::vector{uuid(10), uuid(11)}));
}

TEST_F(garbage, of_delivered_observations_the_newest_are_kept_and_nothing_that_is_owed_goes) {
  for (std::uint64_t i = 1; i <= 6; ++i)
    record(seen(i, place(100.0 * static_cast<double>(i))));
  for (std::uint64_t i = 1; i <= 6; ++i)
    take(900 + i, 1);
  for (const std::uint64_t i : {1, 2, 4, 5, 6})
    delivered(900 + i);
  collect_garbage(2);
  EXPECT_EQ(count("observation WHERE delivery = 'delivered'"), 2);
  EXPECT_EQ(ids_of(take(903)), std::vector{uuid(3)});
}

TEST_F(garbage, more_than_fits_a_turn_goes_in_several) {
  std::vector<map_object> many;
  for (std::uint64_t i = 0; i < 2 * max_chunk_rows; ++i)
    many.push_back(object(i, place(static_cast<double>(i))));
  load(many);
  for (std::uint64_t i = 0; i < max_chunk_rows + 10; ++i)
    record(seen(100'000 + i, place(static_cast<double>(i), 5000 + 100 * static_cast<double>(i % 7))));
  deliver_all();
  load({});
  collect_garbage();
  EXPECT_EQ(count("loaded_object"), 0);
  EXPECT_EQ(count("seen_object") + count("seen_place"), 0);
}

} // namespace garbage_test
} // namespace godwit::mapobjects_store
