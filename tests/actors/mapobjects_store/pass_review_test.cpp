#include <algorithm>

#include "actors/mapobjects_store/mission_scope.hpp"
#include "actors/mapobjects_store/pass_review.hpp"
#include "actors/mapobjects_store/sightings.hpp"
#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {

namespace pass_review_test {

using namespace godwit::tests;

class pass_review_test : public tests::map_test {
protected:
  static pass_end pass(std::uint64_t id, std::vector<view_circle> circles, std::int64_t started_ns = 100) {
    return {.id = uuid(id),
            .mission_id = mission_a,
            .started_ns = started_ns,
            .ended_ns = 200,
            .class_groups = {"vehicle"},
            .circles = std::move(circles),
            .polygons = {},
            .confidence = 0.9};
  }

  pass_reviewed review(const pass_end& end) {
    pass_reviewed answer;
    auto job = store->review(end, [&](const map_result<pass_reviewed>& done) { answer = done.value_or(answer); });
    EXPECT_TRUE(job.has_value()) << (job ? "" : job.error().message());
    EXPECT_TRUE(store->run(**job));
    return answer;
  }

  std::int64_t missed() { return count("observation WHERE kind = 'removed_candidate'"); }
};

TEST_F(pass_review_test, what_was_in_view_and_not_seen_is_a_candidate_for_removal) {
  load({object(1, place(0)), object(2, place(50)), object(3, place(500))});
  record(seen(10, place(0), 150));
  const auto answer = review(pass(60, {{place(0), 100}}));
  EXPECT_EQ(answer.in_view, 2U);
  EXPECT_EQ(answer.removed_candidates, 1U);
  EXPECT_EQ(count("observation WHERE kind = 'removed_candidate' AND object_id = '" + uuid(2) + "'"), 1);
  EXPECT_EQ(shown().size(), 3U); // it is a candidate, not more
}

TEST_F(pass_review_test, what_was_seen_before_the_pass_and_not_in_it_is_missed) {
  record(seen(10, place(0), 50));
  EXPECT_EQ(review(pass(60, {{place(0), 100}})).removed_candidates, 1U);
}

TEST_F(pass_review_test, done_again_it_misses_nothing_twice) {
  load({object(1, place(0)), object(2, place(50))});
  EXPECT_EQ(review(pass(60, {{place(0), 100}})).removed_candidates, 2U);
  EXPECT_EQ(review(pass(60, {{place(0), 100}})).removed_candidates, 2U);
  EXPECT_EQ(missed(), 2);
  review(pass(61, {{place(0), 100}})); // another pass is another observation
  EXPECT_EQ(missed(), 4);
}

TEST_F(pass_review_test, an_object_in_several_footprints_is_looked_at_once) {
  load({object(1, place(0))});
  const auto answer = review(pass(60, {{place(0), 100}, {place(10), 100}, {place(20), 100}}));
  EXPECT_EQ(answer.in_view, 1U);
  EXPECT_EQ(missed(), 1);
}

TEST_F(pass_review_test, polygons_are_areas_too_also_across_the_antimeridian) {
  load({object(1, {0, 179.9995, {}}), object(2, {0, -179.9995, {}}), object(3, {0, -179.99, {}})});
  auto end = pass(60, {});
  end.polygons.push_back(
      {{{-0.001, 179.999, {}}, {-0.001, -179.999, {}}, {0.001, -179.999, {}}, {0.001, 179.999, {}}}});
  EXPECT_EQ(review(end).removed_candidates, 2U);
}

TEST_F(pass_review_test, class_groups_that_were_not_looked_for_are_not_missed) {
  load({object(1, place(0))});
  auto end = pass(60, {{place(0), 100}});
  end.class_groups = {"person"};
  EXPECT_EQ(review(end).in_view, 0U);
}

TEST_F(pass_review_test, what_is_ignored_is_not_missed) {
  load({object(1, place(0))});
  ASSERT_TRUE(store->transact([](map_tables& t) { return judge(t, verdict_on(50, place(0))); }));
  EXPECT_EQ(review(pass(60, {{place(0), 100}})).removed_candidates, 0U);
}

TEST_F(pass_review_test, what_moved_out_of_view_is_not_missed_where_it_was) {
  load({object(1, place(0))});
  record(seen(10, place(20), 50));
  EXPECT_EQ(review(pass(60, {{place(-10), 15}})).in_view, 0U);
}

TEST_F(pass_review_test, what_is_seen_while_the_review_runs_is_not_missed) {
  load({object(1, place(0))});
  auto job = store->review(pass(60, {{place(0), 100}}), [](const map_result<pass_reviewed>&) {});
  ASSERT_TRUE(job);
  record(seen(10, place(0), 300)); // after the end of the pass, and after the cursor was opened
  ASSERT_TRUE(store->run(**job));
  EXPECT_EQ(missed(), 0);
}

TEST_F(pass_review_test, more_objects_than_fit_a_turn_are_all_looked_at) {
  std::vector<map_object> many;
  for (std::uint64_t i = 0; i < 2500; ++i)
    many.push_back(object(i, place(0, static_cast<double>(i))));
  load(many);
  EXPECT_EQ(review(pass(60, {{place(0), 5000}})).removed_candidates, 2500U);
  EXPECT_EQ(missed(), 2500);
}

TEST_F(pass_review_test, an_unsound_pass_is_refused) {
  auto end = pass(60, {{place(0), -1}});
  EXPECT_FALSE(store->review(end, [](const map_result<pass_reviewed>&) {}));
  end = pass(60, {}, 300); // it ends before it starts
  EXPECT_FALSE(store->review(end, [](const map_result<pass_reviewed>&) {}));
}

} // namespace pass_review_test

