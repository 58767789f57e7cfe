// Which missions people are told of: what is flown, what waits and why, what was refused and why, and what was flown.
#include "actors/executor/flight/mission_list.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/actors/executor/station_plans.hpp"

namespace godwit::executor {
namespace mission_list_test {

using sim::personality;

std::optional<known_mission> the_one(const flight_world& world, mission_place place) {
  const auto all = world.missions().list;
  const auto found = std::ranges::find(all, place, &known_mission::place);
  return found == all.end() ? std::nullopt : std::optional(*found);
}

class mission_list : public testing::TestWithParam<personality> {
protected:
  static mission::document other_mission() {
    auto result = tests::short_mission(GetParam());
    result.mission_id = "0d2f8a4e-1b1c-4d7e-9d5b-6a1f0c9e2b33";
    return result;
  }
};

TEST_P(mission_list, the_mission_of_the_service_is_prepared_flown_and_has_ended_with_its_outcome) {
  const auto mission = tests::short_mission(GetParam());
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  EXPECT_TRUE(world.missions().list.empty());
  world.load(mission);
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  const auto prepared = the_one(world, mission_place::prepared);
  ASSERT_TRUE(prepared);
  EXPECT_EQ(prepared->mission_id, mission.mission_id);
  EXPECT_EQ(prepared->revision, mission.revision);
  EXPECT_EQ(prepared->origin, mission_origin::service);
  EXPECT_EQ(prepared->items, mission.items.size());
  EXPECT_EQ(prepared->items_done, 0U);
  EXPECT_EQ(prepared->reason, "") << "it waits for nothing but a word";
  ASSERT_TRUE(world.say(operators::command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::flying)) << world.story();
  EXPECT_TRUE(the_one(world, mission_place::in_flight));
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  const auto ended = the_one(world, mission_place::ended);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->outcome, "complete");
  EXPECT_EQ(ended->items_done, mission.items.size());
  EXPECT_FALSE(ended->last_report_at.empty());
  EXPECT_EQ(world.missions().list.size(), 1U);
}

TEST_P(mission_list, one_that_can_not_be_started_yet_says_why) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command, .battery_percent = 10});
  world.load(tests::short_mission(GetParam()));
  world.run_for(20);
  const auto prepared = the_one(world, mission_place::prepared);
  ASSERT_TRUE(prepared);
  EXPECT_NE(prepared->reason.find("preflight"), std::string::npos) << prepared->reason;
}

TEST_P(mission_list, another_mission_that_comes_in_flight_waits_and_then_takes_its_place) {
  const auto first = tests::short_mission(GetParam());
  flight_world world({.who = GetParam()});
  world.load(first);
  ASSERT_TRUE(world.run_until_phase(phase::flying)) << world.story();
  world.load(other_mission());
  const auto waits = the_one(world, mission_place::waiting);
  ASSERT_TRUE(waits);
  EXPECT_EQ(waits->mission_id, other_mission().mission_id);
  EXPECT_EQ(waits->reason, "another mission is flown");
  ASSERT_TRUE(world.run_until([&] { return world.durable().mission->mission_id != first.mission_id; }, 900))
      << world.story();
  EXPECT_FALSE(the_one(world, mission_place::waiting));
  const auto before = the_one(world, mission_place::ended);
  ASSERT_TRUE(before);
  EXPECT_EQ(before->mission_id, first.mission_id);
  EXPECT_EQ(before->outcome, "complete");
  EXPECT_FALSE(before->items) << "they are not kept";
}

