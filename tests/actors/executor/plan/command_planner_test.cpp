#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "actors/executor/plan/item_planner.hpp"
#include "actors/executor/plan/vehicle_items.hpp"
#include "tests/actors/executor/plan/missions.hpp"

namespace godwit::executor::plan {
namespace command_planner_test {

using commands = std::vector<int>;
using mission::command_item;
using mission::vehicle_profile;
using progress::item_role;

const mission::takeoff up{"up", 30};
const mission::takeoff up_again{"up2", 30};
const mission::return_home home_again{"back", mission::return_goal::home};

command_item act(const char* id, std::uint16_t number, double first = 1, double second = 0, double third = 0) {
  return {id, number, 2, {first, second, third, 0, 0, 0, 0}, true};
}

command_item move(const char* id, std::uint16_t number, const mission::position& to, std::uint8_t frame = 3) {
  return {id, number, frame, {0, 0, 0, 0, to.latitude, to.longitude, to.altitude_m}, true};
}

plan_setting flown_by(plan_setting setting, vehicle_profile profile) {
  setting.profile = profile;
  return setting;
}

const plan_setting copter = flown_by(ardupilot_copter, vehicle_profile::arducopter);
const plan_setting px4 = flown_by(px4_copter, vehicle_profile::px4_multicopter);
const plan_setting plane = flown_by(ardupilot_plane, vehicle_profile::arduplane);

std::vector<item_role> roles_of(const flight_plan& plan) {
  std::vector<item_role> roles;
  for (const auto& each : plan.map.items)
    roles.push_back(each.role);
  return roles;
}

TEST(command_planner, a_command_goes_to_the_vehicle_as_it_came) {
  const command_item spline{"s", 82, 0, {3, 0, 0, 0, 47.3985, 8.5465, 520}, false};
  const auto plans = build_plans(mission_of({up, act("t", 206, 25.5, 0, 1), spline, home_again}), copter);
  ASSERT_TRUE(plans.has_value()) << plans.error().message();
  const auto& items = plans->front().items;
  ASSERT_EQ(commands_of(plans->front()), (commands{22, 206, 82, 20}));
  EXPECT_EQ(items[2].frame, 2);
  EXPECT_FLOAT_EQ(items[2].param1, 25.5F);
  EXPECT_FLOAT_EQ(items[2].param3, 1);
  EXPECT_EQ(items[3].frame, 0);
  EXPECT_EQ(items[3].x, 473'985'000);
  EXPECT_EQ(items[3].y, 85'465'000);
  EXPECT_FLOAT_EQ(items[3].z, 520);
  EXPECT_EQ(items[3].autocontinue, 0);
  EXPECT_EQ(roles_of(plans->front()),
            (std::vector{item_role::flown, item_role::acts, item_role::flown, item_role::flown}));
}

TEST(command_planner, what_is_not_given_is_what_each_autopilot_takes_for_that) {
  command_item there = move("w", 16, at(500, 0, 30));
  there.params[3].reset();
  command_item look{"roi", 195, 3, {}, true};
  const auto mission = mission_of({up, look, there, home_again});
  const auto px4_items = build_plans(mission, px4)->front().items;
  EXPECT_TRUE(std::isnan(px4_items[2].param4));
  EXPECT_EQ(px4_items[1].x, std::numeric_limits<std::int32_t>::max());
  const auto copter_items = build_plans(mission, copter)->front().items;
  EXPECT_EQ(copter_items[3].param4, 0);
  EXPECT_EQ(copter_items[2].x, 0);
  EXPECT_EQ(copter_items[2].z, 0);
}

TEST(command_planner, heights_above_the_sea_are_judged_by_the_height_of_home) {
  const auto plan = build_plans(mission_of({up, move("w", 16, at(500, 0, 481), 0), home_again}), copter)->front();
  EXPECT_NEAR(plan.legs[1].to.altitude_m, 50, 1e-9) << "home is 431 m above the sea";
}

TEST(command_planner, what_no_mission_may_hold_is_refused_by_its_name_and_the_setting) {
  const auto mission = mission_of({up, act("p", 208, 2), waypoint("w", at(500, 0, 30)), home_again});
  EXPECT_EQ(
      why_not(mission, copter),
      "Item 'p': DO_PARACHUTE is not flown: what it does can not be judged before the flight, or takes protection "
      "away; flight.allowed_commands allows it where it names 208; leave it out.");
  auto allowing = copter;
  allowing.allowed_commands = {208};
  EXPECT_EQ(commands_of(mission, allowing), (commands{22, 208, 16, 20}));
  allowing.allowed_commands = {400};
  EXPECT_NE(why_not(mission_of({up, act("a", 400), waypoint("w", at(500, 0, 30))}), allowing), "");
}

TEST(command_planner, what_the_vehicle_refuses_is_refused_before_it_is_brought) {
  const auto mission = mission_of({up, move("s", 82, at(500, 0, 30)), home_again});
  EXPECT_EQ(why_not(mission, px4), "Item 's': A vehicle of the kind px4-multicopter refuses a mission with "
                                   "NAV_SPLINE_WAYPOINT; leave it out.");
}

TEST(command_planner, what_the_vehicle_passes_over_is_kept_unflown_and_told) {
  const auto drives =
      flown_by(setting_of(vehicle_class::rover, mav_autopilot::ardupilotmega), vehicle_profile::ardurover);
  const auto plan =
      build_plans(mission_of({waypoint("w", at(50, 0, 0)), move("s", 82, at(90, 0, 0)), home_again}), drives)->front();
  EXPECT_EQ(commands_of(plan), (commands{16, 82, 20}));
  EXPECT_EQ(roles_of(plan), (std::vector{item_role::flown, item_role::unflown, item_role::flown}));
  ASSERT_EQ(plan.notes.size(), 1U);
  EXPECT_EQ(plan.notes[0],
            "Item 's' (NAV_SPLINE_WAYPOINT) is passed over by this kind of vehicle: its place is not visited.");
  for (const auto& each : plan.legs)
    EXPECT_NE(each.item_index, 1U) << "nobody goes there";
}

TEST(command_planner, a_jump_leads_to_the_sequence_of_its_item_and_its_way_is_judged) {
  const auto mission = mission_of(
      {up, waypoint("a", at(500, 0, 30)), waypoint("b", at(500, 500, 30)), mission::jump{"j", "a", 2}, home_again});
  const auto on_ardupilot = build_plans(mission, copter)->front();
  ASSERT_EQ(commands_of(on_ardupilot), (commands{22, 16, 16, 177, 20}));
  EXPECT_FLOAT_EQ(on_ardupilot.items[4].param1, 2);
  EXPECT_FLOAT_EQ(on_ardupilot.items[4].param2, 2);
  const auto on_px4 = build_plans(mission, px4)->front();
  EXPECT_FLOAT_EQ(on_px4.items[3].param1, 1) << "a PX4 keeps no home as an item";
  const auto back = std::ranges::find(on_px4.legs, 3U, &leg::item_index);
  ASSERT_NE(back, on_px4.legs.end());
  EXPECT_EQ(back->from, at(500, 500, 30));
  EXPECT_EQ(back->to, at(500, 0, 30));
  EXPECT_EQ(back->times, 2) << "for the energy that it takes";
  const auto there = std::ranges::find(on_px4.legs, 2U, &leg::item_index);
  EXPECT_EQ(there->times, 3);
  EXPECT_EQ(on_px4.legs.back().times, 1);
  EXPECT_EQ(roles_of(on_px4)[3], item_role::acts);
}

TEST(command_planner, a_jump_is_led_anew_in_the_rest_of_a_mission) {
  const auto mission = mission_of({up, waypoint("a", at(500, 0, 30)), waypoint("b", at(500, 500, 30)),
                                   waypoint("c", at(0, 500, 30)), mission::jump{"j", "b", 2}, home_again});
  const auto rest = build_plans(mission, px4, {2, 0});
  ASSERT_TRUE(rest.has_value()) << rest.error().message();
  ASSERT_EQ(commands_of(rest->front()), (commands{22, 16, 16, 177, 20}));
  EXPECT_FLOAT_EQ(rest->front().items[3].param1, 0) << "with the take-off that the rest needs in front of it";
}

// up, a, b, c, twice back to a, home.
mission::document looping() {
  return mission_of({up, waypoint("a", at(500, 0, 30)), waypoint("b", at(500, 500, 30)), waypoint("c", at(0, 500, 30)),
                     mission::jump{"j", "a", 2}, home_again});
}

plan_from after_rounds(std::size_t index, std::uint32_t taken, bool is_certain = true) {
  return {index, 0, {{.item_id = "j", .taken = taken, .is_certain = is_certain}}};
}

plan_setting in_the_air(plan_setting setting) {
  setting.is_under_way = true;
  setting.start = at(500, 400, 30);
  return setting;
}

TEST(command_planner, a_rest_within_a_loop_begins_at_its_item_and_has_the_rounds_that_are_left) {
  const auto rest = build_plans(looping(), in_the_air(px4), after_rounds(2, 1));
  ASSERT_TRUE(rest.has_value()) << rest.error().message();
  const auto& plan = rest->front();
  ASSERT_EQ(commands_of(plan), (commands{16, 16, 16, 177, 20}));
  EXPECT_EQ(plan.map.start_sequence, 1) << "a PX4 that begins with a jump never goes on";
  EXPECT_EQ(plan.items[1].current, 1);
  EXPECT_FALSE(plan.map.enters_at.has_value());
  EXPECT_EQ(plan.map.items_before, 1U);
  EXPECT_FLOAT_EQ(plan.items[3].param1, 0);
  EXPECT_FLOAT_EQ(plan.items[3].param2, 1);
  ASSERT_EQ(plan.map.loops.size(), 1U);
  EXPECT_FALSE(plan.map.loops[0].counts_anew);
  EXPECT_NEAR(static_cast<double>(plan.map.loops[0].round_ns) / 1e9, (500 + 500 + 500 * std::sqrt(2)) / 30, 0.5);
}

TEST(command_planner, a_rest_within_a_loop_is_led_in_by_what_was_set_and_a_jump) {
  auto mission = looping();
  mission.items.insert(mission.items.begin() + 1, act("slow", 178, 1, 4, -1));
  const auto rest = build_plans(mission, in_the_air(copter), after_rounds(3, 0));
  ASSERT_TRUE(rest.has_value()) << rest.error().message();
  const auto& plan = rest->front();
  ASSERT_EQ(commands_of(plan), (commands{178, 177, 16, 16, 16, 177, 20}));
  EXPECT_EQ(plan.map.start_sequence, 1);
  EXPECT_EQ(plan.map.enters_at, 4);
  EXPECT_FLOAT_EQ(plan.items[2].param1, 4) << "to b";
  EXPECT_FLOAT_EQ(plan.items[2].param2, 1);
  EXPECT_FLOAT_EQ(plan.items[6].param1, 3) << "back to a";
  EXPECT_FLOAT_EQ(plan.items[6].param2, 2);
  EXPECT_TRUE(plan.map.loops[0].counts_anew);
  EXPECT_EQ(plan.legs.front().from, at(500, 400, 30));
  EXPECT_EQ(plan.legs.front().to, at(500, 500, 30));
  EXPECT_EQ(plan.legs.front().times, 1);
  const auto from_a = std::ranges::find_if(
      plan.legs, [](const leg& each) { return each.from == at(500, 0, 30) && each.to == at(500, 500, 30); });
  ASSERT_NE(from_a, plan.legs.end());
  const auto to_a = std::ranges::find_if(plan.legs, [](const leg& each) { return each.to == at(500, 0, 30); });
  ASSERT_NE(to_a, plan.legs.end());
  EXPECT_EQ(to_a->from, at(0, 500, 30)) << "nobody flies there from where the rest begins";
}

TEST(command_planner, a_rest_within_a_loop_takes_off_before_the_loop_and_once) {
  const auto rest = build_plans(looping(), px4, after_rounds(2, 0));
  ASSERT_TRUE(rest.has_value()) << rest.error().message();
  EXPECT_EQ(commands_of(rest->front()), (commands{22, 177, 16, 16, 16, 177, 20}));
  EXPECT_EQ(rest->front().map.enters_at, 3);
  EXPECT_EQ(rest->front().map.items.front().first_sequence, 2) << "the take-off belongs to none of them";
}

TEST(command_planner, what_is_waited_at_places_counts_in_each_round_as_this_vehicle_waits) {
  auto mission = looping();
  std::get<mission::waypoint>(mission.items[1]).hold_s = 5;
  mission.items.insert(mission.items.begin() + 2, act("delay", 93, 7));
  mission.items.insert(mission.items.begin() + 3, act("condition", 112, 11));
  mission.items.insert(mission.items.end() - 1, act("last", 93, 2));
  EXPECT_EQ(build_plans(mission, px4)->front().waits_s, 3 * (5 + 7 + 11) + 2);
  EXPECT_EQ(build_plans(mission, copter)->front().waits_s, 3 * (5 + 7) + 2);
  auto rest = after_rounds(4, 1); // at b: a and the waits after it once more
  EXPECT_EQ(build_plans(mission, in_the_air(px4), rest)->front().waits_s, (5 + 7 + 11) + 2);
  mission.items[2] = act("delay", 93, -1);
  EXPECT_EQ(build_plans(mission, px4)->front().waits_s, 3 * (5 + 11) + 2) << "until a time of day";
}

TEST(command_planner, all_rounds_taken_leave_a_jump_that_is_passed) {
  const auto rest = build_plans(looping(), in_the_air(px4), after_rounds(2, 2));
  ASSERT_TRUE(rest.has_value()) << rest.error().message();
  EXPECT_FLOAT_EQ(rest->front().items[3].param2, 0);
  EXPECT_TRUE(rest->front().map.loops.empty() || rest->front().items[3].param2 == 0);
  auto endless = looping();
  std::get<mission::jump>(endless.items[4]).times = -1;
  const auto for_ever = build_plans(endless, in_the_air(px4), after_rounds(2, 7, false));
  ASSERT_TRUE(for_ever.has_value()) << for_ever.error().message();
  EXPECT_FLOAT_EQ(for_ever->front().items[3].param2, -1);
}

TEST(command_planner, a_rest_whose_rounds_are_not_known_is_refused_with_the_item_to_start_again_from) {
  const std::string why =
      "Item 'j': It leads to item 'a', and how many rounds are left is not known; start the mission "
      "again from item 'a', or take the jump out.";
  EXPECT_EQ(why_not(looping(), in_the_air(px4), after_rounds(2, 1, false)), why);
  EXPECT_EQ(why_not(looping(), in_the_air(px4), after_rounds(1, 1, false)), why) << "also at the beginning of the loop";
  EXPECT_EQ(why_not(looping(), in_the_air(px4), after_rounds(5, 1, false)), "") << "after it nobody asks";
  auto inner = looping();
  inner.items.insert(inner.items.begin() + 5, mission::jump{"outer", "a", 1});
  EXPECT_EQ(why_not(inner, in_the_air(copter), after_rounds(2, 1)), why)
      << "an ArduPilot flies the inner loop with the count of the plan in each outer round";
  EXPECT_EQ(why_not(inner, in_the_air(px4), after_rounds(2, 1)), "");
  auto on = looping();
  on.items.insert(on.items.begin() + 2, mission::jump{"on", "c", 1});
  EXPECT_NE(why_not(on, in_the_air(px4), after_rounds(3, 1)), "") << "whether it was taken is not counted";
}

TEST(command_planner, a_jump_back_over_a_landing_is_refused) {
  const auto mission = mission_of({up, waypoint("a", at(500, 0, 30)), mission::land{"down", at(400, 0, 0)}, up_again,
                                   waypoint("b", at(500, 500, 30)), mission::jump{"j", "a", 2}, home_again});
  const std::string why =
      "Item 'j': It leads back to item 'a', over a landing; take the jump out, or put it before the "
      "landing.";
  EXPECT_EQ(why_not(mission, px4, {}), why);
  EXPECT_EQ(why_not(mission, px4, {4}), why);
}

TEST(command_planner, what_came_behind_a_landing_without_a_take_off_is_kept_and_not_flown) {
  const auto mission =
      mission_of({up, waypoint("w", at(600, 0, 60)), act("s1", 189), move("down", 21, at(0, 0, 0)), act("s2", 189),
                  move("other", 16, at(0, 600, 60)), move("down2", 21, at(0, 100, 0))});
  const auto plans = build_plans(mission, plane);
  ASSERT_TRUE(plans.has_value()) << plans.error().message();
  ASSERT_EQ(plans->size(), 1U);
  const auto& plan = plans->front();
  EXPECT_EQ(commands_of(plan), (commands{22, 16, 189, 21, 189, 16, 21}));
  EXPECT_EQ(progress::items_to_finish(plan.map), 4U) << "up to the landing";
  for (std::size_t i = 4; i < 7; ++i)
    EXPECT_EQ(plan.map.items[i].role, item_role::unflown) << i;
  EXPECT_EQ(plan.landing_sequence, 3);
  EXPECT_TRUE(plan.ends_on_ground);
  EXPECT_EQ(plan.ends_at, at(0, 0, 0));
  EXPECT_TRUE(plan.map.ends_mission);
  EXPECT_EQ(why_not(mission, px4),
            "Item 'other': The vehicle stands on the ground there; put a takeoff in front of it.")
      << "nobody has seen what a PX4 does there";
}

TEST(command_planner, behind_a_landing_a_take_off_begins_the_next_plan) {
  const auto mission = mission_of(
      {up, move("drop", 21, at(500, 0, 0)), act("open", 211, 1, 0), move("up2", 22, at(500, 0, 40)), home_again});
  const auto plans = build_plans(mission, copter);
  ASSERT_TRUE(plans.has_value()) << plans.error().message();
  ASSERT_EQ(plans->size(), 2U);
  EXPECT_EQ(commands_of(plans->at(0)), (commands{22, 21}));
  EXPECT_EQ(commands_of(plans->at(1)), (commands{211, 22, 20}));
}

TEST(command_planner, ardupilot_executes_the_first_command_behind_the_last_movement_alone) {
  const auto mission = mission_of({up, waypoint("w", at(500, 0, 30)), act("c1", 2001), act("c2", 183, 9, 1500)});
  EXPECT_EQ(roles_of(build_plans(mission, copter)->front()),
            (std::vector{item_role::flown, item_role::flown, item_role::acts, item_role::unflown}));
  EXPECT_EQ(
      roles_of(
          build_plans(mission_of({up, waypoint("w", at(500, 0, 30)), act("c1", 2001), act("c2", 2501)}), px4)->front()),
      (std::vector{item_role::flown, item_role::flown, item_role::acts, item_role::acts}));
}

mission::document line_with_pictures() {
  return mission_of({up, act("s", 178, 0, 7, -1), act("g", 205, -90), waypoint("entry", at(100, 0, 30)),
                     act("on", 206, 25, 0, 1), waypoint("exit", at(900, 0, 30)), act("off", 206, 0, 0, 1),
                     waypoint("next", at(900, 100, 30)), act("servo", 183, 9, 1500), waypoint("last", at(0, 100, 30)),
                     home_again});
}

TEST(command_planner, the_pictures_of_a_line_are_planned_with_those_that_are_asked_for_at_its_ends) {
  for (const bool at_beginning : {true, false})
    for (const bool at_end : {true, false}) {
      auto mission = line_with_pictures();
      std::get<mission::command_item>(mission.items[4]).params[2] = at_beginning ? 1 : 0;
      std::get<mission::command_item>(mission.items[6]).params[2] = at_end ? 1 : 0;
      const auto plans = build_plans(mission, copter);
      ASSERT_TRUE(plans.has_value()) << plans.error().message();
      const auto& map = plans->front().map;
      EXPECT_EQ(map.items[5].pictures, 31U + (at_beginning ? 1 : 0) + (at_end ? 1 : 0)) << "a hair less than 800 m";
      EXPECT_EQ(map.items[5].ends_with_picture, at_end);
      EXPECT_EQ(map.items[7].pictures, 0U);
    }
}

TEST(command_planner, a_rest_sets_again_what_the_vehicle_has_lost_and_flies_a_line_from_its_beginning) {
  const auto rest = build_plans(line_with_pictures(), copter, {5, 0});
  ASSERT_TRUE(rest.has_value()) << rest.error().message();
  const auto& plan = rest->front();
  ASSERT_EQ(commands_of(plan), (commands{22, 178, 205, 16, 206, 16, 206, 16, 183, 16, 20}));
  EXPECT_NEAR(plan.items[4].y / 1e7, at(100, 0, 30).longitude, 1e-6) << "the entry of the line";
  EXPECT_FLOAT_EQ(plan.items[5].param1, 25);
  EXPECT_EQ(plan.map.items.front().item_id, "exit");
  EXPECT_EQ(plan.map.items.front().sequence_count, 6) << "take-off, speed, gimbal, entry, trigger, exit";
  EXPECT_EQ(plan.notes.size(), 3U);
}

TEST(command_planner, an_act_is_awaited_as_long_as_the_conditions_before_it_may_hold_it_back) {
  const auto late_s = [](std::vector<command_item> conditions) {
    std::vector<mission::item> items{up, waypoint("w", at(500, 0, 30))};
    items.insert(items.end(), conditions.begin(), conditions.end());
    items.insert(items.end(), {act("drop", 211, 1), waypoint("x", at(500, 500, 30)), act("grab", 211, 1, 1),
                               waypoint("y", at(0, 500, 30)), home_again});
    const auto plans = build_plans(mission_of(std::move(items)), copter);
    std::vector<std::uint32_t> result;
    for (const auto& each : plans->front().map.items)
      if (each.act != progress::act_kind::none)
        result.push_back(each.act_late_s);
    return result;
  };
  EXPECT_EQ(late_s({}), (std::vector<std::uint32_t>{0, 0}));
  EXPECT_EQ(late_s({act("a", 112, 4.5), act("b", 112, 3)}), (std::vector<std::uint32_t>{8, 0}));
  EXPECT_EQ(late_s({act("a", 114, 20)}), (std::vector<std::uint32_t>{86'400, 0}));
  EXPECT_EQ(late_s({act("a", 115, 90)}), (std::vector<std::uint32_t>{86'400, 0}));
}

plan_from from_picture(double east_m, std::uint32_t taken) {
  const auto place = at(east_m, 3, 30);
  plan_from from{5, 0};
  from.line = progress::begun_line{"exit", {place.latitude, place.longitude}, {.taken = taken, .first = 4, .last = 9}};
  return from;
}

TEST(command_planner, the_rest_of_a_line_begins_where_its_last_picture_was_taken) {
  for (const auto& setting : {copter, px4}) {
    auto mission = line_with_pictures();
    mission.items.erase(mission.items.begin() + 8); // the servo, which a PX4 refuses
    const auto rest = build_plans(mission, setting, from_picture(600, 21));
    ASSERT_TRUE(rest.has_value()) << rest.error().message();
    const auto& plan = rest->front();
    const auto& items = plan.items;
    const auto lead = plan.map.first_sequence + 3U;
    ASSERT_EQ(items[lead].command, 16);
    EXPECT_NEAR(items[lead].y / 1e7, at(600, 0, 30).longitude, 1e-6) << "on the line";
    EXPECT_NEAR(items[lead].x / 1e7, at(600, 0, 30).latitude, 1e-6);
    EXPECT_FLOAT_EQ(items[lead].param2, 2) << "not 10 m before it";
    EXPECT_EQ(items[lead + 1].command, 206);
    EXPECT_TRUE(plan.map.items.front().continues_line);
    EXPECT_EQ(plan.map.items.front().pictures, 21U + 1 + 11 + 1) << "taken before, at the beginning, on it, at its end";
  }
}

TEST(command_planner, a_fixed_wing_comes_straight_to_the_rest_of_a_line) {
  auto flying = plane;
  flying.is_under_way = true;
  flying.start = at(500, 300, 30);
  const auto plan = build_plans(line_with_pictures(), flying, from_picture(600, 21))->front();
  ASSERT_EQ((commands{plan.items[3].command, plan.items[4].command, plan.items[5].command}), (commands{16, 16, 206}));
  EXPECT_NEAR(plan.items[3].y / 1e7, at(500, 0, 30).longitude, 1e-6);
  EXPECT_NEAR(plan.items[4].y / 1e7, at(600, 0, 30).longitude, 1e-6);
}

TEST(command_planner, the_line_of_another_item_or_beside_this_one_is_flown_from_its_beginning) {
  auto other = from_picture(600, 21);
  other.line->item_id = "next";
  auto beside = from_picture(600, 21);
  beside.line->at.latitude = at(600, 30, 30).latitude;
  for (const auto& from : {other, beside}) {
    const auto plan = build_plans(line_with_pictures(), copter, from)->front();
    EXPECT_NEAR(plan.items[4].y / 1e7, at(100, 0, 30).longitude, 1e-6);
    EXPECT_FALSE(plan.map.items.front().continues_line);
    EXPECT_EQ(plan.map.items.front().pictures, 33U);
  }
}

TEST(command_planner, a_trigger_that_is_off_stays_off_and_outputs_are_never_repeated_unasked) {
  EXPECT_EQ(commands_of(line_with_pictures(), copter, {7, 0}), (commands{22, 178, 205, 16, 183, 16, 20}));
  EXPECT_EQ(commands_of(line_with_pictures(), copter, {9, 0}), (commands{22, 178, 205, 16, 20})) << "no servo";
}

TEST(command_planner,
     on_the_way_to_where_an_operator_sends_it_no_pictures_are_made_and_the_line_is_flown_anew_afterwards) {
  auto mission = line_with_pictures();
  const auto rest_of_line = std::vector<mission::item>(mission.items.begin() + 5, mission.items.end());
  mission.items.resize(5);
  mission.items.emplace_back(mission::loiter{"goto7", at(0, 0, 30), 0, 600});
  auto flying = copter;
  flying.is_under_way = true;
  flying.start = at(500, 0, 30);
  const auto whole = build_plans(line_with_pictures(), copter)->front();
  flying.stops_camera = camera_to_stop(whole.items, whole.items.size() - 1);
  EXPECT_FALSE(flying.stops_camera) << "at its end it is off";
  for (std::size_t i = 0; i < whole.items.size() && !flying.stops_camera; ++i)
    flying.stops_camera = camera_to_stop(whole.items, i);
  ASSERT_TRUE(flying.stops_camera);
  EXPECT_EQ(commands_of(mission, flying, {5, 0}), (commands{206, 178, 19}));
  EXPECT_EQ(build_plans(mission, flying, {5, 0})->front().items[1].param1, 0) << "the trigger is off";
  flying.stops_camera.reset(); // where it was sent it is off
  mission.items.insert(mission.items.end(), rest_of_line.begin(), rest_of_line.end());
  const auto rest = build_plans(mission, flying, {6, 0})->front();
  EXPECT_EQ(commands_of(rest), (commands{178, 205, 16, 206, 16, 206, 16, 183, 16, 20}));
  EXPECT_NEAR(rest.items[3].y / 1e7, at(100, 0, 30).longitude, 1e-6) << "not from where it was sent";
}

// 0/0 is "here" to an ArduPilot, and a place in the sea to a PX4.
TEST(command_planner, a_take_off_without_a_place_climbs_where_a_px4_stands_and_leads_a_plane_to_the_next_place) {
  const auto first_of = [](const plan_setting& setting, const mission::position& next) {
    const auto plan = build_plans(mission_of({move("t", 22, {0, 0, 30}), waypoint("w", next), home_again}), setting);
    return plan->front().items.at(plan->front().map.first_sequence);
  };
  const auto next = at(500, 0, 30);
  EXPECT_EQ(first_of(px4, next).x, std::lround(px4.start.latitude * 1e7));
  EXPECT_EQ(first_of(px4, next).y, std::lround(px4.start.longitude * 1e7));
  EXPECT_EQ(first_of(px4_plane, next).y, std::lround(next.longitude * 1e7));
  EXPECT_EQ(first_of(copter, next).x, 0) << "as it came";
}

TEST(command_planner, a_take_off_that_came_climbs_to_its_height_and_is_followed_by_the_state) {
  const auto mission =
      mission_of({act("roi", 195), move("up", 22, at(0, 0, 40)), move("w", 16, at(500, 0, 40)), home_again});
  const auto plan = build_plans(mission, copter)->front();
  EXPECT_EQ(commands_of(plan), (commands{195, 22, 16, 20}));
  EXPECT_EQ(plan.legs[0].kind, leg_kind::climb);
  EXPECT_EQ(plan.legs[0].to.altitude_m, 40);
  EXPECT_EQ(why_not(mission_of({move("up", 22, at(0, 0, 0)), move("w", 16, at(500, 0, 40))}), copter),
            "Item 'up': It takes off to a height that is not above the ground it stands on; give it a height above the "
            "ground.");
}

TEST(command_planner, a_place_that_is_not_given_is_here_for_ardupilot_alone) {
  const auto mission = mission_of({up, waypoint("w", at(500, 0, 30)), move("stay", 18, {0, 0, 30}), home_again});
  EXPECT_EQ(why_not(mission, copter), "");
  auto on_px4 = mission;
  std::get<command_item>(on_px4.items[2]).command = 17;
  EXPECT_EQ(why_not(on_px4, px4),
            "Item 'stay': It has no place, and only ArduPilot takes that for the place where it is; "
            "give it a place.");
}

} // namespace command_planner_test
} // namespace godwit::executor::plan
