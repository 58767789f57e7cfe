// A station clears the mission: here and on the vehicle, on the ground, while godwit has it.
#include "tests/actors/executor/station_plans.hpp"

namespace godwit::executor {
namespace station_clear_test {

using ground_port::plan_verdict;

class clear_by_station : public testing::TestWithParam<sim::personality> {};

constexpr plan_cleared clear_mission{mav_mission_type::mission, {255, 190}};

// But for ArduPilot's home.
int items_on(flight_world& world) {
  const auto count = world.vehicle().describe().mission_count;
  const bool has_home = world.durable().flown && world.durable().progress.plan->map.first_sequence == 1;
  return has_home ? count - 1 : count;
}

testing::AssertionResult ends_with(flight_world& world, plan_verdict wanted) {
  const auto so_far = world.judged().size();
  world.station_says(clear_mission);
  if (!world.run_until([&] { return world.judged().size() > so_far; }, 30))
    return testing::AssertionFailure() << "no answer. " << world.story();
  return world.judged().back().verdict == wanted
             ? testing::AssertionSuccess()
             : testing::AssertionFailure() << io::name_of(world.judged().back().verdict) << ". " << world.story();
}

TEST_P(clear_by_station, a_plan_is_cleared_here_and_on_the_vehicle_and_can_not_be_started) {
  flight_world world(by_stations(GetParam()));
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(world, items));
  const auto count = world.vehicle().describe().mission_count;
  ASSERT_TRUE(ends_with(world, plan_verdict::taken));
  EXPECT_LE(world.vehicle().describe().mission_count, count - static_cast<int>(items.size()) + 1) << world.story();
  EXPECT_LE(world.vehicle().describe().mission_count, 1);
  EXPECT_FALSE(world.durable().mission);
  world.run_for(10);
  EXPECT_EQ(world.durable().status.now, phase::connected) << world.story();
  EXPECT_TRUE(world.shown_items().empty()) << "what the vehicle had is not shown again";
  world.station_says(start_of(world, items));
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::no_such_item);
}

TEST_P(clear_by_station, another_plan_after_a_clear_is_brought_and_flown) {
  flight_world world(by_stations(GetParam()));
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(world, items));
  ASSERT_TRUE(ends_with(world, plan_verdict::taken));
  ASSERT_TRUE(bring(world, items));
  ASSERT_TRUE(fly_to_end(world, items));
  if (GetParam() == sim::personality::rover) // it stays armed where its mission ends
    world.disarm_by_hand();
  world.run_for(5);
  ASSERT_TRUE(ends_with(world, plan_verdict::taken)) << "after the flight";
  ASSERT_TRUE(bring(world, items));
}

TEST_P(clear_by_station, what_the_vehicle_holds_is_cleared_also_where_godwit_holds_nothing) {
  flight_world world(by_stations(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::connected)) << world.story();
  world.run_for(2);
  const auto orders = world.orders();
  ASSERT_TRUE(ends_with(world, plan_verdict::taken));
  EXPECT_EQ(world.orders(), orders + 1);
}

TEST_P(clear_by_station, in_flight_it_is_refused_and_the_plan_is_shown_again) {
  flight_world world(by_stations(GetParam()));
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(world, items));
  ASSERT_TRUE(fly_two_items(world, items));
  const auto orders = world.orders();
  ASSERT_TRUE(ends_with(world, plan_verdict::refused));
  EXPECT_EQ(world.orders(), orders);
  EXPECT_TRUE(was_said(world, "the plan is not cleared: it is flown")) << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.shown_progress().back().plan_id, io::mavlink::checksum_of(items));
}

TEST_P(clear_by_station, while_a_plan_is_brought_it_waits_for_that_and_is_done_after_it) {
  flight_world world(by_stations(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::connected)) << world.story();
  world.station_says(taken(station_items(GetParam())));
  ASSERT_TRUE(world.run_until([&] { return world.is_uploading(); }, 30)) << world.story();
  const auto so_far = world.judged().size();
  world.station_says(clear_mission);
  EXPECT_EQ(world.judged().size(), so_far) << "neither taken nor refused yet";
  ASSERT_TRUE(world.run_until([&] { return world.judged().size() > so_far; }, 5)) << world.story();
  EXPECT_EQ(world.judged().back().verdict, plan_verdict::taken) << world.story();
  EXPECT_FALSE(world.durable().mission);
  EXPECT_LE(world.vehicle().describe().mission_count, 1) << world.story();
}

TEST_P(clear_by_station, what_takes_too_long_before_it_is_said_and_the_plan_stays) {
  flight_world world(by_stations(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::connected)) << world.story();
  world.lose_message(io::mavlink::mission_count::message_id);
  world.station_says(taken(station_items(GetParam())));
  ASSERT_TRUE(world.run_until([&] { return world.is_uploading(); }, 30)) << world.story();
  ASSERT_TRUE(ends_with(world, plan_verdict::refused));
  EXPECT_TRUE(was_said(world, "something else is under way")) << world.story();
  EXPECT_TRUE(world.durable().mission);
}

