#include "actors/mapobjects_store/deliveries.hpp"
#include "actors/mapobjects_store/mission_scope.hpp"
#include "actors/mapobjects_store/sightings.hpp"
#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {

namespace deliveries_test {

using namespace godwit::tests;

class deliveries : public tests::map_test {
protected:
  void record_many(std::uint64_t many, const std::string& mission = mission_a, std::uint64_t first = 1) {
    for (std::uint64_t i = 0; i < many; ++i)
      record(seen(first + i, place(100.0 * static_cast<double>(first + i)), 1, mission));
  }
  void decline(std::uint64_t id) {
    ASSERT_TRUE(store->transact([&](map_tables& t) { return judge(t, verdict_on(id, place(0))); }));
  }
  void orphan_all() {
    ASSERT_TRUE(store->transact([](map_tables& t) { return orphan(t, {mission_a, 9, "404"}); }));
  }
  std::vector<open_batch> open_ones() {
    return store->transact([](map_tables& t) { return all_open(t.q); }).value();
  }
};

TEST_F(deliveries, each_row_is_in_one_batch_and_the_oldest_come_first) {
  record_many(5);
  EXPECT_EQ(ids_of(take(901, 2)), (std::vector{uuid(1), uuid(2)}));
  EXPECT_EQ(ids_of(take(902, 2)), (std::vector{uuid(3), uuid(4)}));
  EXPECT_EQ(ids_of(take(903, 2)), (std::vector{uuid(5)}));
  EXPECT_TRUE(ids_of(take(904, 2)).empty());
}

TEST_F(deliveries, a_key_has_the_same_rows_in_the_same_order_until_it_is_delivered) {
  record_many(3);
  const auto first = take(901, 2);
  record_many(2, mission_a, 10);
  EXPECT_TRUE(io::equal(take(901, 2).observations[1], first.observations[1]));
  close();
  open();
  EXPECT_EQ(ids_of(take(901, 1000)), ids_of(first)); // the limit is that of the first time
}

TEST_F(deliveries, a_batch_says_how_much_is_pending_after_it) {
  record_many(5);
  EXPECT_EQ(take(901, 2).pending_left, 3U);
  EXPECT_EQ(take(901, 2).pending_left, 3U);
  EXPECT_EQ(take(902).pending_left, 0U);
}

TEST_F(deliveries, an_empty_batch_leaves_nothing_behind) {
  EXPECT_TRUE(ids_of(take(901)).empty());
  EXPECT_EQ(count("batch"), 0);
  record_many(1);
  EXPECT_EQ(ids_of(take(901, 0)).size(), 0U);
  EXPECT_EQ(ids_of(take(901)), std::vector{uuid(1)});
}

TEST_F(deliveries, a_batch_is_bounded_whatever_is_asked_for) {
  record_many(max_taken + 1);
  EXPECT_EQ(take(901, 4'000'000'000).observations.size(), max_taken);
}

TEST_F(deliveries, so_many_batches_are_open_and_no_more) {
  record_many(max_open_batches + 1);
  for (std::uint64_t i = 0; i < max_open_batches; ++i)
    take(1000 + i, 1);
  const auto one_more = try_take(5000, 1);
  ASSERT_FALSE(one_more);
  EXPECT_EQ(one_more.error().code, map_errc::full);
  delivered(1000);
  EXPECT_TRUE(try_take(5000, 1));
}

TEST_F(deliveries, only_rows_of_the_mission_are_taken) {
  record_many(2);
  record_many(1, mission_b, 10);
  EXPECT_EQ(ids_of(take(901, 10, mission_b)), std::vector{uuid(10)});
}

TEST_F(deliveries, a_key_of_another_mission_or_destination_is_refused) {
  record_many(1);
  take(901);
  EXPECT_EQ(try_take(901, 1, mission_b).error().code, map_errc::refused);
  EXPECT_EQ(try_take(901, 1, mission_a, destination::ignored_items).error().code, map_errc::refused);
}

TEST_F(deliveries, what_was_taken_and_not_delivered_is_listed_for_whoever_comes_after_a_crash) {
  record_many(3);
  decline(50);
  take(901, 2);
  take(902, 2, mission_a, destination::ignored_items);
  take(903, 2);
  delivered(903);
  close();
  open();
  const auto open = open_ones();
  ASSERT_EQ(open.size(), 2U);
  EXPECT_TRUE(io::equal(open[0], open_batch{uuid(901), mission_a, destination::observations, 2, false}));
  EXPECT_TRUE(io::equal(open[1], open_batch{uuid(902), mission_a, destination::ignored_items, 1, false}));
}

TEST_F(deliveries, said_twice_to_be_delivered_it_is_so_once) {
  record_many(1);
  take(901);
  delivered(901);
  delivered(901);
  delivered(999); // nobody knows it
  EXPECT_EQ(count("observation WHERE delivery = 'delivered'"), 1);
  EXPECT_TRUE(open_ones().empty());
}

TEST_F(deliveries, a_take_that_comes_after_the_delivery_gets_no_new_rows_under_the_old_key) {
  record_many(1);
  take(901);
  delivered(901);
  record_many(1, mission_a, 10);
  EXPECT_EQ(try_take(901).error().code, map_errc::delivered);
}

TEST_F(deliveries, of_delivered_keys_the_newest_are_remembered) {
  record_many(1);
  for (std::uint64_t i = 0; i < max_delivered_keys + 5; ++i) {
    record(seen(2000 + i, place(0)));
    take(10'000 + i, 1);
    delivered(10'000 + i);
  }
  EXPECT_EQ(count("batch"), max_delivered_keys);
}

TEST_F(deliveries, a_batch_that_is_given_back_is_taken_again_in_smaller_ones_under_other_keys) {
  for (std::uint64_t i = 1; i <= 4; ++i)
    record(seen(i, place(static_cast<double>(i) * 100)));
  EXPECT_EQ(ids_of(take(901)).size(), 4U);
  for (int i = 0; i < 2; ++i) // said again it changes nothing
    EXPECT_TRUE(store->transact([](map_tables& t) { return give_back(t, {uuid(901)}); }));
  EXPECT_EQ(ids_of(take(902, 2)), (std::vector{uuid(1), uuid(2)}));
  EXPECT_EQ(ids_of(take(903, 2)), (std::vector{uuid(3), uuid(4)}));
  EXPECT_TRUE(store->transact([](map_tables& t) { return give_back(t, {uuid(901)}); }));
  EXPECT_TRUE(ids_of(take(904)).empty());
}

TEST_F(deliveries, observations_and_ignored_items_do_not_wait_for_each_other) {
  record_many(1);
  decline(50);
  EXPECT_EQ(ids_of(take(901, 10, mission_a, destination::ignored_items)), std::vector{uuid(50)});
  delivered(901);
  EXPECT_EQ(ids_of(take(902)), std::vector{uuid(1)});
}

TEST_F(deliveries, a_batch_keeps_its_rows_when_its_mission_is_gone_and_can_be_delivered_all_the_same) {
  record_many(2);
  decline(50);
  take(901, 1);
  take(902, 1, mission_a, destination::ignored_items);
  orphan_all();
  ASSERT_EQ(open_ones().size(), 2U);
  EXPECT_TRUE(open_ones()[0].orphaned);
  EXPECT_EQ(ids_of(take(901)), std::vector{uuid(1)});
  EXPECT_EQ(ids_of(take(902, 1, mission_a, destination::ignored_items)), std::vector{uuid(50)});
  delivered(901);
  delivered(902);
  EXPECT_EQ(count("orphaned_observation"), 1); // the one that was in no batch
  EXPECT_EQ(count("orphaned_ignored_item"), 0);
  EXPECT_EQ(count("observation WHERE delivery = 'delivered'"), 1);
}

TEST_F(deliveries, what_is_owed_is_said_for_each_mission_and_destination) {
  record_many(3);
  record_many(1, mission_b, 10);
  decline(50);
  take(901, 1);
  ASSERT_TRUE(store->transact([](map_tables& t) { return orphan(t, {mission_b, 9, "404"}); }));
  const auto all = what_is_owed();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_TRUE(io::equal(all[0], owed{mission_a, destination::observations, 2, 1, 0}));
  EXPECT_TRUE(io::equal(all[1], owed{mission_b, destination::observations, 0, 0, 1}));
  EXPECT_TRUE(io::equal(all[2], owed{mission_a, destination::ignored_items, 1, 0, 0}));
}

} // namespace deliveries_test

namespace observation_table_test {

using namespace godwit::tests;
using observation_table = tests::map_test;

TEST_F(observation_table, all_of_an_observation_comes_back) {
  const observation what{.id = uuid(1),
                         .mission_id = mission_a,
                         .object_id = uuid(7),
                         .kind = observation_kind::removed_candidate,
                         .class_group = "vehicle",
                         .position = {47.5, 8.25, 430.5},
                         .at_ns = 1'800'000'000'000'000'001,
                         .confidence = 0.1};
  ASSERT_TRUE(store->transact([&](map_tables& t) { return add_observation(t.q, what); }));
  const auto found = store->transact([&](map_tables& t) { return observation_with(t.q, uuid(1)); });
  ASSERT_TRUE(found && *found);
  EXPECT_TRUE(io::equal(**found, what));
}

TEST_F(observation_table, numbers_rise_and_never_come_again) {
  observation what{.id = uuid(1), .mission_id = mission_a, .object_id = {}, .class_group = "vehicle", .position = {}};
  const auto add = [&](map_tables& t) { return add_observation(t.q, what); };
  const auto first = store->transact(add);
  ASSERT_TRUE(store->transact([](map_tables& t) { return t.q.run("DELETE FROM observation"); }));
  EXPECT_GT(store->transact(add).value(), first.value());
}

TEST_F(observation_table, a_missing_is_not_a_sighting) {
  observation what{.id = uuid(1), .mission_id = mission_a, .object_id = uuid(7), .class_group = "x", .position = {}};
  what.at_ns = 100;
  what.kind = observation_kind::removed_candidate;
  ASSERT_TRUE(store->transact([&](map_tables& t) { return add_observation(t.q, what); }));
  const auto seen_since = [&](std::int64_t since_ns) {
    return store->transact([&](map_tables& t) { return was_seen(t.q, uuid(7), since_ns); }).value();
  };
  EXPECT_FALSE(seen_since(0));
  what.id = uuid(2);
  what.kind = observation_kind::existing;
  ASSERT_TRUE(store->transact([&](map_tables& t) { return add_observation(t.q, what); }));
  EXPECT_TRUE(seen_since(100));
  EXPECT_FALSE(seen_since(101));
}

} // namespace observation_table_test

} // namespace godwit::mapobjects_store