TEST_P(mission_list, an_assignment_that_can_not_be_carried_out_is_refused_with_the_reason) {
  const auto mission = tests::short_mission(GetParam());
  flight_world world({.who = GetParam()});
  world.load(mission);
  ASSERT_TRUE(world.run_until_phase(phase::flying)) << world.story();
  mission::assignment assignment;
  assignment.assignment_id = "22222222-2222-4333-8444-555555555555";
  assignment.base_revision = 7;
  assignment.revision = 8;
  assignment.items = mission.items;
  world.assign(assignment);
  world.run_for(2);
  const auto refused = the_one(world, mission_place::refused);
  ASSERT_TRUE(refused) << world.story();
  EXPECT_EQ(refused->mission_id, mission.mission_id);
  EXPECT_EQ(refused->revision, 8);
  EXPECT_EQ(refused->reason, world.answers().front().response.reason) << "as the service is told it";
  EXPECT_EQ(the_one(world, mission_place::in_flight)->revision, mission.revision);
}

TEST_P(mission_list, a_mission_that_the_service_does_not_give_is_refused_with_the_reason_until_it_does) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  world.refuse_mission(mission_client::refusal::unreachable);
  const auto refused = the_one(world, mission_place::refused);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->mission_id, tests::short_mission(GetParam()).mission_id);
  EXPECT_EQ(refused->origin, mission_origin::service);
  EXPECT_FALSE(refused->reason.empty());
  world.load(tests::short_mission(GetParam()));
  EXPECT_FALSE(the_one(world, mission_place::refused));
}

TEST_P(mission_list, the_plan_of_a_station_is_named_as_such_and_one_that_was_not_taken_says_why) {
  flight_world world(by_stations(GetParam()));
  auto items = station_items(GetParam());
  auto guarded = item_of(mav_cmd::do_parachute, mission::position{});
  guarded.frame = number(mav_frame::mission);
  items.push_back(guarded);
  world.station_says(taken(numbered(items)));
  const auto refused = the_one(world, mission_place::refused);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->origin, mission_origin::station);
  EXPECT_NE(refused->reason.find("DO_PARACHUTE"), std::string::npos) << refused->reason;
  ASSERT_TRUE(bring(world, station_items(GetParam())));
  EXPECT_FALSE(the_one(world, mission_place::refused));
  EXPECT_EQ(the_one(world, mission_place::prepared)->origin, mission_origin::station);
}

TEST_P(mission_list, a_mission_that_was_called_home_is_aborted) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::flying)) << world.story();
  world.run_for(5); // a rover that stands at home has returned before anybody sees it
  ASSERT_TRUE(world.say(operators::command_kind::come_home).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::aborted, 900)) << world.story();
  EXPECT_EQ(the_one(world, mission_place::ended)->outcome, "aborted");
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, mission_list,
                         testing::Values(personality::rover, personality::px4, personality::ardupilot),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

// -- those that were flown before -------------------------------------------------------------------------

TEST(earlier_missions, the_newest_are_told_first_and_no_more_than_the_bound) {
  state s;
  for (int i = 0; i < 10; ++i) {
    progress::mission_record each;
    each.mission_id = "m" + std::to_string(i);
    if (i % 2 == 0)
      each.completed_revision = each.revision;
    s.progress.past_missions.push_back(each);
  }
  const flight_context flight({}, s);
  const auto all = list_missions(flight, {}).list;
  ASSERT_EQ(all.size(), max_earlier_missions);
  EXPECT_EQ(all[0].mission_id, "m9");
  EXPECT_EQ(all[0].place, mission_place::left) << "neither its end nor that it was called off was told";
  EXPECT_EQ(all[1].mission_id, "m8");
  EXPECT_EQ(all[1].place, mission_place::ended);
  EXPECT_EQ(all[1].origin, mission_origin::unknown);
}

TEST(refused_missions, one_that_is_there_by_now_is_not_told_as_refused) {
  state s;
  s.mission.emplace();
  s.mission->mission_id = "m";
  s.mission->revision = 3;
  flight_context flight({}, s);
  flight.refused = refused_mission(flight, "m", 4, "it crosses a fence");
  EXPECT_EQ(list_missions(flight, {}).list.size(), 2U);
  s.mission->revision = 4;
  EXPECT_EQ(list_missions(flight, {}).list.size(), 1U);
}

} // namespace mission_list_test
} // namespace godwit::executor
