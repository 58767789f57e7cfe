#include "actors/ground_port/mission_server/plan_store.hpp"

#include <gtest/gtest.h>

namespace godwit::ground_port::mission_server {
namespace plan_store_test {

using mavlink::mav_mission_type;

mavlink::mission_item_int item(int seq, int x) {
  mavlink::mission_item_int result;
  result.seq = static_cast<std::uint16_t>(seq);
  result.command = mavlink::number(mavlink::mav_cmd::nav_waypoint);
  result.x = x;
  return result;
}

void put(plan_store& store, int count, int x) {
  for (int i = 0; i < count; ++i)
    store.put(item(i, x + i));
}

TEST(plan_store, an_atomic_vehicle_holds_the_old_plan_until_the_new_one_is_complete) {
  plan_store store(px4_profile());
  store.begin(mav_mission_type::mission, 3);
  put(store, 3, 10);
  EXPECT_TRUE(store.plan(mav_mission_type::mission).items.empty());
  (void)store.complete();
  store.begin(mav_mission_type::mission, 2);
  put(store, 1, 90);
  EXPECT_EQ(store.plan(mav_mission_type::mission).items.size(), 3U);
  store.discard();
  EXPECT_EQ(store.plan(mav_mission_type::mission).items[0].x, 10);
}

TEST(plan_store, ardupilot_holds_a_mixture_in_between) {
  plan_store store(ardupilot_copter_profile());
  store.begin(mav_mission_type::mission, 4);
  put(store, 4, 10);
  (void)store.complete();
  store.begin(mav_mission_type::mission, 3);
  put(store, 2, 90);
  store.discard();
  const auto& items = store.plan(mav_mission_type::mission).items;
  ASSERT_EQ(items.size(), 3U);
  EXPECT_EQ(items[1].x, 91);
  EXPECT_EQ(items[2].x, 12);
}

TEST(plan_store, item_0_of_an_ardupilot_mission_is_home_and_only_of_a_mission) {
  auto vehicle = ardupilot_copter_profile();
  vehicle.home->x = 77;
  plan_store store(vehicle);
  store.begin(mav_mission_type::mission, 2);
  put(store, 2, 10);
  (void)store.complete();
  EXPECT_EQ(store.plan(mav_mission_type::mission).items[0].x, 77);
  EXPECT_EQ(store.plan(mav_mission_type::mission).items[1].x, 11);
  store.begin(mav_mission_type::rally, 1);
  put(store, 1, 10);
  (void)store.complete();
  EXPECT_EQ(store.plan(mav_mission_type::rally).items[0].x, 10);
}

TEST(plan_store, the_same_plan_has_the_same_id_and_another_one_another) {
  plan_store store(px4_profile());
  store.begin(mav_mission_type::mission, 2);
  put(store, 2, 10);
  (void)store.complete();
  const auto id = store.plan(mav_mission_type::mission).id;
  EXPECT_NE(id, 0U);
  store.begin(mav_mission_type::mission, 2);
  put(store, 2, 20);
  (void)store.complete();
  EXPECT_NE(store.plan(mav_mission_type::mission).id, id);
  store.begin(mav_mission_type::mission, 2);
  put(store, 2, 10);
  (void)store.complete();
  EXPECT_EQ(store.plan(mav_mission_type::mission).id, id);
  store.clear(mav_mission_type::mission);
  EXPECT_EQ(store.plan(mav_mission_type::mission).id, 0U);
}

TEST(plan_store, the_id_says_nothing_of_address_type_and_mark) {
  auto other = item(0, 10);
  const auto id = checksum_of({other});
  other.current = 1;
  other.target_system = 7;
  other.target_component = 8;
  other.mission_type = 2;
  EXPECT_EQ(checksum_of({other}), id);
  other.param1 = 1;
  EXPECT_NE(checksum_of({other}), id);
}

TEST(plan_store, a_restored_plan_has_the_id_that_it_had) {
  plan_store store(px4_profile());
  store.begin(mav_mission_type::mission, 2);
  put(store, 2, 10);
  EXPECT_FALSE(store.complete());
  const auto held = store.plan(mav_mission_type::mission);
  plan_store later(px4_profile());
  later.restore(mav_mission_type::mission, held.items);
  EXPECT_EQ(later.plan(mav_mission_type::mission).id, held.id);
  later.begin(mav_mission_type::mission, 2);
  put(later, 2, 10);
  EXPECT_TRUE(later.complete()) << "the same again";
}

TEST(plan_store, a_vehicle_without_ids_has_none) {
  plan_store store(ardupilot_copter_profile());
  store.begin(mav_mission_type::mission, 2);
  put(store, 2, 10);
  (void)store.complete();
  EXPECT_EQ(store.plan(mav_mission_type::mission).id, 0U);
}

TEST(checksum_of, no_items_have_none) { EXPECT_EQ(checksum_of({}), 0U); }

} // namespace plan_store_test
} // namespace godwit::ground_port::mission_server
