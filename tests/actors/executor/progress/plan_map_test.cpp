// The map of the header's picture, on a vehicle that counts from 0, and what a sound one is.
#include <gtest/gtest.h>

#include "actors/executor/progress/plan_map.hpp"

namespace godwit::executor::progress {
namespace plan_map_test {

// 0 take-off | 1 speed, 2 waypoint | 3, 4 survey | 5 return; "nothing" has no vehicle items, "light" only a DO command.
plan_map picture() {
  return {.total = 7,
          .ends_mission = true,
          .items = {{"t", 0, 0, 1, 0, 0},
                    {"w1", 1, 1, 2, 2, 2},
                    {"nothing", 2, 3, 0, {}, {}},
                    {"survey", 3, 3, 2, 3, 4},
                    {"home", 4, 5, 1, 5, 5},
                    {"light", 5, 6, 1, {}, {}}}};
}

plan_map with(void (*change)(plan_map&)) {
  auto map = picture();
  change(map);
  return map;
}

TEST(plan_map, a_sequence_belongs_to_the_item_that_became_it) {
  const auto map = picture();
  ASSERT_TRUE(is_sound(map));
  EXPECT_EQ(position_at(map, 0), 0U);
  EXPECT_EQ(position_at(map, 1), 1U);
  EXPECT_EQ(position_at(map, 2), 1U);
  EXPECT_EQ(position_at(map, 3), 3U);
  EXPECT_EQ(position_at(map, 4), 3U);
  EXPECT_EQ(position_at(map, 6), 5U);
  EXPECT_EQ(position_at(map, 7), std::nullopt);
  EXPECT_EQ(position_at(map, no_sequence), std::nullopt);
}

TEST(plan_map, a_sequence_between_items_belongs_to_none) {
  const plan_map map{.total = 4, .items = {{"a", 0, 0, 1, 0, 0}, {"b", 1, 2, 1, 2, 2}}};
  ASSERT_TRUE(is_sound(map));
  EXPECT_EQ(position_at(map, 1), std::nullopt);
  EXPECT_EQ(position_at(map, 3), std::nullopt);
  EXPECT_TRUE(has_sequence(map, 3));
}

TEST(plan_map, where_item_0_is_home_the_plan_begins_at_1) {
  const plan_map map{.first_sequence = 1, .total = 2, .start_sequence = 1, .items = {{"a", 4, 1, 2, 1, 2}}};
  ASSERT_TRUE(is_sound(map));
  EXPECT_FALSE(has_sequence(map, 0));
  EXPECT_TRUE(has_sequence(map, 2));
  EXPECT_EQ(end_sequence(map), 3U);
}

TEST(plan_map, an_item_is_done_with_its_last_movement_and_else_with_its_last_command) {
  const auto map = picture();
  EXPECT_EQ(done_sequence(map.items[1]), 2U);
  EXPECT_EQ(done_sequence(map.items[3]), 4U);
  EXPECT_EQ(done_sequence(map.items[5]), 6U);
  EXPECT_EQ(done_sequence({"w", 0, 5, 3, 5, 6}), 6U); // what stands after the movement takes no time
}

TEST(plan_map, an_item_is_passed_when_the_vehicle_is_past_it) {
  const auto map = picture();
  EXPECT_FALSE(is_passed(map.items[3], 4));
  EXPECT_TRUE(is_passed(map.items[3], 5));
  EXPECT_FALSE(is_passed(map.items[2], 2));
  EXPECT_TRUE(is_passed(map.items[2], 3));
}

TEST(plan_map, commands_in_front_of_the_first_movement_belong_to_the_start) {
  const auto map = picture();
  EXPECT_TRUE(is_start(map, 1, 1));
  EXPECT_TRUE(is_start(map, 1, 2));
  EXPECT_FALSE(is_start(map, 1, 3));
  EXPECT_FALSE(is_start(map, 1, 0));
}

TEST(plan_map, within_a_survey_only_the_start_itself_is_the_start) {
  const auto map = picture();
  EXPECT_TRUE(is_start(map, 4, 4));
  EXPECT_FALSE(is_start(map, 4, 5));
  EXPECT_TRUE(is_start(map, 6, 6));
}

TEST(plan_map, the_plan_is_done_with_the_last_item_that_moves_the_vehicle) {
  EXPECT_EQ(items_to_finish(picture()), 5U);
  EXPECT_EQ(items_to_finish({.total = 2, .items = {{"a", 0, 0, 1, {}, {}}, {"b", 1, 1, 1, {}, {}}}}), 2U);
}

TEST(plan_map, an_unsound_map_is_recognised) {
  EXPECT_FALSE(is_sound({}));
  EXPECT_FALSE(is_sound(with([](plan_map& m) { m.total = 6; })));
  EXPECT_FALSE(is_sound(with([](plan_map& m) { m.start_sequence = 7; })));
  EXPECT_FALSE(is_sound(with([](plan_map& m) { m.first_sequence = 1; })));
  EXPECT_FALSE(is_sound(with([](plan_map& m) { m.items[1].item_index = 0; })));
  EXPECT_FALSE(is_sound(with([](plan_map& m) { m.items[1].first_sequence = 0; })));
  EXPECT_FALSE(is_sound(with([](plan_map& m) { m.items[1].last_nav_sequence = 3; })));
  EXPECT_FALSE(is_sound(with([](plan_map& m) { m.items[1].first_nav_sequence.reset(); })));
  EXPECT_FALSE(is_sound(with([](plan_map& m) {
    m.total = 65535;
    m.first_sequence = 1;
  })));
  EXPECT_FALSE(is_sound(with([](plan_map& m) { m.items.resize(max_mapped_items + 1); })));
}

} // namespace plan_map_test
} // namespace godwit::executor::progress
