// Plans of ground stations: taken, started, shown as they are flown; and the service's, which stations see and start.
#include <algorithm>

#include <gtest/gtest.h>

#include "actors/executor/station_plan.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/plan_meaning.hpp"
#include "tests/actors/executor/station_plans.hpp"

namespace godwit::executor {
namespace station_test {

using io::mavlink::mav_cmd;
using io::mavlink::mav_frame;
using io::mavlink::mav_mission_type;
using io::mavlink::mission_item_int;
using io::mavlink::mission_state;
using io::mavlink::number;
using tests::flight_world;

class flight_by_station : public testing::TestWithParam<sim::personality> {};

// The items that were shown as current, in order, of the plan of ITEMS.
std::vector<std::uint16_t> currents(const flight_world& world, const upload& items) {
  std::vector<std::uint16_t> result;
  for (const auto& each : world.shown_progress())
    if (each.plan_id == io::mavlink::checksum_of(items) && (result.empty() || result.back() != each.current))
      result.push_back(each.current);
  return result;
}

// -- a station's own plan -------------------------------------------------------------------------

TEST_P(flight_by_station, the_plan_of_a_station_is_flown_at_its_command_and_told_in_its_numbers) {
  flight_world world(by_stations(GetParam()));
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(world, items));
  world.run_for(5);
  EXPECT_EQ(world.durable().status.now, phase::ready) << "nothing starts by itself";
  EXPECT_EQ(world.shown_progress().back().state, mission_state::not_started);
  ASSERT_TRUE(fly_to_end(world, items));
  ASSERT_EQ(world.start_answers().size(), 1U);
  EXPECT_EQ(world.start_answers().front().verdict, start_verdict::started) << world.start_answers().front().reason;
  const auto seen = currents(world, items);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end())) << world.story();
  EXPECT_EQ(seen.back(), items.size() - 1);
  EXPECT_EQ(world.shown_progress().back().state, mission_state::complete) << world.story();
  std::vector<std::uint16_t> all(items.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = static_cast<std::uint16_t>(i);
  EXPECT_EQ(world.shown_reached(), all) << world.story();
  EXPECT_TRUE(world.shown_items().empty()) << "the station has it already";
}

TEST_P(flight_by_station, a_flown_plan_is_prepared_anew_at_the_next_start_and_flown_again) {
  flight_world world(by_stations(GetParam()));
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(world, items));
  ASSERT_TRUE(fly_to_end(world, items));
  const auto flown = world.durable().mission->mission_id;
  world.station_says(start_of(world, items));
  ASSERT_EQ(world.start_answers().size(), 2U);
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::not_ready);
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  EXPECT_NE(world.durable().mission->mission_id, flown) << "another mission, with reports of its own";
  ASSERT_TRUE(fly_to_end(world, items));
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::started) << world.start_answers().back().reason;
}

TEST_P(flight_by_station, after_a_crash_in_flight_the_station_goes_on_seeing_its_own_numbers) {
  flight_world world(by_stations(GetParam()));
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(world, items));
  ASSERT_TRUE(fly_two_items(world, items));
  world.crash_all();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.shown_reached().size(), items.size()) << world.story();
  EXPECT_TRUE(world.shown_items().empty()) << "what the station uploaded is still what is shown";
}

TEST_P(flight_by_station, what_no_mission_may_hold_is_refused_with_the_reason) {
  flight_world world(by_stations(GetParam()));
  auto items = station_items(GetParam());
  auto guarded = item_of(mav_cmd::do_parachute, {});
  guarded.frame = number(mav_frame::mission);
  items.push_back(guarded);
  items = numbered(items);
  world.station_says(taken(items));
  world.run_for(5);
  EXPECT_EQ(world.durable().status.now, phase::connected) << world.story();
  EXPECT_TRUE(was_said(world, "the plan is not taken")) << world.story();
  EXPECT_TRUE(was_said(world, "DO_PARACHUTE")) << world.story();
  world.station_says(start_of(world, items));
  ASSERT_EQ(world.start_answers().size(), 1U);
  EXPECT_EQ(world.start_answers().front().verdict, start_verdict::no_such_item);
  EXPECT_NE(world.start_answers().front().reason.find("DO_PARACHUTE"), std::string::npos);
}

