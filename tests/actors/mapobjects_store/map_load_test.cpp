#include "actors/mapobjects_store/map_load.hpp"
#include "actors/mapobjects_store/mission_scope.hpp"
#include "actors/mapobjects_store/staged_work.hpp"
#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {

namespace map_load_test {

using namespace godwit::tests;

using map_load = tests::map_test;

TEST_F(map_load, of_changes_keeps_the_rest_of_the_copy) {
  load({object(1, place(0)), object(2, place(100)), object(3, place(200))});
  load_change({object(2, place(300)), object(4, place(400))}, {uuid(3), uuid(77)});
  EXPECT_EQ(shown(), (std::vector{uuid(1), uuid(2), uuid(4)}));
  EXPECT_EQ(kind(seen(10, place(300))), observation_kind::existing);
  EXPECT_EQ(kind(seen(11, place(0))), observation_kind::existing);
  EXPECT_EQ(kind(seen(12, place(200))), observation_kind::found) << "it was removed";
  load_change({}, {uuid(1)});
  EXPECT_EQ(shown(), (std::vector{uuid(2), uuid(4), uuid(12)}));
}

TEST_F(map_load, of_changes_takes_over_more_than_one_turn_writes) {
  std::vector<map_object> all;
  for (std::uint64_t i = 1; i <= 3 * max_chunk_rows / 2; ++i)
    all.push_back(object(i, place(static_cast<double>(50 * i))));
  load(all);
  load_change({}, {uuid(5)});
  EXPECT_EQ(shown().size(), all.size() - 1);
  collect_garbage();
  EXPECT_EQ(shown().size(), all.size() - 1);
}

TEST_F(map_load, of_changes_needs_the_copy) {
  const auto number = begin_load();
  load_finish end({.load = number, .is_change = true}, [](const map_result<void>&) {});
  EXPECT_EQ(store->run(end).error().code, map_errc::refused);
}

TEST_F(map_load, the_mark_of_the_copy_is_told_as_the_next_one_begins) {
  const auto mark = [&](const std::string& mission) {
    return store->transact([&](map_tables& t) { return begin(t, {mission}); }).value().mark;
  };
  ASSERT_TRUE(store->transact([](map_tables& t) { return choose(t, {mission_a}); }));
  load({object(1, place(0))});
  EXPECT_EQ(mark(mission_a), "") << "the service gave none";
  load_change({}, {}, "m-17");
  close();
  open();
  EXPECT_EQ(mark(mission_a), "m-17");
  EXPECT_EQ(mark(mission_b), "");
}

TEST_F(map_load, until_its_last_step_everybody_sees_the_old_map) {
  load({object(1, place(0))});
  const auto number = begin_load();
  ASSERT_TRUE(add_page({.load = number, .objects = {object(2, place(100))}, .ignored = {}}));
  EXPECT_EQ(shown(), std::vector{uuid(1)});
  EXPECT_EQ(kind(seen(10, place(100))), observation_kind::found);
  ASSERT_TRUE(finish(number, 1));
  EXPECT_EQ(shown(), (std::vector{uuid(2), uuid(10)}));
}

TEST_F(map_load, what_was_seen_here_and_not_delivered_stays) {
  load({object(1, place(0)), object(2, place(100))});
  record(seen(10, place(200)));
  record(seen(11, place(20))); // moves the first one
  load({object(1, place(0)), object(2, place(100))});
  EXPECT_EQ(shown(), (std::vector{uuid(1), uuid(2), uuid(10)}));
  EXPECT_EQ(kind(seen(12, place(20))), observation_kind::existing);
}

TEST_F(map_load, what_was_delivered_before_it_began_is_the_services_business) {
  record(seen(10, place(0)));
  deliver_all();
  load({});
  EXPECT_TRUE(shown().empty());
}

TEST_F(map_load, what_was_delivered_while_it_ran_stays_until_the_next_one) {
  record(seen(10, place(0)));
  take(901);
  const auto number = begin_load();
  delivered(901);
  ASSERT_TRUE(finish(number, 0));
  EXPECT_EQ(shown(), std::vector{uuid(10)});
  load({});
  EXPECT_TRUE(shown().empty());
}

TEST_F(map_load, a_new_one_gives_up_the_older_one) {
  const auto first = begin_load();
  const auto second = begin_load();
  const auto late = add_page({.load = first, .objects = {object(1, place(0))}, .ignored = {}});
  EXPECT_EQ(late.error().code, map_errc::load_given_up);
  EXPECT_EQ(finish(first, 0).error().code, map_errc::load_given_up);
  EXPECT_TRUE(finish(second, 0));
}

TEST_F(map_load, one_that_is_not_complete_is_refused_and_the_old_map_stays) {
  load({object(1, place(0))});
  const auto number = begin_load();
  ASSERT_TRUE(add_page({.load = number, .objects = {object(2, place(100))}, .ignored = {}}));
  EXPECT_FALSE(finish(number, 2));
  EXPECT_EQ(shown(), std::vector{uuid(1)});
}

TEST_F(map_load, an_unsound_object_ends_the_load_and_is_named) {
  const auto number = begin_load();
  auto nowhere = object(3, place(0));
  nowhere.position.longitude_deg = 200;
  const auto unsound = add_page({.load = number, .objects = {object(2, place(0)), nowhere}, .ignored = {}});
  ASSERT_FALSE(unsound);
  EXPECT_EQ(unsound.error().code, map_errc::refused);
  EXPECT_NE(unsound.error().what.find(uuid(3)), std::string::npos);
  EXPECT_EQ(finish(number, 0).error().code, map_errc::load_given_up);
}

TEST_F(map_load, an_object_of_another_mission_is_refused) {
  EXPECT_FALSE(add_page({.load = begin_load(), .objects = {object(1, place(0), mission_b)}, .ignored = {}}));
}

TEST_F(map_load, an_ignored_item_that_comes_twice_ends_the_load_and_is_named) {
  const ignored_item item{uuid(70), mission_a, "33UXP04", "vehicle", 1};
  const auto twice = add_page({.load = begin_load(), .objects = {}, .ignored = {item, item}});
  ASSERT_FALSE(twice);
  EXPECT_NE(twice.error().what.find(uuid(70)), std::string::npos);
}

TEST_F(map_load, a_page_that_comes_again_is_passed_over_and_one_too_early_is_refused) {
  const auto number = begin_load();
  const load_page first{.load = number, .number = 0, .objects = {object(1, place(0))}, .ignored = {}};
  EXPECT_FALSE(add_page({.load = number, .number = 1, .objects = {object(2, place(100))}, .ignored = {}}));
  EXPECT_TRUE(add_page(first));
  EXPECT_TRUE(add_page(first));
  EXPECT_TRUE(add_page({.load = number, .number = 1, .objects = {object(2, place(100))}, .ignored = {}}));
  EXPECT_TRUE(finish(number, 2));
}

TEST_F(map_load, a_page_larger_than_its_bound_is_refused) {
  load_page page{.load = begin_load(), .objects = {}, .ignored = {}};
  page.objects.resize(max_page_rows + 1, object(1, place(0)));
  EXPECT_EQ(add_page(page).error().code, map_errc::refused);
}

TEST_F(map_load, a_page_takes_several_turns_and_comes_whole) {
  load_page page{.load = begin_load(), .objects = {}, .ignored = {}};
  for (std::uint64_t i = 0; i < max_chunk_rows + 500; ++i)
    page.objects.push_back(object(i, place(static_cast<double>(i))));
  ASSERT_TRUE(add_page(page));
  ASSERT_TRUE(finish(page.load, max_chunk_rows + 500));
  EXPECT_EQ(shown().size(), max_chunk_rows + 500);
}

TEST_F(map_load, after_a_crash_in_the_middle_the_old_map_is_shown_and_the_next_load_works) {
  load({object(1, place(0))});
  const auto number = begin_load();
  ASSERT_TRUE(add_page({.load = number, .objects = {object(2, place(100))}, .ignored = {}}));
  close();
  open();
  EXPECT_EQ(finish(number, 1).error().code, map_errc::load_given_up);
  EXPECT_EQ(shown(), std::vector{uuid(1)});
  load({object(3, place(0))});
  EXPECT_EQ(shown(), std::vector{uuid(3)});
}

} // namespace map_load_test

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

TEST_F(load_finish_test, a_turn_of_changes_that_was_rolled_back_is_done_again) {
  load({object(1, place(0)), object(2, place(100)), object(3, place(200))});
  const auto number = begin_load();
  ASSERT_TRUE(add_page({.load = number, .objects = {object(4, place(300))}, .ignored = {}, .removed = {uuid(2)}}));
  load_finish end({.load = number, .objects = 1, .is_change = true}, [](const map_result<void>&) {});
  for (int turn = 0;; ++turn) {
    EXPECT_FALSE(turn_of(end, false));
    EXPECT_EQ(shown(), (std::vector{uuid(1), uuid(2), uuid(3)}));
    ASSERT_LT(turn, 9);
    if (turn_of(end, true))
      break;
  }
  EXPECT_EQ(shown(), (std::vector{uuid(1), uuid(3), uuid(4)}));
}

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
