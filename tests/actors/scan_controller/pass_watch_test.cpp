#include "actors/scan_controller/pass_watch.hpp"

#include <gtest/gtest.h>

namespace pass_watch_test {

using namespace godwit;
using namespace godwit::scan_controller;

constexpr std::int64_t second = 1'000'000'000;
const std::string this_mission = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";

struct survey_world {
  scan_controller::state state;
  settings configured{.looks_for = {"vehicle"}};
  instant now{100 * second, 1'800'000'000 * second};
  std::uint64_t process = 1;
  survey_progress at{this_mission, "field", 1, true, true, 3, 0, {{47, 8}, {47, 8.01}, {47.01, 8}}};
  std::string lost; // why

  void see() {
    while (const auto fact = on_survey(state, configured, at, process, now)) {
      if (const auto* why = std::get_if<pass_lost>(&*fact))
        lost = why->why;
      (void)durable_core::apply(state, *fact, now.wall_ns);
    }
    now.monotonic_ns += second;
    now.wall_ns += second;
  }
  void fly_upto(std::uint32_t lines_done) {
    see();
    at.is_at_beginning = false;
    see();
    while (at.lines_done < lines_done) {
      ++at.lines_done;
      see();
    }
  }
};

TEST(pass_watch, a_survey_flown_in_one_go_tells_the_map_what_was_in_view_when_sightings_have_settled) {
  survey_world w;
  const auto began_ns = w.now.wall_ns;
  w.fly_upto(3);
  ASSERT_EQ(w.state.owed_passes.size(), 1U);
  const auto& [pass, due_ns] = w.state.owed_passes.front();
  EXPECT_EQ(pass.started_ns, began_ns);
  EXPECT_EQ(pass.ended_ns, w.now.wall_ns - second);
  EXPECT_EQ(due_ns, w.now.monotonic_ns - second + pass_settles_ns);
  EXPECT_EQ(pass.class_groups, std::vector<std::string>{"vehicle"});
  ASSERT_EQ(pass.polygons.size(), 1U);
  EXPECT_EQ(pass.polygons[0].vertices.size(), 3U);
}

TEST(pass_watch, it_is_told_once) {
  survey_world w;
  w.fly_upto(3);
  w.at.is_flying = false;
  w.see();
  w.at.is_flying = true;
  w.see();
  EXPECT_EQ(w.state.owed_passes.size(), 1U);
}

TEST(pass_watch, a_survey_that_is_held_taken_over_or_aborted_is_no_pass_also_when_it_is_flown_on) {
  survey_world w;
  w.fly_upto(1);
  w.at.is_flying = false;
  w.see();
  w.at.is_flying = true;
  w.see();
  w.fly_upto(3);
  EXPECT_TRUE(w.state.owed_passes.empty());
  EXPECT_FALSE(w.lost.empty());
}

TEST(pass_watch, the_rest_of_a_survey_after_a_new_plan_is_no_pass) {
  survey_world w;
  w.fly_upto(1);
  w.at.generation = 2;
  w.fly_upto(3);
  EXPECT_TRUE(w.state.owed_passes.empty());
}

TEST(pass_watch, flown_again_from_its_beginning_by_a_new_plan_it_is_a_pass) {
  survey_world w;
  w.fly_upto(1);
  w.at = {this_mission, "field", 2, true, true, 3, 0, w.at.polygon};
  w.fly_upto(3);
  EXPECT_EQ(w.state.owed_passes.size(), 1U);
}

TEST(pass_watch, entered_after_its_first_line_it_is_no_pass) {
  survey_world w;
  w.at.is_at_beginning = false;
  w.fly_upto(3);
  EXPECT_TRUE(w.state.owed_passes.empty());
}

TEST(pass_watch, with_a_line_left_out_it_is_no_pass) {
  survey_world w;
  w.fly_upto(1);
  w.at.lines_done = 3;
  w.see();
  EXPECT_TRUE(w.state.owed_passes.empty());
}

TEST(pass_watch, a_process_that_was_started_again_has_not_seen_all_of_it) {
  survey_world w;
  w.fly_upto(1);
  w.process = 2;
  w.fly_upto(3);
  EXPECT_TRUE(w.state.owed_passes.empty());
}

TEST(pass_watch, a_clock_that_was_set_back_makes_it_no_pass) {
  survey_world w;
  w.fly_upto(1);
  w.now.wall_ns -= 3'600 * second;
  w.fly_upto(3);
  EXPECT_TRUE(w.state.owed_passes.empty());
}

TEST(pass_watch, where_nobody_has_said_what_is_looked_for_there_are_no_passes) {
  survey_world w;
  w.configured.looks_for.clear();
  w.fly_upto(3);
  EXPECT_FALSE(w.state.pass);
}

TEST(pass_watch, an_area_that_the_map_would_refuse_is_not_told) {
  survey_world w;
  w.at.polygon.resize(257);
  w.fly_upto(3);
  EXPECT_TRUE(w.state.owed_passes.empty());
  EXPECT_NE(w.lost.find("corners"), std::string::npos);
}

// A pass that is open, with a camera, and what is said of the view.
struct watched_world : survey_world {
  watched_world() {
    configured.watches_view = true;
    see();
    at.is_at_beginning = false;
    see();
  }
  bool is_lost() { return on_view(state, configured, watch, now.monotonic_ns).has_value(); }
  view_watch watch;
};

TEST(pass_watch, a_pass_of_which_a_part_was_not_seen_is_lost_and_who_says_nothing_does_not_see) {
  watched_world w;
  w.watch.on_view({true, {}}, w.now.monotonic_ns);
  EXPECT_FALSE(w.is_lost());
  w.now.monotonic_ns += view_lasts_ns - 1;
  EXPECT_FALSE(w.is_lost());
  w.now.monotonic_ns += 1;
  EXPECT_TRUE(w.is_lost());
  w.watch.on_view({true, {}}, w.now.monotonic_ns);
  EXPECT_FALSE(w.is_lost());
  w.watch.on_view({false, "the lens is covered"}, w.now.monotonic_ns);
  const auto lost = on_view(w.state, w.configured, w.watch, w.now.monotonic_ns);
  ASSERT_TRUE(lost);
  EXPECT_EQ(std::get<pass_lost>(*lost).why, "the camera has not seen all of it: the lens is covered");
}

TEST(pass_watch, nobody_has_to_see_without_a_camera_before_the_first_line_or_after_the_last) {
  watched_world w;
  ASSERT_TRUE(w.is_lost());
  w.watch.is_on_lines = false;
  EXPECT_FALSE(w.is_lost());
  w.watch.is_on_lines = true;
  w.configured.watches_view = false;
  EXPECT_FALSE(w.is_lost());
  w.configured.watches_view = true;
  (void)durable_core::apply(w.state, pass_lost{"held"}, w.now.wall_ns);
  EXPECT_FALSE(w.is_lost()) << "it is over";
}

} // namespace pass_watch_test