namespace view_cursor_test {

using namespace godwit::tests;

class view_cursor_test : public tests::map_test {
protected:
  view_cursor look(double radius_m = 100, const std::string& group = "vehicle") {
    pass_end pass;
    pass.class_groups = {group};
    pass.circles = {{place(0), radius_m}, {place(1), radius_m}}; // most of it is in view twice
    auto cursor = view_cursor::open(*open_map_for_reading(folder.file()), pass);
    EXPECT_TRUE(cursor.has_value());
    return std::move(*cursor);
  }
  static std::vector<std::string> in_view(view_cursor cursor) {
    std::vector<std::string> ids;
    for (auto row = cursor.next(); row && *row; row = cursor.next())
      if ((*row)->in_view)
        ids.push_back((*row)->object_id);
    std::sort(ids.begin(), ids.end());
    return ids;
  }
};

TEST_F(view_cursor_test, loaded_and_seen_objects_are_in_view_each_once) {
  load({object(1, place(0)), object(2, place(500))});
  record(seen(10, place(50)));
  EXPECT_EQ(in_view(look()), (std::vector{uuid(1), uuid(10)}));
}

TEST_F(view_cursor_test, an_object_that_moved_is_where_it_is_now) {
  load({object(1, place(0))});
  record(seen(10, place(25)));
  auto cursor = look();
  const auto row = cursor.next();
  ASSERT_TRUE(row && *row);
  EXPECT_EQ((*row)->object_id, uuid(1));
  EXPECT_EQ((*row)->loaded_number, 0);
  EXPECT_TRUE(in_view(look(5)).empty());
}

TEST_F(view_cursor_test, what_changes_later_is_not_seen_by_it) {
  record(seen(10, place(0)));
  auto cursor = look();
  record(seen(11, place(60)));
  load({});
  EXPECT_EQ(in_view(std::move(cursor)), std::vector{uuid(10)});
}

TEST_F(view_cursor_test, other_class_groups_are_not_in_view) {
  record(seen(10, place(0)));
  EXPECT_TRUE(in_view(look(100, "person")).empty());
}

} // namespace view_cursor_test

namespace view_test {

using namespace godwit::tests;

geo::point at(double east_m, double north_m) {
  const auto there = place(east_m, north_m);
  return {there.latitude_deg, there.longitude_deg};
}

bool is_in(const std::vector<geo::bounding_box>& boxes, const geo::point& where) {
  for (const auto& box : boxes)
    if (where.latitude_deg >= box.south_deg && where.latitude_deg <= box.north_deg &&
        where.longitude_deg >= box.west_deg && where.longitude_deg <= box.east_deg)
      return true;
  return false;
}

TEST(view, each_circle_and_polygon_is_an_area) {
  pass_end pass;
  pass.circles = {{place(0), 10}, {place(100), 20}};
  pass.polygons = {{{place(0), place(10), place(10, 10)}}};
  EXPECT_EQ(areas_of(pass).size(), 3U);
}

TEST(view, a_circle_contains_its_rim_and_nothing_beyond) {
  const view_area area = circle_area{at(0, 0), 50};
  EXPECT_TRUE(contains(area, at(49.9, 0)));
  EXPECT_FALSE(contains(area, at(50.1, 0)));
  EXPECT_FALSE(contains(area, at(36, 36)));
}

TEST(view, a_polygon_contains_what_lies_between_its_edges) {
  pass_end pass;
  pass.polygons = {{{place(0), place(100), place(0, 100)}}};
  const auto areas = areas_of(pass);
  EXPECT_TRUE(contains(areas[0], at(40, 40)));
  EXPECT_FALSE(contains(areas[0], at(60, 60)));
}

TEST(view, all_that_is_in_an_area_is_in_its_boxes) {
  pass_end pass;
  pass.circles = {{place(0), 70}};
  pass.polygons = {{{place(-60, -60), place(60, -60), place(0, 60)}}};
  for (const auto& area : areas_of(pass)) {
    const auto boxes = boxes_of(area);
    for (double east_m = -80; east_m <= 80; east_m += 4)
      for (double north_m = -80; north_m <= 80; north_m += 4)
        EXPECT_TRUE(!contains(area, at(east_m, north_m)) || is_in(boxes, at(east_m, north_m)))
            << east_m << ' ' << north_m;
  }
}

} // namespace view_test