TEST_P(flight_by_station, another_plan_takes_its_place_before_the_start_and_not_in_flight) {
  flight_world world(by_stations(GetParam()));
  const auto first = station_items(GetParam());
  auto second = first;
  second.insert(second.begin() + 3, waypoint_at(GetParam(), 30, 30));
  second = numbered(second);
  ASSERT_TRUE(bring(world, first));
  world.station_says(taken(second));
  ASSERT_TRUE(world.run_until([&] { return world.durable().flown->mission.items.size() == second.size(); }, 60))
      << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.station_says(start_of(world, first));
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::no_such_item) << "it is another plan now";
  ASSERT_TRUE(fly_two_items(world, second));
  world.station_says(taken(first));
  EXPECT_TRUE(was_said(world, "pause it, then upload, then start")) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.shown_progress().back().plan_id, io::mavlink::checksum_of(second)) << world.story();
}

TEST_P(flight_by_station, a_cleared_plan_can_not_be_started) {
  flight_world world(by_stations(GetParam()));
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(world, items));
  world.station_says(plan_cleared{mav_mission_type::mission, {255, 190}});
  EXPECT_TRUE(world.run_until_phase(phase::connected, 10)) << world.story();
  EXPECT_FALSE(world.durable().mission);
  world.station_says(start_of(world, items));
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::no_such_item);
  EXPECT_FALSE(world.say(operators::command_kind::start).is_taken);
}

// Its report comes when the act was confirmed, near the next place.
TEST(flight_by_station_of_a_load, the_item_under_way_is_shown_while_an_act_is_held_back_by_a_condition) {
  const auto who = sim::personality::ardupilot;
  auto options = by_stations(who);
  options.has_payload = true;
  flight_world world(options);
  auto items = station_items(who);
  constexpr std::uint16_t drop = 4;
  const auto command = [](mav_cmd what, float first) {
    auto result = item_of(what, {});
    result.frame = number(mav_frame::mission);
    result.param1 = first;
    return result;
  };
  const auto after_first_place = items.begin() + drop - 1;
  items.insert(after_first_place, {command(mav_cmd::condition_distance, 5), command(mav_cmd::do_gripper, 1)});
  items = numbered(items);
  ASSERT_TRUE(bring(world, items));
  world.station_says(start_of(world, items));
  const auto is_shown_before = [&] {
    const bool is_dropped = std::ranges::count(world.shown_reached(), drop) > 0;
    return !is_dropped && !world.shown_progress().empty() && world.shown_progress().back().current == drop + 1;
  };
  EXPECT_TRUE(world.run_until(is_shown_before, 600)) << world.story();
  EXPECT_TRUE(world.run_until([&] { return std::ranges::count(world.shown_reached(), drop) == 1; }, 60));
}

class go_to_of_a_station : public testing::TestWithParam<sim::personality> {};

// QGroundControl's Set Waypoint: the next item that there was flown instead, and it heard that all is well.
TEST_P(go_to_of_a_station, an_item_that_the_vehicle_has_no_more_is_refused_and_no_other_one_is_flown) {
  flight_world world(by_stations(GetParam()));
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(world, items));
  ASSERT_TRUE(fly_two_items(world, items));
  operators::command there;
  there.kind = operators::command_kind::go_to;
  there.by = "anna";
  there.place = mission::position{items[2].x * 1e-7 + 0.0003, items[2].y * 1e-7, items[2].z};
  ASSERT_TRUE(world.say(there).is_taken) << world.story();
  world.run_for(20);
  ASSERT_TRUE(world.say(operators::command_kind::cancel).is_taken) << world.story();
  ASSERT_TRUE(world.run_until([&] { return !world.shown_progress().back().is_sent_elsewhere; }, 10)) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::flying, 10)) << world.story();
  const auto current = world.shown_progress().back().current;
  auto flown_already = start_of(world, items);
  flown_already.first = 1;
  world.station_says(flown_already);
  ASSERT_TRUE(world.run_until([&] { return world.start_answers().size() == 2; }, 10)) << world.story();
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::no_such_item);
  EXPECT_EQ(world.shown_progress().back().current, current);
  auto to_come = start_of(world, items);
  to_come.first = static_cast<std::uint16_t>(items.size() - 2);
  world.station_says(to_come);
  ASSERT_TRUE(world.run_until([&] { return world.start_answers().size() == 3; }, 10)) << world.story();
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::started) << world.start_answers().back().reason;
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

