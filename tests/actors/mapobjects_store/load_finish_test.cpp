#include "actors/mapobjects_store/load_finish.hpp"

#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace load_finish_test {

using namespace godwit::tests;

class load_finish_test : public tests::map_test {
protected:
  std::int64_t load_pages(std::uint64_t objects) {
    const auto number = begin_load();
    load_page page{.load = number, .objects = {}, .ignored = {}};
    for (std::uint64_t i = 0; i < objects; ++i)
      page.objects.push_back(object(i, place(static_cast<double>(i))));
    EXPECT_TRUE(add_page(page));
    return number;
  }

  // One turn; it is committed when COMMIT says so.
  bool turn_of(load_finish& end, bool commit) {
    decision_context now;
    EXPECT_TRUE(store->begin());
    const auto last = store->apply(end, now);
    EXPECT_TRUE(last.has_value()) << (last ? "" : last.error().message());
    if (!commit) {
      store->roll_back();
      return false;
    }
    EXPECT_TRUE(store->commit());
    end.committed();
    return *last;
  }
};

TEST_F(load_finish_test, said_again_it_changes_nothing) {
  const auto number = load_pages(3);
  ASSERT_TRUE(finish(number, 3));
  record(seen(10, place(500)));
  ASSERT_TRUE(finish(number, 3));
  EXPECT_EQ(shown().size(), 4U);
}

TEST_F(load_finish_test, an_object_that_comes_twice_ends_the_load_and_is_named) {
  const auto number = begin_load();
  ASSERT_TRUE(add_page({.load = number, .objects = {object(2, place(0)), object(2, place(9))}, .ignored = {}}));
  const auto done = finish(number, 2);
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().what.find(uuid(2)), std::string::npos);
  EXPECT_EQ(finish(number, 2).error().code, map_errc::load_given_up);
}

TEST_F(load_finish_test, until_its_last_turn_the_old_map_is_shown_whole) {
  load({object(900, place(0))});
  const auto number = load_pages(2 * max_chunk_rows);
  load_finish end({number, static_cast<std::int64_t>(2 * max_chunk_rows), 0, 5}, [](const map_result<void>&) {});
  EXPECT_FALSE(turn_of(end, true));
  EXPECT_EQ(shown(), std::vector{uuid(900)});
  EXPECT_EQ(kind(seen(5000, place(0))), observation_kind::existing);
  while (!turn_of(end, true)) {
  }
  EXPECT_EQ(store->map().generation, number);
  EXPECT_EQ(shown().size(), 2 * max_chunk_rows);
}

TEST_F(load_finish_test, a_turn_that_was_rolled_back_is_done_again) {
  const auto number = load_pages(max_chunk_rows + 10);
  load_finish end({number, static_cast<std::int64_t>(max_chunk_rows + 10), 0, 5}, [](const map_result<void>&) {});
  turn_of(end, false);
  EXPECT_FALSE(turn_of(end, true));
  turn_of(end, false);
  EXPECT_FALSE(turn_of(end, true));
  turn_of(end, false);
  EXPECT_TRUE(turn_of(end, true));
  EXPECT_EQ(count("loaded_place_1"), static_cast<std::int64_t>(max_chunk_rows + 10));
  EXPECT_EQ(shown().size(), max_chunk_rows + 10);
}

TEST_F(load_finish_test, one_load_after_the_other_each_is_the_map) {
  for (std::uint64_t i = 1; i <= 4; ++i) {
    load({object(i, place(0)), object(100 + i, place(100))});
    EXPECT_EQ(shown(), (std::vector{uuid(i), uuid(100 + i)}));
    EXPECT_EQ(record(seen(1000 + i, place(0))).object_id, uuid(i));
  }
}

TEST_F(load_finish_test, only_its_last_turn_waits_for_the_disk) {
  const auto number = load_pages(max_chunk_rows + 10);
  load_finish end({number, static_cast<std::int64_t>(max_chunk_rows + 10), 0, 5}, [](const map_result<void>&) {});
  for (int i = 0; i < 2; ++i) {
    EXPECT_FALSE(end.must_be_synced());
    EXPECT_FALSE(turn_of(end, true));
  }
  EXPECT_TRUE(end.must_be_synced());
  EXPECT_TRUE(turn_of(end, true));
}

TEST_F(load_finish_test, an_empty_load_empties_the_map) {
  load({object(900, place(0))});
  load({});
  EXPECT_TRUE(shown().empty());
  EXPECT_EQ(store->map().sync, sync_state::synced);
}

TEST_F(load_finish_test, a_load_that_is_given_up_in_the_middle_of_its_end_is_not_shown) {
  load({object(900, place(0))});
  const auto number = load_pages(2 * max_chunk_rows);
  load_finish end({number, static_cast<std::int64_t>(2 * max_chunk_rows), 0, 5}, [](const map_result<void>&) {});
  EXPECT_FALSE(turn_of(end, true));
  const auto other = begin_load();
  EXPECT_EQ(store->run(end).error().code, map_errc::load_given_up);
  EXPECT_EQ(shown(), std::vector{uuid(900)});
  ASSERT_TRUE(finish(other, 0));
  EXPECT_TRUE(shown().empty());
  EXPECT_EQ(kind(seen(5000, place(0))), observation_kind::found); // nothing is left in the tree
}

} // namespace load_finish_test
} // namespace godwit::mapobjects_store