TEST_P(clear_by_station, an_armed_vehicle_and_one_that_a_person_has_are_not_cleared) {
  auto wanted = by_stations(GetParam());
  wanted.arm_on_start = false;
  flight_world world(wanted);
  ASSERT_TRUE(bring(world, station_items(GetParam())));
  world.arm_by_hand();
  ASSERT_TRUE(world.run_until([&] { return world.vehicle().describe().armed; }, 10));
  world.run_for(2);
  const auto held = items_on(world);
  ASSERT_GT(held, 0);
  ASSERT_TRUE(ends_with(world, plan_verdict::refused));
  EXPECT_EQ(items_on(world), held);
  (void)world.station_does(act_kind::arm, {254, 190});
  ASSERT_TRUE(ends_with(world, plan_verdict::refused));
  EXPECT_TRUE(was_said(world, "handed back first")) << world.story();
}

TEST_P(clear_by_station, with_another_source_of_missions_it_is_refused) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  const auto told = world.times_shown();
  ASSERT_TRUE(ends_with(world, plan_verdict::refused));
  EXPECT_TRUE(was_said(world, "missions come from the missions service here")) << world.story();
  EXPECT_EQ(world.times_shown(), told + 1) << "in place of nothing";
  EXPECT_EQ(world.durable().status.now, phase::ready);
}

TEST_P(clear_by_station, a_vehicle_that_does_not_answer_is_said_and_nothing_is_left_to_start) {
  flight_world world(by_stations(GetParam()));
  ASSERT_TRUE(bring(world, station_items(GetParam())));
  world.lose_message(io::mavlink::mission_count::message_id);
  ASSERT_TRUE(ends_with(world, plan_verdict::failed));
  EXPECT_TRUE(was_said(world, "may still be on the vehicle")) << world.story();
  EXPECT_FALSE(world.durable().mission);
  world.lose_message(0);
  ASSERT_TRUE(ends_with(world, plan_verdict::taken));
}

TEST_P(clear_by_station, a_crash_while_it_is_cleared_leaves_nothing_to_start) {
  flight_world world(by_stations(GetParam()));
  ASSERT_TRUE(bring(world, station_items(GetParam())));
  world.lose_message(io::mavlink::mission_count::message_id);
  world.station_says(clear_mission);
  world.run_for(1);
  world.crash_all();
  world.lose_message(0);
  world.run_for(10);
  EXPECT_EQ(world.durable().status.now, phase::connected) << world.story();
  EXPECT_FALSE(world.say(operators::command_kind::start).is_taken);
  ASSERT_TRUE(ends_with(world, plan_verdict::taken));
}

// Between the decision and the moment at which the disk has it.
TEST(clear_of_a_station, nothing_is_sent_to_a_vehicle_that_is_armed_meanwhile) {
  const state durable;
  settings alone;
  alone.has_service = false;
  core it(alone, durable);
  const instant now{1'000'000'000, 1'800'000'000'000'000'000};
  static_cast<void>(it.on_start(true));
  static_cast<void>(
      it.on_vehicle(vehicle_link::connection_changed{vehicle_link::connection_phase::connected, {}}, now));
  io::mavlink::heartbeat beat;
  beat.type = number(io::mavlink::mav_type::quadrotor);
  beat.autopilot = number(io::mavlink::mav_autopilot::px4);
  static_cast<void>(it.on_vehicle(beat, now));
  const auto wanted = it.on_station(clear_mission, now);
  const auto found =
      std::ranges::find_if(wanted, [](const effect& each) { return std::holds_alternative<order>(each); });
  ASSERT_NE(found, wanted.end());
  const auto& unsent = std::get<order>(*found);
  EXPECT_EQ(unsent.when, goes::after_notes);
  EXPECT_EQ(it.lets_out(unsent, now), core::release::now);
  beat.base_mode = 128;
  static_cast<void>(it.on_vehicle(beat, now));
  EXPECT_EQ(it.lets_out(unsent, now), core::release::too_late);
  const auto told = it.on_late(unsent, now);
  EXPECT_TRUE(std::ranges::any_of(told, [](const effect& each) {
    const auto* said = std::get_if<send_to_port>(&each);
    const auto* judged = said == nullptr ? nullptr : std::get_if<ground_port::plan_judged>(&said->what);
    return judged != nullptr && judged->verdict == plan_verdict::failed;
  }));
}

INSTANTIATE_TEST_SUITE_P(each, clear_by_station,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::rover,
                                         sim::personality::plane),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

} // namespace station_clear_test
} // namespace godwit::executor