TEST_P(flight_by_station, FR_00089_a_start_while_it_flies_restarts_at_the_item_that_is_named) {
  flight_world world(by_stations(GetParam()));
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(world, items));
  const std::uint16_t first_waypoint = GetParam() == sim::personality::rover ? 1 : 2;
  world.station_says(start_of(world, items));
  ASSERT_TRUE(world.run_until([&] { return world.shown_progress().back().current == first_waypoint + 1; }, 600))
      << world.story();
  auto again = start_of(world, items);
  again.first = first_waypoint;
  world.station_says(again);
  ASSERT_TRUE(world.run_until([&] { return world.start_answers().size() == 2; }, 20)) << world.story();
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::started) << world.start_answers().back().reason;
  EXPECT_TRUE(world.run_until([&] { return world.shown_progress().back().current == first_waypoint; }, 5))
      << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

TEST_P(flight_by_station, what_the_vehicle_says_of_a_refusal_is_in_the_answer_and_in_the_reason_of_the_pause) {
  flight_world world(by_stations(GetParam()));
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(world, items));
  world.lose_command(number(mav_cmd::component_arm_disarm), 100);
  world.vehicle_says("Arm: an old warning");
  world.run_for(1);
  world.station_says(start_of(world, items));
  ASSERT_TRUE(world.run_until(
      [&] {
        if (world.start_answers().empty())
          world.vehicle_says("Arm: Throttle too high");
        return !world.start_answers().empty();
      },
      60))
      << world.story();
  EXPECT_NE(world.start_answers().back().reason.find("\"Arm: Throttle too high\""), std::string::npos)
      << world.start_answers().back().reason;
  EXPECT_NE(world.durable().status.reason.find("Throttle too high"), std::string::npos) << world.story();
}

// -- a start after what the station has done itself --------------------------------------------------

// Its plan is ready, and its arm has gone on to the vehicle. godwit itself arms nothing.
class armed_by_station : public flight_by_station {
protected:
  void SetUp() override {
    ASSERT_TRUE(bring(world, items));
    ASSERT_EQ(world.station_does(act_kind::arm).verdict, act_verdict::pass);
  }

  static flight_world::options without_arming() {
    auto result = by_stations(GetParam());
    result.arm_on_start = false;
    return result;
  }

  flight_world world{without_arming()};
  upload items = station_items(GetParam());
};

// As MAVSDK does it: arm and start in one breath, before a heartbeat shows that it is armed.
TEST_P(armed_by_station, a_start_right_after_an_arm_waits_for_the_heartbeat_that_shows_it) {
  world.arm_by_hand();
  world.station_says(start_of(world, items));
  EXPECT_TRUE(world.run_until_phase(phase::flying, 30)) << world.story();
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::started);
}

TEST_P(armed_by_station, a_start_after_an_arm_that_the_vehicle_refuses_is_refused_too) {
  world.station_says(start_of(world, items));
  const auto before = world.orders();
  world.run_for(10);
  ASSERT_EQ(world.start_answers().size(), 1U) << world.story();
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::disarmed);
  EXPECT_EQ(world.orders(), before) << world.story();
}

// As MAVProxy and DroneKit do it: arm, take off, and then the mission mode.
TEST(copter_by_station, who_has_taken_off_through_a_station_starts_its_plan_in_the_air) {
  for (const auto who : {sim::personality::px4, sim::personality::ardupilot}) {
    constexpr std::uint32_t px4_hold = 4U << 16U | 3U << 24U;
    constexpr std::uint32_t copter_loiter = 5;
    flight_world world(by_stations(who));
    const auto items = station_items(who);
    ASSERT_TRUE(bring(world, items));
    ASSERT_EQ(world.station_does(act_kind::arm).verdict, act_verdict::pass);
    world.fly_by_hand(who == sim::personality::px4 ? px4_hold : copter_loiter);
    auto of_another = start_of(world, items);
    of_another.asked_by = {254, 190};
    const auto before = world.orders();
    world.station_says(of_another);
    world.run_for(1);
    EXPECT_EQ(world.start_answers().back().verdict, start_verdict::not_ready);
    EXPECT_EQ(world.orders(), before) << world.story();
    world.station_says(start_of(world, items));
    EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
    EXPECT_EQ(world.start_answers().back().verdict, start_verdict::started) << world.story();
    EXPECT_TRUE(world.reactions().empty());
  }
}

// What flies begins with its take-off.
TEST(rover_by_station, FR_00089_it_may_begin_with_another_item) {
  flight_world world(by_stations(sim::personality::rover));
  const auto items = station_items(sim::personality::rover);
  ASSERT_TRUE(bring(world, items));
  auto from_the_second = start_of(world, items);
  from_the_second.first = 2;
  world.station_says(from_the_second);
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::started);
  EXPECT_EQ(world.shown_reached(), (std::vector<std::uint16_t>{2})) << world.story();
}

