#include "actors/mapobjects_store/observation_table.hpp"

#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
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
