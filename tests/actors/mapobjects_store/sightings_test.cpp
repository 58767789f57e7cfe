#include "actors/domain/geo/mgrs.hpp"
#include "actors/mapobjects_store/map_row.hpp"
#include "actors/mapobjects_store/object_table.hpp"
#include "actors/mapobjects_store/sightings.hpp"
#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {

namespace sightings_test {

using namespace godwit::tests;

using sightings = tests::map_test;

TEST_F(sightings, a_first_one_is_new_and_names_the_object) {
  const auto what = record(seen(1, place(0)));
  EXPECT_EQ(what.kind, observation_kind::found);
  EXPECT_EQ(what.object_id, uuid(1));
  EXPECT_EQ(shown(), std::vector{uuid(1)});
}

TEST_F(sightings, near_by_it_exists_and_its_place_stays_where_it_was) {
  record(seen(1, place(0)));
  EXPECT_EQ(kind(seen(2, place(7))), observation_kind::existing);
  EXPECT_EQ(kind(seen(3, place(-7))), observation_kind::existing); // 14 m from the second one
}

TEST_F(sightings, what_moved_is_looked_for_where_it_is_now) {
  record(seen(1, place(0)));
  EXPECT_EQ(kind(seen(2, place(25))), observation_kind::moved);
  EXPECT_EQ(kind(seen(3, place(50))), observation_kind::moved);
  EXPECT_EQ(record(seen(4, place(50))).object_id, uuid(1));
  EXPECT_EQ(kind(seen(5, place(0))), observation_kind::found);
}

TEST_F(sightings, objects_of_another_class_group_do_not_matter) {
  record(seen(1, place(0)));
  auto other = seen(2, place(0));
  other.class_group = "person";
  EXPECT_EQ(kind(other), observation_kind::found);
}

TEST_F(sightings, said_again_it_counts_once_and_the_answer_is_the_same) {
  const auto first = record(seen(1, place(0)));
  record(seen(2, place(25)));
  const auto again = record(seen(1, place(0)));
  EXPECT_TRUE(io::equal(first, again));
  EXPECT_EQ(count("observation"), 2);
  EXPECT_EQ(kind(seen(3, place(25))), observation_kind::existing);
}

TEST_F(sightings, across_the_antimeridian_it_is_the_same_object) {
  record(seen(1, {10, 179.99999, {}}));
  EXPECT_EQ(kind(seen(2, {10, -179.99999, {}})), observation_kind::existing);
  EXPECT_EQ(kind(seen(3, {10, -179.9999, {}})), observation_kind::moved);
  EXPECT_EQ(kind(seen(4, {10, 180, {}})), observation_kind::moved);
  EXPECT_EQ(kind(seen(5, {10, -180, {}})), observation_kind::existing);
}

TEST_F(sightings, at_the_pole_all_longitudes_are_near) {
  record(seen(1, {90, 0, {}}));
  EXPECT_EQ(kind(seen(2, {89.99999, 120, {}})), observation_kind::existing);
  EXPECT_EQ(kind(seen(3, {89.9999, -60, {}})), observation_kind::moved);
  EXPECT_EQ(kind(seen(4, {89.9999, 120, {}})), observation_kind::moved);
  EXPECT_EQ(kind(seen(5, {-90, 0, {}})), observation_kind::found);
}

TEST_F(sightings, an_object_that_was_pulled_keeps_its_id_when_it_moves_and_the_load_shows_through_no_more) {
  load({object(7, place(0))});
  EXPECT_EQ(record(seen(1, place(20))).object_id, uuid(7));
  const auto moved = store->transact([](map_tables& t) { return object_with(t.q, t.map, uuid(7), 1); });
  ASSERT_TRUE(moved && *moved);
  EXPECT_FALSE((*moved)->is_loaded);
  EXPECT_EQ(shown(), std::vector{uuid(7)});
}

TEST_F(sightings, findings_are_shown_only_on_a_map_that_is_synced) {
  const auto shown_for = [&](std::uint64_t id, double east_m) {
    return store->transact([&](map_tables& t) { return mapobjects_store::record(t, seen(id, place(east_m))); })->shown;
  };
  EXPECT_FALSE(shown_for(1, 0));
  load({});
  EXPECT_TRUE(shown_for(2, 100));
  EXPECT_FALSE(shown_for(3, 100)); // it exists: no news
}

TEST_F(sightings, an_unsound_one_is_refused_and_leaves_nothing) {
  auto bad = seen(1, place(0));
  bad.position.latitude_deg = 91;
  const auto done = store->transact([&](map_tables& t) { return mapobjects_store::record(t, bad); });
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, map_errc::refused);
  EXPECT_EQ(count("observation"), 0);
}