namespace object_view_test {

using namespace godwit::tests;

class object_view : public tests::map_test {
protected:
  objects_found look(const get_objects& asked = {}) {
    auto found = store->transact([&](map_tables& t) { return look_at_objects(t, asked); });
    EXPECT_TRUE(found.has_value());
    return found.value_or(objects_found{});
  }
  static map_part around(const geo_position& at, double degrees) {
    return {at.longitude_deg - degrees, at.latitude_deg - degrees, at.longitude_deg + degrees,
            at.latitude_deg + degrees};
  }
  static map_object seen_last_at(std::uint64_t id, const geo_position& at, std::int64_t last_seen_ns) {
    auto result = object(id, at);
    result.last_seen_ns = last_seen_ns;
    return result;
  }
  static std::vector<std::int64_t> times_of(const objects_found& found) {
    std::vector<std::int64_t> result;
    for (const auto& each : found.list)
      result.push_back(each.last_seen_ns);
    return result;
  }
};

TEST_F(object_view, what_was_pulled_and_what_was_seen_here_are_shown_the_newest_first) {
  load({seen_last_at(1, place(0), 30), seen_last_at(2, place(1000), 10)});
  record(seen(10, place(2000), 20));
  const auto found = look();
  EXPECT_EQ(times_of(found), (std::vector<std::int64_t>{30, 20, 10}));
  EXPECT_EQ(found.counted, 3U);
  EXPECT_TRUE(found.is_all);
  EXPECT_FALSE(found.list[0].is_seen_here);
  EXPECT_TRUE(found.list[1].is_seen_here);
  EXPECT_EQ(found.list[1].class_group, "vehicle");
  EXPECT_NEAR(found.list[1].position.latitude_deg, place(2000).latitude_deg, 1e-9);
}

TEST_F(object_view, only_what_lies_in_the_part_that_is_looked_at_counts) {
  load({seen_last_at(1, place(0), 1), seen_last_at(2, place(50'000), 2)});
  record(seen(10, place(51'000), 3));
  EXPECT_EQ(times_of(look({.within = around(place(0), 0.01)})), std::vector<std::int64_t>{1});
  EXPECT_EQ(look({.within = around(place(50'500), 0.02)}).counted, 2U);
  EXPECT_EQ(look({.within = around(place(0, 100'000), 0.01)}).counted, 0U);
}

TEST_F(object_view, a_part_may_lie_across_the_antimeridian) {
  load({seen_last_at(1, {10, 179.9, {}}, 1), seen_last_at(2, {10, -179.9, {}}, 2), seen_last_at(3, {10, 0, {}}, 3)});
  EXPECT_EQ(times_of(look({.within = {179, 9, -179, 11}})), (std::vector<std::int64_t>{2, 1}));
}

TEST_F(object_view, an_object_that_was_moved_here_is_shown_once_where_it_is_now) {
  load({seen_last_at(1, place(0), 1)});
  record(seen(10, place(20), 5));
  const auto found = look();
  ASSERT_EQ(found.list.size(), 1U);
  EXPECT_EQ(found.counted, 1U);
  EXPECT_TRUE(found.list[0].is_seen_here);
}

TEST_F(object_view, more_than_the_limit_are_counted_and_the_oldest_are_not_listed) {
  std::vector<map_object> many;
  for (std::uint64_t n = 1; n <= max_shown_objects + 20; ++n)
    many.push_back(seen_last_at(n, place(static_cast<double>(100 * n)), static_cast<std::int64_t>(n)));
  load(many);
  const auto all = look({.within = {}, .limit = 1'000'000});
  EXPECT_EQ(all.list.size(), max_shown_objects);
  EXPECT_EQ(all.list.front().last_seen_ns, static_cast<std::int64_t>(many.size()));
  EXPECT_EQ(all.list.back().last_seen_ns, 21);
  EXPECT_EQ(all.counted, many.size());
  EXPECT_TRUE(all.is_all);
  EXPECT_EQ(look({.within = {}, .limit = 3}).list.size(), 3U);
  EXPECT_EQ(look({.within = {}, .limit = 3}).counted, many.size());
}

TEST_F(object_view, of_a_large_map_no_more_than_the_bound_is_looked_at_and_that_is_said) {
  const auto load_number = begin_load();
  std::uint64_t id = 0;
  for (std::int64_t page = 0; page < 3; ++page) {
    load_page next{load_number, page, {}, {}};
    for (int i = 0; i < 4'000; ++i) {
      ++id;
      next.objects.push_back(object(id, place(static_cast<double>(id % 100), static_cast<double>(id / 100))));
    }
    ASSERT_TRUE(add_page(std::move(next)));
  }
  ASSERT_TRUE(finish(load_number, 12'000));
  const auto found = look();
  EXPECT_EQ(found.list.size(), max_shown_objects);
  EXPECT_EQ(found.counted, max_counted_objects);
  EXPECT_FALSE(found.is_all);
}

TEST_F(object_view, a_map_that_was_pulled_for_another_mission_is_not_shown) {
  load({seen_last_at(1, place(0), 1)}, {}, mission_a);
  ASSERT_TRUE(store->transact([](map_tables& t) { return choose(t, {mission_b}); }));
  EXPECT_EQ(look().counted, 0U);
}

} // namespace object_view_test

} // namespace godwit::mapobjects_store
