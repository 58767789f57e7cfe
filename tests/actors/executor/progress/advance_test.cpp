// Items done, items passed, items skipped, and the end.
#include "actors/executor/progress/advance.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/progress/progress_fixture.hpp"

namespace godwit::executor::progress {
namespace advance_test {

using namespace test;

struct advance_any : testing::TestWithParam<flavour> {
  progress_fixture d{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(on, advance_any, testing::Values(px4, ardupilot),
                         [](const auto& which) { return which.param.name; });

TEST_P(advance_any, an_item_is_done_on_reached) {
  d.fly({"A", "B"});
  d.reached(0);
  EXPECT_EQ(d.said(), (texts{"started A#0 g1", "reached A#0 g1"}));
}

TEST_P(advance_any, an_item_that_mission_current_moves_past_is_done_and_inferred) {
  d.fly({"A", "B", "C", "D"});
  d.said();
  d.current(3);
  EXPECT_EQ(d.said(), texts{}); // a REACHED may be late
  d.wait_s(1);
  d.current(3);
  EXPECT_EQ(d.said(),
            (texts{"reached A#0 g1 inferred", "reached B#1 g1 inferred", "reached C#2 g1 inferred", "started D#3 g1"}));
}

TEST_P(advance_any, a_reached_after_the_mission_current_of_the_next_item_is_not_inferred) {
  d.fly({"A", "B"});
  d.current(1);
  d.wait_ms(650);
  d.reached(0);
  EXPECT_EQ(d.said(), (texts{"started A#0 g1", "reached A#0 g1", "started B#1 g1"}));
}

TEST_P(advance_any, an_item_further_on_ends_the_wait_for_a_reached) {
  d.fly({"A", "B", "C"});
  d.current(1);
  d.wait_ms(100);
  d.current(2);
  EXPECT_EQ(d.said(), (texts{"started A#0 g1", "reached A#0 g1 inferred", "started B#1 g1"}));
  d.reached(1);
  EXPECT_EQ(d.said(), (texts{"reached B#1 g1", "started C#2 g1"}));
}

TEST_P(advance_any, reached_of_the_next_item_tells_that_the_one_before_is_done) {
  d.fly({"A", "B", "C"});
  d.current(1);
  d.reached(1);
  EXPECT_EQ(d.said(), (texts{"started A#0 g1", "reached A#0 g1 inferred", "reached B#1 g1"}));
}

TEST_P(advance_any, the_index_never_goes_back_within_a_generation) {
  d.fly({"A", "B", "C"});
  d.reached(0);
  d.current(1);
  d.current(0); // late
  d.reached(0);
  d.wait_s(2);
  d.current(0);
  d.current(2);
  d.wait_s(1);
  d.current(2);
  EXPECT_EQ(d.said(),
            (texts{"started A#0 g1", "reached A#0 g1", "started B#1 g1", "reached B#1 g1 inferred", "started C#2 g1"}));
}

TEST_P(advance_any, an_item_of_several_vehicle_items_is_done_with_its_last_movement) {
  const auto first = d.vehicle.first_sequence;
  const auto at = [&](int offset) { return static_cast<std::uint16_t>(first + offset); };
  d.upload({.first_sequence = first,
            .total = 5,
            .start_sequence = first,
            .ends_mission = true,
            .items = {{"survey", 0, at(0), 4, at(0), at(2)}, {"home", 1, at(4), 1, at(4), at(4)}}});
  d.current(0);
  d.wait_s(3);
  d.reached(0);
  d.current(1);
  d.reached(1);
  d.current(2);
  EXPECT_EQ(d.said(), texts{"started survey#0 g1"});
  d.reached(2);
  EXPECT_EQ(d.said(), texts{"reached survey#0 g1"});
  d.current(3); // a command after it
  d.current(4);
  EXPECT_EQ(d.said(), texts{"started home#1 g1"});
}

TEST_P(advance_any, an_item_without_vehicle_items_is_skipped_when_the_vehicle_comes_by) {
  auto map = map_of(d.vehicle, {"A", "B"}, 1);
  map.items.insert(map.items.begin(), {"takeoff", 0, d.vehicle.first_sequence, 0, {}, {}});
  d.upload(map);
  d.current(0, mission_state::not_started);
  EXPECT_EQ(d.said(), texts{});
  d.current(0);
  EXPECT_EQ(d.said(), (texts{"skipped takeoff#0 g1", "started A#1 g1"}));
}

// -- completion -------------------------------------------------------------------------------------

TEST_P(advance_any, the_mission_is_complete_when_the_last_item_that_moves_the_vehicle_is_done) {
  auto map = map_of(d.vehicle, {"A", "light"});
  map.items[1].first_nav_sequence.reset();
  map.items[1].last_nav_sequence.reset();
  d.upload(map);
  d.current(0);
  d.wait_s(3);
  d.news_told();
  d.reached(0);
  EXPECT_EQ(d.said(), (texts{"started A#0 g1", "reached A#0 g1", "reached light#1 g1 inferred", "complete g1"}));
  EXPECT_EQ(d.news_told(), (texts{"plan_done g1", "mission_complete g1"}));
}

TEST_P(advance_any, the_mission_is_complete_when_the_vehicle_says_so_of_our_plan) {
  d.fly({"A", "B"});
  d.current(1);
  d.reached(0);
  d.said();
  d.wait_s(5);
  d.current(1, mission_state::complete);
  EXPECT_EQ(d.said(), texts{});
  d.wait_ms(300);
  d.reached(1); // came after it
  EXPECT_EQ(d.said(), (texts{"reached B#1 g1", "complete g1"}));
}

TEST_P(advance_any, a_complete_without_a_reached_is_inferred) {
  d.fly({"A", "B"});
  d.current(1, mission_state::complete);
  d.wait_s(1);
  d.current(1, mission_state::complete);
  EXPECT_EQ(d.said(),
            (texts{"started A#0 g1", "reached A#0 g1 inferred", "reached B#1 g1 inferred", "complete g1 inferred"}));
}

TEST_P(advance_any, a_vehicle_that_stands_disarmed_is_complete_without_waiting_for_a_reached) {
  d.fly({"A", "B"});
  d.reached(0);
  d.current(1);
  d.said();
  d.wait_s(5);
  d.take(current_told{d.current_message(1, mission_state::complete), true});
  EXPECT_EQ(d.said(), (texts{"reached B#1 g1 inferred", "complete g1 inferred"}));
}

TEST_P(advance_any, complete_is_reported_once) {
  d.fly({"A", "B"});
  d.reached(0);
  d.current(1);
  d.reached(1);
  d.reached(1);
  d.current(1, mission_state::complete);
  d.crash();
  d.wait_s(2);
  d.current(1, mission_state::complete);
  d.reached(1);
  EXPECT_EQ(d.said(), (texts{"started A#0 g1", "reached A#0 g1", "started B#1 g1", "reached B#1 g1", "complete g1"}));
  d.start_at(0); // flown again: that is progress, and the mission is complete already
  d.started();
  d.current(0);
  d.wait_s(3);
  d.reached(0);
  d.current(1);
  d.reached(1);
  EXPECT_EQ(d.said(), (texts{"started A#0 g2", "reached A#0 g2", "started B#1 g2", "reached B#1 g2"}));
  EXPECT_EQ(d.news_told().back(), "plan_done g2");
}

TEST_P(advance_any, a_complete_of_the_plan_before_does_not_complete_the_new_one) {
  d.fly({"A"});
  d.reached(0);
  d.said();
  d.upload(map_of(d.vehicle, {"X"}, 1), 2);
  d.current(0, mission_state::complete);
  EXPECT_TRUE(d.is_armed());
  d.wait_s(3);
  d.current(0, mission_state::complete);
  d.wait_s(3);
  d.current(0, mission_state::complete);
  EXPECT_EQ(d.said(), texts{});
  d.current(0);
  d.current(0, mission_state::complete);
  d.wait_s(1);
  d.current(0, mission_state::complete);
  EXPECT_EQ(d.said(), (texts{"started X#1 g2", "reached X#1 g2 inferred", "complete g2 inferred"}));
}

TEST(advance, an_ardupilot_that_was_put_back_to_its_beginning_has_flown_all) {
  progress_fixture d(ardupilot);
  d.fly({"A", "B"});
  d.current(1);
  d.current(-1, mission_state::complete); // landed and disarmed
  d.wait_s(1);
  d.current(-1, mission_state::complete);
  EXPECT_EQ(d.said(),
            (texts{"started A#0 g1", "reached A#0 g1 inferred", "reached B#1 g1 inferred", "complete g1 inferred"}));
}

// From wherever it was heard last: its mission has run to its end. A PX4 stays where it was.
TEST(advance, an_ardupilot_that_was_put_back_in_a_silence_has_flown_all) {
  progress_fixture d(ardupilot);
  d.fly({"A", "B", "C", "D"});
  d.reached(0);
  d.current(1);
  d.said();
  d.wait_s(40);
  d.current(-1, mission_state::complete);
  d.wait_s(1);
  d.current(-1, mission_state::complete);
  EXPECT_EQ(d.said(), (texts{"reached B#1 g1 inferred", "reached C#2 g1 inferred", "reached D#3 g1 inferred",
                             "complete g1 inferred"}));
}

// PX4 says so of any landing, also of a pilot's.
TEST_P(advance_any, complete_before_the_last_item_that_moves_the_vehicle_completes_nothing) {
  d.fly({"A", "B", "C"});
  d.reached(0);
  d.current(1);
  d.said();
  d.current(1, mission_state::complete);
  d.reached(1);
  EXPECT_EQ(d.said(), (texts{"reached B#1 g1"}));
}

// -- several plans for one mission ------------------------------------------------------------------

TEST_P(advance_any, plans_of_one_mission_have_the_indices_of_the_mission_and_only_the_last_completes_it) {
  d.upload(map_of(d.vehicle, {"out", "drop"}, 0, false));
  d.current(0);
  d.wait_s(3);
  d.reached(0);
  d.current(1);
  d.reached(1);
  EXPECT_EQ(d.said(), (texts{"started out#0 g1", "reached out#0 g1", "started drop#1 g1", "reached drop#1 g1"}));
  EXPECT_EQ(d.news_told().back(), "plan_done g1");
  d.upload(map_of(d.vehicle, {"up", "home"}, 2, true));
  d.current(0);
  d.wait_s(3);
  d.reached(0);
  d.current(1);
  d.reached(1);
  EXPECT_EQ(d.said(),
            (texts{"started up#2 g2", "reached up#2 g2", "started home#3 g2", "reached home#3 g2", "complete g2"}));
  for (std::size_t i = 0; i < d.reports.size(); ++i)
    EXPECT_EQ(d.reports[i].report_no, i + 1);
}

// A waypoint, an act, an item that this kind of vehicle passes over, a waypoint.
plan_map with_roles(const flavour& vehicle) {
  auto map = map_of(vehicle, {"A", "act", "over", "B"});
  map.items[1].role = item_role::acts;
  map.items[2].role = item_role::unflown;
  for (const int i : {1, 2}) {
    map.items[static_cast<std::size_t>(i)].first_nav_sequence.reset();
    map.items[static_cast<std::size_t>(i)].last_nav_sequence.reset();
  }
  return map;
}

TEST_P(advance_any, an_act_is_passed_and_what_the_vehicle_passes_over_is_skipped) {
  d.upload(with_roles(d.vehicle));
  d.current(0);
  d.wait_s(3);
  d.current(0);
  d.said();
  d.reached(0);
  d.current(3);
  d.wait_s(2);
  d.current(3);
  EXPECT_EQ(d.said(),
            (texts{"reached A#0 g1", "passed act#1 g1 inferred", "skipped over#2 g1 inferred", "started B#3 g1"}));
}

// As of a DO after a waypoint: PX4 and ArduPilot have room for one of the two.
TEST_P(advance_any, a_reached_of_an_act_in_place_of_its_waypoint_tells_of_neither_what_was_not_flown) {
  d.upload(with_roles(d.vehicle));
  d.current(0);
  d.wait_s(3);
  d.current(0);
  d.said();
  d.reached(1);
  EXPECT_EQ(d.said(), texts{}) << "the vehicle is still seen on its way";
  d.current(3);
  d.wait_s(2);
  d.current(3);
  EXPECT_EQ(d.said(), (texts{"reached A#0 g1 inferred", "passed act#1 g1 inferred", "skipped over#2 g1 inferred",
                             "started B#3 g1"}));
}

// A, B, a jump from after B to A, C.
plan_map looped(const flavour& vehicle, const texts& ids = {"A", "B", "jump", "C"}) {
  auto map = map_of(vehicle, ids);
  map.items[2].role = item_role::acts;
  map.items[2].first_nav_sequence.reset();
  map.items[2].last_nav_sequence.reset();
  map.loops.push_back({map.items[0].first_sequence, map.items[2].first_sequence});
  return map;
}

void begin_loop(progress_fixture& d, const plan_map& map) {
  d.upload(map);
  d.current(0);
  d.wait_s(3);
  d.current(0);
  d.wait_s(5);
}

void fly_round(progress_fixture& d) {
  d.current(0);
  d.wait_s(2);
  d.current(0);
  d.reached(0);
  d.current(1);
  d.wait_s(2);
  d.reached(1);
}

// The rounds of a DO_JUMP: MISSION_CURRENT goes back, and REACHED comes again.
TEST_P(advance_any, each_round_of_a_loop_is_reported_once_in_a_generation_of_its_own) {
  begin_loop(d, looped(d.vehicle));
  for (int round = 0; round < 3; ++round)
    fly_round(d);
  d.current(3);
  d.reached(3);
  const texts wanted{"started A#0 g1",
                     "reached A#0 g1",
                     "started B#1 g1",
                     "reached B#1 g1",
                     "started A#0 g2",
                     "reached A#0 g2",
                     "started B#1 g2",
                     "reached B#1 g2",
                     "started A#0 g3",
                     "reached A#0 g3",
                     "started B#1 g3",
                     "reached B#1 g3",
                     "passed jump#2 g3 inferred",
                     "started C#3 g3",
                     "reached C#3 g3",
                     "complete g3"};
  EXPECT_EQ(d.said(), wanted);
}

TEST_P(advance_any, a_round_is_noticed_after_a_crash_in_it_and_without_its_first_place) {
  begin_loop(d, looped(d.vehicle, {"A", "B", "jump", "C"}));
  d.current(1);
  d.wait_s(2);
  d.crash();
  d.current(0);
  d.wait_s(2);
  d.current(0);
  d.crash();
  d.wait_s(3);
  d.reached(0);
  d.current(1);
  const texts wanted{"started A#0 g1", "reached A#0 g1 inferred", "started B#1 g1", "reached B#1 g1 inferred",
                     "started A#0 g2", "reached A#0 g2",          "started B#1 g2"};
  EXPECT_EQ(d.said(), wanted);
}

TEST_P(advance_any, a_late_word_of_the_round_before_is_no_progress_of_the_next_one) {
  begin_loop(d, looped(d.vehicle));
  fly_round(d);
  d.current(0);
  d.wait_s(1);
  d.said();
  d.reached(1);
  d.current(1);
  EXPECT_EQ(d.said(), texts{});
}

// Somebody has set the item back before it was flown.
TEST_P(advance_any, a_vehicle_that_is_led_back_before_the_end_of_a_round_begins_none) {
  begin_loop(d, looped(d.vehicle));
  d.current(1);
  d.wait_s(2);
  d.current(1);
  d.said();
  auto back = current_told{d.current_message(0)};
  back.never_near = {d.sequence(1)};
  d.take(back);
  d.wait_s(2);
  d.take(back);
  EXPECT_EQ(d.said(), texts{});
}

TEST_P(advance_any, each_jump_that_was_taken_is_counted_for_its_item_over_a_crash) {
  begin_loop(d, looped(d.vehicle));
  EXPECT_TRUE(d.s.mission->jumps.empty());
  fly_round(d);
  fly_round(d);
  d.crash();
  d.current(0);
  d.wait_s(2);
  d.current(0);
  EXPECT_EQ(d.s.mission->jumps, (std::vector<taken_jump>{{.item_id = "jump", .taken = 2, .is_certain = true}}));
}

TEST_P(advance_any, who_forgets_the_count_as_it_leaves_the_loop_counts_anew) {
  for (const bool anew : {false, true}) {
    progress_fixture f(d.vehicle);
    auto map = looped(f.vehicle);
    map.loops[0].counts_anew = anew;
    begin_loop(f, map);
    fly_round(f);
    fly_round(f);
    f.current(3);
    EXPECT_EQ(f.s.mission->jumps.size(), anew ? 0U : 1U);
  }
}

TEST_P(advance_any, after_a_silence_as_long_as_a_round_the_count_is_not_certain) {
  for (const int silent_s : {3, 5}) {
    progress_fixture f(d.vehicle);
    auto map = looped(f.vehicle);
    map.loops[0].round_ns = 4'000'000'000;
    f.upload(map);
    f.current(0);
    for (int i = 0; i < 6; ++i) {
      f.wait_s(1);
      f.current(0);
    }
    f.crash();
    f.wait_s(silent_s);
    f.current(1);
    const auto& jumps = f.s.mission->jumps;
    EXPECT_EQ(jumps.empty() || jumps.at(0).is_certain, silent_s == 3);
  }
}

// What the loop leads back to stands before the item with which the plan begins.
TEST_P(advance_any, a_plan_that_begins_within_a_loop_skips_nothing_and_is_seen_where_its_lead_in_leads) {
  const auto first = d.vehicle.first_sequence;
  const auto at = [&](int offset) { return static_cast<std::uint16_t>(first + offset); };
  for (const bool has_lead_in : {false, true}) {
    progress_fixture f(d.vehicle);
    auto map = looped(f.vehicle);
    map.items_before = 1;
    map.start_sequence = at(1);
    if (has_lead_in) {
      map.start_sequence = first;
      map.enters_at = at(3);
      map.total = static_cast<std::uint16_t>(map.total + 2);
      for (auto& each : map.items) {
        each.first_sequence = static_cast<std::uint16_t>(each.first_sequence + 2);
        for (auto* nav : {&each.first_nav_sequence, &each.last_nav_sequence})
          if (*nav)
            *nav = static_cast<std::uint16_t>(**nav + 2);
      }
      map.loops = {{at(2), at(4)}};
    }
    f.upload(map);
    const int moved = has_lead_in ? 2 : 0;
    f.wait_s(3);
    if (has_lead_in)
      f.current(0);
    f.wait_s(3);
    f.current(1 + moved);
    f.wait_s(3);
    f.current(1 + moved);
    f.reached(1 + moved);
    f.wait_s(2);
    f.current(0 + moved);
    f.wait_s(2);
    f.current(0 + moved);
    EXPECT_EQ(f.said(), (texts{"started B#1 g1", "reached B#1 g1", "started A#0 g2"})) << has_lead_in;
  }
}

TEST_P(advance_any, a_plan_that_ends_in_a_loop_is_complete_when_the_vehicle_reports_it) {
  auto map = looped(d.vehicle, {"A", "B", "jump"});
  begin_loop(d, map);
  fly_round(d);
  fly_round(d);
  for (const auto& each : d.said())
    EXPECT_FALSE(each.starts_with("complete")) << each;
  d.current(1, mission_state::complete);
  EXPECT_EQ(d.said(), (texts{"passed jump#2 g2 inferred", "complete g2 inferred"}));
}

} // namespace advance_test
} // namespace godwit::executor::progress
