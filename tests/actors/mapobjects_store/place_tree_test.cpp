#include "actors/mapobjects_store/place_tree.hpp"

#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace place_tree_test {

using namespace godwit::tests;

class place_tree : public tests::map_test {
protected:
  void fill(std::int64_t tree, std::int64_t places) {
    const auto done = store->transact([&](map_tables& t) -> map_result<void> {
      for (std::int64_t i = 1; i <= places; ++i)
        if (auto added = add_place(t.q, tree, {{}, i, 0.001 * static_cast<double>(i), 16, 0}); !added)
          return added;
      return {};
    });
    ASSERT_TRUE(done.has_value());
  }
  void clear(std::int64_t tree) {
    ASSERT_TRUE(store->transact([&](map_tables& t) { return clear_tree(t.q, tree); }));
  }
};

TEST_F(place_tree, one_is_cleared_and_the_other_one_stays) {
  fill(0, 200);
  fill(1, 100);
  clear(0);
  EXPECT_EQ(count("loaded_place_0"), 0);
  EXPECT_EQ(count("loaded_place_1"), 100);
}

TEST_F(place_tree, a_cleared_one_can_be_filled_again_also_when_it_was_empty) {
  clear(1);
  fill(1, 5);
  clear(1);
  fill(1, 7);
  EXPECT_EQ(count("loaded_place_1"), 7);
}

TEST_F(place_tree, what_was_cleared_in_a_transaction_that_is_rolled_back_is_there_again) {
  fill(0, 50);
  ASSERT_TRUE(store->begin());
  ASSERT_TRUE(store->apply([](map_tables& t) { return clear_tree(t.q, 0); }));
  store->roll_back();
  EXPECT_EQ(count("loaded_place_0"), 50);
  fill(1, 1);
}

} // namespace place_tree_test
} // namespace godwit::mapobjects_store
