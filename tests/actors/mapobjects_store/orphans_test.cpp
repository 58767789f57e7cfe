#include "actors/mapobjects_store/orphans.hpp"

#include "actors/mapobjects_store/ignore_list.hpp"
#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace orphans_test {

using namespace godwit::tests;

class orphans : public tests::map_test {
protected:
  void decline(std::uint64_t id) {
    ASSERT_TRUE(store->transact([&](map_tables& t) { return judge(t, verdict_on(id, place(0))); }));
  }
  std::uint64_t orphan_all(const std::string& mission = mission_a) {
    return store->transact([&](map_tables& t) { return orphan(t, {mission, 9, "404 not found"}); }).value_or(99);
  }
  std::uint64_t requeue_all(const std::string& mission = mission_a) {
    return store->transact([&](map_tables& t) { return requeue(t, {mission}); }).value_or(99);
  }
};

TEST_F(orphans, they_are_kept_with_the_reason_and_not_taken) {
  record(seen(1, place(0)));
  record(seen(2, place(100)));
  EXPECT_EQ(orphan_all(), 2U);
  EXPECT_TRUE(ids_of(take(901)).empty());
  EXPECT_EQ(count("orphaned_observation WHERE reason = '404 not found' AND orphaned_ns = 9"), 2);
  EXPECT_EQ(shown().size(), 2U);
  EXPECT_EQ(orphan_all(), 0U); // said again
}

TEST_F(orphans, those_of_other_missions_stay_in_the_queue) {
  record(seen(1, place(0)));
  EXPECT_EQ(orphan_all(mission_b), 0U);
  EXPECT_EQ(ids_of(take(901)), std::vector{uuid(1)});
}

TEST_F(orphans, by_hand_they_are_queued_again_those_of_one_mission_or_all) {
  record(seen(1, place(0)));
  record(seen(2, place(100), 1, mission_b));
  orphan_all();
  orphan_all(mission_b);
  EXPECT_EQ(requeue_all(mission_b), 1U);
  EXPECT_EQ(ids_of(take(901, 10, mission_b)), std::vector{uuid(2)});
  EXPECT_EQ(requeue_all(""), 1U);
  EXPECT_EQ(ids_of(take(902)), std::vector{uuid(1)});
  EXPECT_EQ(count("orphaned_observation"), 0);
}

TEST_F(orphans, a_batch_is_not_queued_again_because_its_key_may_be_known_to_the_service) {
  record(seen(1, place(0)));
  record(seen(2, place(100)));
  take(901, 1);
  orphan_all();
  EXPECT_EQ(requeue_all(), 1U);
  EXPECT_EQ(ids_of(take(902)), std::vector{uuid(2)});
  EXPECT_EQ(ids_of(take(901)), std::vector{uuid(1)});
}

TEST_F(orphans, a_batch_of_them_that_is_given_back_is_pending_again) {
  record(seen(1, place(0)));
  decline(50);
  take(901);
  take(902, 10, mission_a, destination::ignored_items);
  orphan_all();
  for (const auto key : {901, 902})
    EXPECT_TRUE(store->transact([&](map_tables& t) { return give_back(t, {uuid(static_cast<std::uint64_t>(key))}); }));
  EXPECT_EQ(count("orphaned_observation"), 0);
  EXPECT_EQ(ids_of(take(903)), std::vector{uuid(1)});
  EXPECT_EQ(ids_of(take(904, 10, mission_a, destination::ignored_items)), std::vector{uuid(50)});
}

TEST_F(orphans, an_ignored_item_still_ignores_and_can_be_queued_again) {
  decline(50);
  EXPECT_EQ(orphan_all(), 1U);
  EXPECT_EQ(kind(seen(1, place(0))), observation_kind::ignored);
  EXPECT_TRUE(ids_of(take(901, 10, mission_a, destination::ignored_items)).empty());
  EXPECT_EQ(requeue_all(), 1U);
  EXPECT_EQ(ids_of(take(902, 10, mission_a, destination::ignored_items)), std::vector{uuid(50)});
}

TEST_F(orphans, a_sighting_that_comes_again_as_an_orphan_is_recognised) {
  record(seen(1, place(0)));
  orphan_all();
  record(seen(1, place(0)));
  EXPECT_TRUE(ids_of(take(901)).empty());
}

TEST_F(orphans, after_a_restart_they_are_there) {
  record(seen(1, place(0)));
  orphan_all();
  close();
  open();
  EXPECT_EQ(requeue_all(), 1U);
}

} // namespace orphans_test
} // namespace godwit::mapobjects_store