TEST_P(flight_by_station, FR_00089_failing_checks_come_before_being_disarmed) {
  auto wanted = by_stations(GetParam());
  wanted.arm_on_start = false;
  flight_world world(wanted);
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(world, items));
  world.station_says(start_of(world, items));
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::disarmed) << world.story();
  world.vehicle().set_battery(5, world.now_ns());
  world.run_for(10);
  world.station_says(start_of(world, items));
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::not_ready) << world.story();
}

TEST_P(flight_by_station, the_home_that_stations_write_for_an_ardupilot_is_no_waypoint) {
  flight_world world(by_stations(GetParam()));
  auto items = station_items(GetParam());
  auto home = waypoint_at(GetParam(), 0, 0);
  home.z = 488;
  home.frame = number(mav_frame::global);
  items.insert(items.begin(), home);
  items = numbered(items);
  ASSERT_TRUE(world.run_until_phase(phase::connected)) << world.story();
  world.station_says(taken(items));
  if (GetParam() != sim::personality::ardupilot && GetParam() != sim::personality::plane) {
    const auto* const uploaded = uploaded_mission(world.durable());
    ASSERT_NE(uploaded, nullptr) << world.story();
    EXPECT_EQ(mission::kind_of(uploaded->items.front()), "command") << "elsewhere it is an item, above the sea";
    return;
  }
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  ASSERT_TRUE(fly_to_end(world, items));
  EXPECT_EQ(world.shown_reached(), (std::vector<std::uint16_t>{1, 2, 3, 4, 5})) << "in the station's own numbers";
}

TEST_P(flight_by_station, who_takes_us_for_an_ardupilot_is_shown_home_as_item_0) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command, .shows_home = true});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  const auto shown = world.shown_items();
  EXPECT_EQ(shown.size(), world.durable().flown->items.size());
  ASSERT_TRUE(fly_to_end(world, shown));
  EXPECT_EQ(world.shown_reached().front(), world.durable().progress.plan->map.first_sequence);
  EXPECT_EQ(currents(world, shown).back(), shown.size() - 1);
}

// -- its fence ------------------------------------------------------------------------------------

TEST_P(flight_by_station, the_fence_of_a_station_is_checked_and_watched) {
  flight_world world(by_stations(GetParam()));
  const auto items = station_items(GetParam());
  world.station_says(taken(items));
  world.station_says(taken(fence_around(GetParam(), 20), mav_mission_type::fence));
  world.run_for(10);
  EXPECT_EQ(world.durable().status.now, phase::preflight) << "the waypoints are outside: " << world.story();
  world.station_says(taken(fence_around(GetParam(), 500), mav_mission_type::fence));
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.station_says(start_of(world, items));
  ASSERT_TRUE(world.run_until_phase(phase::flying)) << world.story();
  EXPECT_EQ(world.guarded().size(), 1U);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_TRUE(world.reactions().empty()) << world.story();
}

TEST_P(flight_by_station, a_fence_that_comes_first_counts_for_the_plan_after_it_until_it_is_cleared) {
  flight_world world(by_stations(GetParam()));
  world.station_says(taken(fence_around(GetParam(), 20), mav_mission_type::fence));
  world.station_says(taken(station_items(GetParam())));
  world.run_for(10);
  EXPECT_EQ(world.durable().status.now, phase::preflight) << world.story();
  world.station_says(plan_cleared{mav_mission_type::fence, {255, 190}});
  EXPECT_TRUE(world.run_until_phase(phase::ready)) << world.story();
}

// -- the mission of the service -------------------------------------------------------------------

TEST_P(flight_by_station, stations_see_the_mission_of_the_service_and_may_start_it) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  const auto shown = world.shown_items();
  const auto home = world.durable().progress.plan->map.first_sequence;
  ASSERT_EQ(shown.size() + home, world.durable().flown->items.size());
  EXPECT_EQ(shown.front().seq, 0);
  ASSERT_TRUE(fly_to_end(world, shown));
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::started) << world.start_answers().back().reason;
  const auto seen = currents(world, shown);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end())) << world.story();
  EXPECT_EQ(seen.back(), shown.size() - 1);
  EXPECT_EQ(world.shown_reached().size(), world.durable().mission->items.size());
}

