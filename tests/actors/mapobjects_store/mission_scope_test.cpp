#include "actors/mapobjects_store/mission_scope.hpp"

#include "actors/mapobjects_store/ignore_list.hpp"
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
} // namespace godwit::mapobjects_store
