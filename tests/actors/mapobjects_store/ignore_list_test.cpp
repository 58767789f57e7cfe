#include "actors/mapobjects_store/geo_point.hpp"
#include "actors/mapobjects_store/ignore_list.hpp"

#include "actors/domain/geo/mgrs.hpp"
#include "actors/mapobjects_store/object_table.hpp"
#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
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
