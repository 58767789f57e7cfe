#include "programs/godwit-sim/missions/change.hpp"

#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/missions/missions_fixture.hpp"

namespace godwit::sim::missions {
namespace change_test {

std::string ids_of(const mission::document& of) {
  std::string all;
  for (const auto& each : of.items)
    all += mission::id_of(each) + " ";
  return all;
}

TEST(missions_change, new_items_stand_behind_theirs_and_the_rest_stays_or_goes) {
  const auto old = small_mission();
  EXPECT_EQ(ids_of(*changed_mission(old, "w1", {waypoint("n")}, behind::keep, "/x")), "up w1 n w2 home ");
  EXPECT_EQ(ids_of(*changed_mission(old, "w1", {waypoint("n")}, behind::replace, "/x")), "up w1 n ");
  EXPECT_EQ(ids_of(*changed_mission(old, {}, {waypoint("n")}, behind::keep, "/x")), "n up w1 w2 home ");
  EXPECT_EQ(ids_of(*changed_mission(old, {}, {waypoint("n")}, behind::replace, "/x")), "n ");
  EXPECT_EQ(ids_of(*changed_mission(old, "home", {waypoint("n")}, behind::replace, "/x")), "up w1 w2 home n ");
}

TEST(missions_change, an_item_that_is_missing_is_named) {
  const auto changed = changed_mission(small_mission(), "w9", {waypoint("n")}, behind::keep, "/x");
  ASSERT_FALSE(changed);
  EXPECT_EQ(std::get<missing_item>(changed.error()).id, "w9");
}

TEST(missions_change, an_id_that_stays_is_not_taken_twice_and_one_that_goes_may_come_back) {
  const auto taken = changed_mission(small_mission(), "w1", {waypoint("n"), waypoint("up")}, behind::replace, "/items");
  ASSERT_FALSE(taken);
  EXPECT_EQ(std::get<1>(taken.error()).at(0).pointer, "/items/1/id");
  EXPECT_EQ(ids_of(*changed_mission(small_mission(), "w1", {waypoint("w2")}, behind::replace, "/items")), "up w1 w2 ");
}

TEST(missions_change, the_mission_keeps_all_rules_afterwards) {
  std::vector<mission::item> many;
  for (int i = 0; i < 10'000; ++i)
    many.emplace_back(waypoint("n" + std::to_string(i)));
  EXPECT_FALSE(changed_mission(small_mission(), "w1", many, behind::replace, "/items"));
  EXPECT_TRUE(changed_mission(small_mission(), {}, many, behind::replace, "/items"));
}

} // namespace change_test
} // namespace godwit::sim::missions
