#include "actors/mapobjects_store/pass_review.hpp"

#include <algorithm>

#include "actors/mapobjects_store/ignore_list.hpp"
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
} // namespace godwit::mapobjects_store
