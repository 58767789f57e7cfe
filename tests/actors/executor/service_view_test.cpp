// What the missions service is asked for again, and what becomes of a mission that it has deleted.
#include <gtest/gtest.h>

#include <algorithm>

#include "actors/executor/flight/service_view.hpp"
#include "tests/actors/executor/flight_world.hpp"
#include "tests/support/vehicle_modes.hpp"

namespace godwit::executor {
namespace service_view_test {

using mission_client::pull_state;
using mission_client::refusal;
using operators::command_kind;
using tests::flight_world;

class service_again : public testing::TestWithParam<sim::personality> {
protected:
  [[nodiscard]] static mission::document short_mission() { return tests::short_mission(GetParam()); }
  static bool has_said(const flight_world& world, std::string_view part) {
    return std::ranges::any_of(world.said(), [&](const auto& each) { return each.find(part) != std::string::npos; });
  }
};

// -- the map ----------------------------------------------------------------------------------------------

TEST_P(service_again, a_pull_that_failed_is_made_again_in_growing_pauses_and_the_mission_is_flown) {
  flight_world world({.who = GetParam(), .map = pull_state::failed});
  world.load(short_mission());
  world.run_for(25);
  EXPECT_EQ(world.pulls(), 0);
  world.run_for(10);
  EXPECT_EQ(world.pulls(), 1) << "after 30 s";
  world.pull_map(pull_state::failed);
  world.run_for(55);
  EXPECT_EQ(world.pulls(), 1);
  world.run_for(10);
  EXPECT_EQ(world.pulls(), 2) << "after 60 s more";
  world.pull_map(pull_state::synced);
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.pulls(), 2);
}

TEST_P(service_again, a_pull_whose_end_is_never_told_is_asked_for_again) {
  flight_world world({.who = GetParam(), .map = pull_state::failed});
  world.load(short_mission());
  world.run_for(35);
  ASSERT_EQ(world.pulls(), 1);
  world.crash(); // of the executor: it knows nothing of the pull
  world.pull_map(pull_state::failed);
  world.run_for(35);
  EXPECT_EQ(world.pulls(), 2);
}

TEST_P(service_again, an_operator_has_it_pulled_at_once) {
  flight_world world({.who = GetParam(), .map = pull_state::failed});
  world.load(short_mission());
  world.run_for(5);
  ASSERT_EQ(world.pulls(), 0);
  EXPECT_TRUE(world.say(command_kind::pull).is_taken);
  world.run_for(1);
  EXPECT_EQ(world.pulls(), 1);
  EXPECT_FALSE(world.say(command_kind::pull).is_taken) << "it is under way";
  world.pull_map(pull_state::synced);
  ASSERT_TRUE(world.run_until_phase(phase::flying)) << world.story();
  EXPECT_FALSE(world.say(command_kind::pull).is_taken) << "not in flight";
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

TEST_P(service_again, a_map_that_is_there_is_pulled_anew_for_an_operator_alone) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  world.load(short_mission());
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.run_for(600);
  EXPECT_EQ(world.pulls(), 0);
  EXPECT_TRUE(world.say(command_kind::pull).is_taken);
  world.run_for(1);
  EXPECT_EQ(world.pulls(), 1);
  EXPECT_FALSE(world.say(command_kind::pull).is_taken) << "it is under way";
  world.pull_map(pull_state::synced);
  ASSERT_TRUE(world.run_until_phase(phase::ready, 60)) << world.story();
  EXPECT_TRUE(world.say(command_kind::start).is_taken) << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.pulls(), 1);
}

TEST_P(service_again, in_flight_nothing_is_pulled) {
  flight_world world({.who = GetParam()});
  world.load(short_mission());
  ASSERT_TRUE(world.run_until_phase(phase::flying)) << world.story();
  world.pull_map(pull_state::failed);
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.pulls(), 0);
}

TEST_P(service_again, a_copy_that_is_acknowledged_is_accepted_at_the_store_and_not_pulled_again) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command, .map = pull_state::cached_fallback});
  world.load(short_mission());
  ASSERT_TRUE(world.run_until([&] { return world.pulls() == 1; }, 40)) << "until then it is";
  EXPECT_EQ(world.durable().preflight.now, preflight::phase::awaiting_ack) << "the copy is there all the while\n"
                                                                           << world.story();
  EXPECT_EQ(world.accepted_copies(), 0);
  world.pull_map(pull_state::cached_fallback);
  ASSERT_TRUE(world.acknowledge()) << world.story();
  world.run_for(200);
  EXPECT_EQ(world.accepted_copies(), 1) << world.story();
  EXPECT_EQ(world.pulls(), 1);
  EXPECT_TRUE(world.say(command_kind::pull).is_taken) << "but by a person";
  world.run_for(1);
  EXPECT_EQ(world.pulls(), 2);
}

// -- a mission that is refused ----------------------------------------------------------------------------

TEST_P(service_again, a_mission_that_was_refused_is_asked_for_again_after_a_minute) {
  flight_world world({.who = GetParam()});
  world.run_for(1);
  const auto begins = world.begins();
  world.refuse_mission(refusal::unreachable);
  world.run_for(55);
  EXPECT_EQ(world.begins(), begins);
  world.run_for(10);
  EXPECT_EQ(world.begins(), begins + 1);
  world.run_for(100);
  EXPECT_EQ(world.begins(), begins + 1) << "it has not answered";
  world.refuse_mission(refusal::not_found);
  world.run_for(1);
  EXPECT_TRUE(world.say(command_kind::pull).is_taken);
  world.run_for(1);
  EXPECT_EQ(world.begins(), begins + 2) << "at once, by an operator";
  world.load(short_mission());
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.begins(), begins + 2);
}

