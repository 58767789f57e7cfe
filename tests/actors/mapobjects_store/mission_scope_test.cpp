#include <gtest/gtest.h>

#include "actors/mapobjects_store/mission_scope.hpp"
#include "actors/mapobjects_store/sightings.hpp"
#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {

namespace mission_scope_test {

using namespace godwit::tests;

class mission_scope : public tests::map_test {
protected:
  void choose(const std::string& mission) {
    ASSERT_TRUE(store->transact([&](map_tables& t) { return mapobjects_store::choose(t, {mission}); }));
  }
  void fail_pull(const std::string& mission = mission_a) {
    ASSERT_TRUE(store->transact([&](map_tables& t) { return fall_back(t, {mission}); }));
  }
  std::uint64_t delete_it(const std::string& mission) {
    return store->transact([&](map_tables& t) {
                  return forget(t, {mission, 9, "the mission was deleted"});
                })
        .value_or(99);
  }
  [[nodiscard]] sync_state sync() const { return store->map().sync; }
};

TEST_F(mission_scope, the_state_of_a_mission_survives_a_restart_in_flight) {
  choose(mission_a);
  load({object(1, place(0))});
  close();
  open();
  choose(mission_a);
  EXPECT_EQ(sync(), sync_state::synced);
}

TEST_F(mission_scope, a_failed_pull_falls_back_on_the_copy_of_the_same_mission_when_the_operator_says_so) {
  load({object(1, place(0))});
  fail_pull();
  EXPECT_EQ(sync(), sync_state::degraded);
  ASSERT_TRUE(store->transact([](map_tables& t) { return accept_fallback(t, {mission_a}); }));
  EXPECT_EQ(sync(), sync_state::cached_fallback);
  EXPECT_EQ(shown(), std::vector{uuid(1)});
}

TEST_F(mission_scope, the_copy_of_another_mission_is_neither_shown_nor_a_fallback) {
  load({object(1, place(0))});
  choose(mission_b);
  EXPECT_EQ(sync(), sync_state::fresh_boot);
  EXPECT_TRUE(shown().empty());
  fail_pull(mission_b);
  EXPECT_EQ(sync(), sync_state::failed);
  collect_garbage();
  choose(mission_a); // it was mistyped
  EXPECT_EQ(shown(), std::vector{uuid(1)});
}

TEST_F(mission_scope, a_deleted_mission_leaves_the_map_and_what_is_owed_becomes_orphans_at_once) {
  load({object(1, place(0))});
  record(seen(10, place(20)));
  record(seen(11, place(200)));
  record(seen(12, place(300), 1, mission_b));
  ASSERT_TRUE(store->transact([](map_tables& t) { return judge(t, verdict_on(50, place(0))); }));
  take(901, 1);
  EXPECT_EQ(delete_it(mission_a), 3U);
  EXPECT_EQ(shown(), std::vector{uuid(12)});
  EXPECT_EQ(sync(), sync_state::fresh_boot);
  EXPECT_EQ(count("orphaned_observation WHERE reason = 'the mission was deleted'"), 2);
  EXPECT_EQ(count("orphaned_ignored_item"), 1);
  EXPECT_EQ(kind(seen(13, place(0))), observation_kind::found); // nothing is ignored any more
  EXPECT_EQ(ids_of(take(902, 10, mission_b)), std::vector{uuid(12)});
  EXPECT_EQ(ids_of(take(901)), std::vector{uuid(10)});
  EXPECT_EQ(delete_it(mission_a), 1U); // the one of id 13
}

TEST_F(mission_scope, a_mission_that_is_not_shown_can_be_deleted_beside_one_that_is) {
  load({object(1, place(0))});
  EXPECT_EQ(delete_it(mission_b), 0U);
  EXPECT_EQ(shown(), std::vector{uuid(1)});
  EXPECT_EQ(sync(), sync_state::synced);
}

TEST_F(mission_scope, what_is_said_of_another_mission_than_the_chosen_one_is_refused) {
  choose(mission_a);
  EXPECT_EQ(store->transact([](map_tables& t) { return fall_back(t, {mission_b}); }).error().code, map_errc::refused);
  EXPECT_EQ(store->transact([](map_tables& t) { return accept_fallback(t, {mission_b}); }).error().code,
            map_errc::refused);
}

TEST_F(mission_scope, only_a_degraded_map_can_be_acknowledged) {
  load({});
  EXPECT_FALSE(store->transact([](map_tables& t) { return accept_fallback(t, {mission_a}); }));
  fail_pull();
  EXPECT_TRUE(store->transact([](map_tables& t) { return accept_fallback(t, {mission_a}); }));
  EXPECT_TRUE(store->transact([](map_tables& t) { return accept_fallback(t, {mission_a}); })); // said again
}

TEST_F(mission_scope, a_pull_that_failed_gives_up_its_load) {
  choose(mission_a);
  const auto number = begin_load();
  fail_pull();
  EXPECT_EQ(finish(number, 0).error().code, map_errc::load_given_up);
}

TEST_F(mission_scope, a_load_for_a_deleted_mission_is_given_up) {
  const auto number = begin_load();
  delete_it(mission_a);
  EXPECT_FALSE(add_page({.load = number, .objects = {object(1, place(0))}, .ignored = {}}));
}

} // namespace mission_scope_test

namespace sync_test {

constexpr sync_state all_states[] = {sync_state::fresh_boot, sync_state::synced, sync_state::cached_fallback,
                                     sync_state::degraded, sync_state::failed};

TEST(sync, a_finished_pull_makes_every_state_synced) {
  for (const auto now : all_states)
    EXPECT_EQ(next_state(now, sync_event::pull_finished, true), sync_state::synced);
}

TEST(sync, a_failed_pull_degrades_what_has_a_copy_and_fails_what_has_none) {
  for (const auto now : all_states) {
    EXPECT_EQ(next_state(now, sync_event::pull_failed, true), sync_state::degraded);
    EXPECT_EQ(next_state(now, sync_event::pull_failed, false), sync_state::failed);
  }
}

TEST(sync, only_a_degraded_map_can_be_acknowledged) {
  for (const auto now : all_states)
    EXPECT_EQ(next_state(now, sync_event::fallback_acknowledged, true),
              now == sync_state::degraded ? sync_state::cached_fallback : now);
}

TEST(sync, another_mission_or_a_deleted_one_begins_anew) {
  for (const auto now : all_states) {
    EXPECT_EQ(next_state(now, sync_event::mission_chosen, true), sync_state::fresh_boot);
    EXPECT_EQ(next_state(now, sync_event::mission_deleted, true), sync_state::fresh_boot);
  }
}

TEST(sync, differences_are_findings_only_on_a_map_that_somebody_vouches_for) {
  for (const auto now : all_states)
    EXPECT_EQ(shows_findings(now), now == sync_state::synced || now == sync_state::cached_fallback);
}

} // namespace sync_test

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