TEST_F(sightings, they_survive_a_restart) {
  record(seen(1, place(0)));
  close();
  open();
  EXPECT_EQ(kind(seen(2, place(0))), observation_kind::existing);
}

} // namespace sightings_test

namespace ignore_list_test {

using namespace godwit::tests;

class ignore_list : public tests::map_test {
protected:
  std::optional<ignored_item> judge(const operator_verdict& said) {
    const auto done = store->transact([&](map_tables& t) { return mapobjects_store::judge(t, said); });
    EXPECT_TRUE(done.has_value());
    return done.value_or(std::nullopt);
  }
};

TEST_F(ignore_list, a_decline_ignores_the_class_group_in_that_cell) {
  record(seen(1, place(0)));
  const auto item = judge(verdict_on(50, place(0)));
  ASSERT_TRUE(item);
  EXPECT_EQ(item->mgrs_cell, geo::mgrs_cell(point_of(place(0)), geo::cell_size::m_10));
  EXPECT_EQ(kind(seen(2, place(0))), observation_kind::ignored);
  auto other = seen(3, place(0));
  other.class_group = "person";
  EXPECT_EQ(kind(other), observation_kind::found);
}

TEST_F(ignore_list, a_time_out_and_a_confirmation_change_nothing) {
  record(seen(1, place(0)));
  EXPECT_FALSE(judge(verdict_on(50, place(0), verdict::timed_out)));
  EXPECT_FALSE(judge(verdict_on(51, place(0), verdict::confirmed)));
  EXPECT_EQ(kind(seen(2, place(0))), observation_kind::existing);
  EXPECT_EQ(count("ignored_item"), 0);
}

TEST_F(ignore_list, an_object_in_the_cell_is_ignored_also_when_it_is_measured_beside_it) {
  record(seen(1, place(0)));
  judge(verdict_on(50, place(0)));
  const auto beside = record(seen(2, place(20)));
  EXPECT_EQ(beside.kind, observation_kind::ignored);
  EXPECT_EQ(beside.object_id, uuid(1));
  EXPECT_EQ(kind(seen(3, place(45))), observation_kind::found);
}

TEST_F(ignore_list, a_verdict_that_comes_again_counts_once) {
  const auto first = judge(verdict_on(50, place(0)));
  const auto again = judge(verdict_on(50, place(0)));
  ASSERT_TRUE(first && again);
  EXPECT_TRUE(io::equal(*first, *again));
  EXPECT_EQ(count("ignored_item"), 1);
}

TEST_F(ignore_list, items_of_the_service_may_name_cells_of_any_size) {
  const auto cells = geo::mgrs_cells(point_of(place(0)));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    load({}, {{.id = uuid(70), .mission_id = mission_a, .mgrs_cell = cells[i], .class_group = "vehicle"}});
    EXPECT_EQ(kind(seen(80 + i, place(0))), observation_kind::ignored) << cells[i];
    EXPECT_EQ(kind(seen(90 + i, place(0, 20'000 + 100.0 * static_cast<double>(i)))), observation_kind::found);
  }
}

TEST_F(ignore_list, what_was_declined_here_stays_ignored_after_a_load_until_the_service_knows_it) {
  judge(verdict_on(50, place(0)));
  load({});
  EXPECT_EQ(kind(seen(1, place(0))), observation_kind::ignored);
  deliver_all();
  EXPECT_EQ(kind(seen(2, place(0))), observation_kind::ignored);
  load({}); // now it is the service's word that counts
  EXPECT_EQ(kind(seen(3, place(0))), observation_kind::found);
}

} // namespace ignore_list_test

} // namespace godwit::mapobjects_store