TEST_P(service_again, a_mission_that_was_deleted_is_not_asked_for_again) {
  flight_world world({.who = GetParam()});
  const auto begins = world.begins();
  world.refuse_mission(refusal::deleted);
  world.run_for(200);
  EXPECT_EQ(world.begins(), begins);
}

// -- a mission that is deleted ----------------------------------------------------------------------------

TEST_P(service_again, a_mission_deleted_on_the_ground_is_not_flown_also_after_a_restart) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  world.load(short_mission());
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.delete_mission(short_mission().mission_id);
  world.crash();
  world.run_for(5);
  (void)world.say(command_kind::start);
  world.run_for(30);
  EXPECT_FALSE(world.durable().status.in_flight) << world.story();
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
  EXPECT_TRUE(has_said(world, "it is not flown any more"));
}

TEST_P(service_again, an_earlier_mission_that_is_deleted_changes_nothing_of_this_one) {
  flight_world world({.who = GetParam()});
  world.load(short_mission());
  ASSERT_TRUE(world.run_until_phase(phase::flying)) << world.story();
  world.delete_mission("00000000-2222-4333-8444-555555555555");
  EXPECT_EQ(world.durable().deleted_mission, "");
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_TRUE(has_said(world, "what was seen for it is kept on board"));
}

TEST_P(service_again, deleted_in_flight_it_is_flown_to_its_end_and_said_again_when_it_is_down) {
  flight_world world({.who = GetParam()});
  world.load(short_mission());
  ASSERT_TRUE(world.run_until_phase(phase::flying)) << world.story();
  world.delete_mission(short_mission().mission_id);
  world.run_for(2);
  EXPECT_TRUE(has_said(world, "what goes on goes on"));
  EXPECT_FALSE(has_said(world, "the flight has ended"));
  world.crash();
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_TRUE(has_said(world, "the flight has ended, and the service has deleted its mission"));
}

TEST_P(service_again, deleted_in_flight_it_comes_home_by_policy_unless_a_person_has_it) {
  for (const bool has_person : {false, true}) {
    flight_world world({.who = GetParam(), .deleted_mission = deletion_policy::come_home});
    world.load(short_mission());
    ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
    if (has_person) {
      world.switch_mode(tests::hold_mode(GetParam()));
      ASSERT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
    }
    const auto commands = world.commands().size();
    world.delete_mission(short_mission().mission_id);
    if (has_person) {
      world.run_for(30);
      EXPECT_EQ(world.commands().size(), commands) << world.story();
    } else {
      EXPECT_TRUE(world.run_until_phase(phase::aborted)) << world.story();
      EXPECT_TRUE(has_said(world, "the vehicle is called home"));
    }
  }
}

class service_after_a_landing : public service_again {
protected:
  // Until it stands at the landing on the way.
  static bool lands_on_the_way(flight_world& world) {
    world.load(tests::with_landing_on_the_way());
    return world.run_until(
        [&] {
          return std::ranges::any_of(world.reports(), [](const auto& each) {
            return each.kind == mission::progress_kind::reached && each.item_id == "drop";
          });
        },
        600);
  }
};

TEST_P(service_after_a_landing, deleted_at_a_landing_on_the_way_it_is_flown_to_its_end_also_after_a_crash) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(lands_on_the_way(world)) << world.story();
  world.delete_mission(tests::with_landing_on_the_way().mission_id);
  EXPECT_TRUE(has_said(world, "it was begun, and is flown to its end")) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::ready, 60)) << world.story();
  world.crash();
  world.run_for(10);
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::ready, 60)) << world.story();
  EXPECT_FALSE(world.vehicle().describe().armed) << "a person starts it\n" << world.story();
  ASSERT_TRUE(world.say(command_kind::start).is_taken) << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

TEST_P(service_after_a_landing, deleted_in_flight_the_landing_on_the_way_is_not_its_end) {
  flight_world world({.who = GetParam(), .takeoff_again = start_policy::automatic});
  world.load(tests::with_landing_on_the_way());
  ASSERT_TRUE(world.run_until_phase(phase::flying)) << world.story();
  world.delete_mission(tests::with_landing_on_the_way().mission_id);
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

TEST_P(service_after_a_landing, deleted_at_a_landing_on_the_way_it_is_not_flown_on_where_it_is_set_to_return) {
  flight_world world(
      {.who = GetParam(), .takeoff_again = start_policy::automatic, .deleted_mission = deletion_policy::come_home});
  ASSERT_TRUE(lands_on_the_way(world)) << world.story();
  world.delete_mission(tests::with_landing_on_the_way().mission_id);
  EXPECT_TRUE(has_said(world, "it is not flown any more")) << world.story();
  world.run_for(60);
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
  EXPECT_FALSE(world.durable().status.in_flight) << world.story();
}

INSTANTIATE_TEST_SUITE_P(each, service_after_a_landing,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot));

// -- what is owed -----------------------------------------------------------------------------------------

TEST_P(service_again, what_was_seen_in_a_flight_that_was_broken_off_is_asked_for_also_when_godwit_dies_right_after_it) {
  flight_world world({.who = GetParam()});
  world.load(short_mission());
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
  EXPECT_TRUE(world.say(command_kind::come_home).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::aborted)) << world.story();
  const auto pushes = world.pushes();
  world.crash();
  EXPECT_EQ(world.pushes(), pushes + 1) << world.story();
}

INSTANTIATE_TEST_SUITE_P(each, service_again,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::rover));

} // namespace service_view_test
} // namespace godwit::executor
