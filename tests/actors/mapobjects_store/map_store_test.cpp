#include "actors/mapobjects_store/map_store.hpp"

#include "actors/mapobjects_store/sightings.hpp"
#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace map_store_test {

using namespace godwit::tests;

class map_store_test : public tests::map_test {
protected:
  map_result<void> apply(const sighting& what) {
    return store->apply([&](map_tables& t) { return mapobjects_store::record(t, what).map([](const observed&) {}); });
  }
};

TEST_F(map_store_test, a_refused_change_leaves_those_beside_it_standing) {
  ASSERT_TRUE(store->begin());
  ASSERT_TRUE(apply(seen(1, place(0))));
  auto bad = seen(2, place(0));
  bad.confidence = 7;
  EXPECT_EQ(apply(bad).error().code, map_errc::refused);
  EXPECT_FALSE(store->is_spoilt());
  ASSERT_TRUE(apply(seen(3, place(100))));
  ASSERT_TRUE(store->commit());
  EXPECT_EQ(shown(), (std::vector{uuid(1), uuid(3)}));
}

TEST_F(map_store_test, a_change_that_fails_half_way_spoils_the_transaction) {
  ASSERT_TRUE(store->begin());
  ASSERT_TRUE(apply(seen(1, place(0))));
  const auto half = store->apply([](map_tables& t) -> map_result<void> {
    t.map.mission_id = mission_b;
    return save_map_row(t.q, t.map).and_then([] { return map_result<void>(refused("too late")); });
  });
  EXPECT_FALSE(half);
  EXPECT_TRUE(store->is_spoilt());
  store->roll_back();
  EXPECT_TRUE(store->map().mission_id.empty());
  EXPECT_TRUE(shown().empty());
  EXPECT_FALSE(store->is_spoilt());
}

TEST_F(map_store_test, what_is_not_committed_is_gone_after_a_restart) {
  ASSERT_TRUE(store->begin());
  ASSERT_TRUE(apply(seen(1, place(0))));
  close();
  open();
  EXPECT_TRUE(shown().empty());
}

} // namespace map_store_test
} // namespace godwit::mapobjects_store