TEST_P(flight_by_station, with_a_service_the_plan_of_a_station_is_not_taken_and_the_mission_is_shown_again) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  const auto told = world.times_shown();
  world.station_says(taken(station_items(GetParam())));
  EXPECT_TRUE(was_said(world, "missions come from the missions service here")) << world.story();
  EXPECT_EQ(world.times_shown(), told + 1) << "in place of what the station has uploaded";
  EXPECT_EQ(world.durable().status.now, phase::ready);
}

TEST_P(flight_by_station, with_a_service_fences_and_rally_points_of_a_station_are_refused_as_its_plan_is) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  auto items = upload(1);
  items.front().frame = io::mavlink::number(io::mavlink::mav_frame::global_relative_alt);
  items.front().command = io::mavlink::number(io::mavlink::mav_cmd::nav_rally_point);
  for (const auto type : {mav_mission_type::fence, mav_mission_type::rally}) {
    items.front().mission_type = io::mavlink::number(type);
    world.station_says(taken(items, type));
    ASSERT_FALSE(world.judged().empty());
    EXPECT_EQ(world.judged().back().type, type);
    EXPECT_EQ(world.judged().back().verdict, ground_port::plan_verdict::refused) << world.story();
  }
}

TEST_P(flight_by_station, a_circle_is_a_fence_before_and_after_the_plan) {
  for (const bool is_plan_first : {true, false}) {
    flight_world world(by_stations(GetParam()));
    const auto items = station_items(GetParam());
    auto circle = tests::waypoint_at(GetParam(), 0, 0);
    circle.command = number(mav_cmd::nav_fence_circle_inclusion);
    circle.param1 = 500;
    if (is_plan_first)
      world.station_says(taken(items));
    world.station_says(taken(tests::numbered({circle}), mav_mission_type::fence));
    EXPECT_EQ(world.judged().back().verdict, ground_port::plan_verdict::taken) << world.story();
    if (!is_plan_first)
      world.station_says(taken(items));
    ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  }
}

// As MAVProxy uploads a .fen file, and as ArduPilot takes it.
TEST_P(flight_by_station, a_fence_keeps_the_point_to_which_a_breach_leads_until_a_fence_without_one_comes) {
  flight_world world(by_stations(GetParam()));
  ASSERT_TRUE(bring(world, station_items(GetParam())));
  auto items = fence_around(GetParam(), 150);
  auto point = tests::waypoint_at(GetParam(), 0, 0);
  point.command = number(mav_cmd::nav_fence_return_point);
  items.insert(items.begin(), point);
  world.station_says(taken(tests::numbered(items), mav_mission_type::fence));
  EXPECT_EQ(world.judged().back().verdict, ground_port::plan_verdict::taken) << world.story();
  const auto has_point = [&] { return world.durable().mission->breach_return_point.has_value(); };
  ASSERT_TRUE(world.run_until([&] { return !world.durable().mission->geofences.empty(); }, 20)) << world.story();
  EXPECT_TRUE(has_point()) << world.story();
  world.station_says(taken(fence_around(GetParam(), 150), mav_mission_type::fence));
  ASSERT_TRUE(world.run_until([&] { return !has_point(); }, 20)) << world.story();
  EXPECT_EQ(world.durable().mission->geofences.size(), 1U);
}

TEST_P(flight_by_station, what_is_changed_in_flight_is_shown_as_the_vehicle_has_it) {
  flight_world world(by_stations(GetParam()));
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(world, items));
  ASSERT_TRUE(fly_two_items(world, items));
  operators::command there;
  there.kind = operators::command_kind::insert;
  there.place = std::get<mission::waypoint>(tests::place(GetParam(), "", 30, 30)).at;
  ASSERT_TRUE(world.say(there).is_taken) << world.story();
  ASSERT_TRUE(world.run_until([&] { return world.durable().flown->mission.revision == 2; }, 60)) << world.story();
  EXPECT_FALSE(world.shown_items().empty()) << world.story();
  world.station_says(taken(items));
  EXPECT_TRUE(was_said(world, "was changed since this station's upload")) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.shown_progress().back().plan_id, io::mavlink::checksum_of(world.shown_items())) << world.story();
  EXPECT_EQ(world.shown_progress().back().state, mission_state::complete);
}

const auto every_vehicle = testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::rover,
                                           sim::personality::plane);
INSTANTIATE_TEST_SUITE_P(each, go_to_of_a_station,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::plane));
INSTANTIATE_TEST_SUITE_P(each, flight_by_station, every_vehicle);
INSTANTIATE_TEST_SUITE_P(each, armed_by_station, every_vehicle);

} // namespace station_test
} // namespace godwit::executor
