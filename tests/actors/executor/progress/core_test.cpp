#include "actors/executor/progress/core.hpp"

#include <gtest/gtest.h>

#include "io/fields/json_text.hpp"
#include "tests/actors/executor/progress/progress_fixture.hpp"

namespace godwit::executor::progress {
namespace progress_core_test {

using namespace test;

TEST(progress_core, the_same_events_give_the_same_effects) {
  const auto play = [] {
    progress_fixture d;
    d.fly({"A", "B"});
    d.current(1);
    d.upload({"Z"}, 1);
    d.current(0);
    return io::to_json(d.s);
  };
  EXPECT_EQ(play(), play());
}

TEST(progress_core, a_report_tells_mission_revision_generation_number_time_and_item) {
  progress_fixture d;
  d.fly({"A"});
  const mission::progress_report expected{.mission_id = "m",
                                          .revision = 1,
                                          .generation = 1,
                                          .report_no = 1,
                                          .kind = mission::progress_kind::started,
                                          .item_id = "A",
                                          .item_index = 0U,
                                          .at = "2023-11-14T22:13:20Z"};
  EXPECT_EQ(d.reports.at(0), expected);
  EXPECT_EQ(last_progress(d.s), expected);
}

TEST(progress_core, a_new_incarnation_with_nothing_under_way_has_nothing_to_look_at) {
  progress_fixture d;
  d.fly({"A"});
  EXPECT_TRUE(resume(d.s).empty());
  EXPECT_TRUE(resume({}).empty());
}

TEST(progress_core, a_message_that_was_said_before_does_not_matter) {
  progress_fixture d;
  d.fly({"A", "B"});
  EXPECT_FALSE(matters(d.s, current_told{d.current_message(0)}, d.now_ns));
  EXPECT_TRUE(matters(d.s, current_told{d.current_message(1)}, d.now_ns));
  EXPECT_TRUE(matters(d.s, reached_told{0}, d.now_ns));
  d.reached(0);
  EXPECT_FALSE(matters(d.s, reached_told{0}, d.now_ns));
}

TEST(progress_core, what_waits_makes_the_next_message_matter_when_its_time_is_over) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.current(1);
  EXPECT_FALSE(matters(d.s, current_told{d.current_message(1)}, d.now_ns));
  d.wait_s(1);
  EXPECT_TRUE(matters(d.s, current_told{d.current_message(1)}, d.now_ns));
}

TEST(progress_core, what_the_vehicle_says_before_there_is_a_plan_changes_nothing) {
  state s;
  EXPECT_FALSE(matters(s, current_told{{.seq = 1, .total = 3, .mission_id = 9}}, 0));
  EXPECT_FALSE(matters(s, reached_told{1}, 0));
  EXPECT_FALSE(matters(s, vehicle_rebooted{}, 0));
  EXPECT_FALSE(matters(s, start_ended{true}, 0));
  EXPECT_FALSE(matters(s, mission_aborted{}, 0));
}

} // namespace progress_core_test
} // namespace godwit::executor::progress
