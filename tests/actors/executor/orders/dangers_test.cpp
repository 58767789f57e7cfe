// What real vehicles were seen to do to people beside them, each on every simulated vehicle, with the person on
// godwit's line to it and on another one.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/flight_world.hpp"
#include "tests/support/vehicle_modes.hpp"

namespace godwit::executor {
namespace dangers_test {

using mission::progress_kind;
using operators::command_kind;
using sim::personality;
using tests::flight_world;
using tests::hold_mode;
using tests::mission_mode;
using tests::pilot_mode;

class danger : public testing::TestWithParam<std::tuple<personality, bool>> {
protected:
  [[nodiscard]] static personality who() { return std::get<0>(GetParam()); }
  [[nodiscard]] static flight_world::options settings() {
    flight_world::options result;
    result.who = who();
    result.start = start_policy::on_command;
    result.speed = 1;
    result.is_person_on_other_line = std::get<1>(GetParam());
    return result;
  }
  // A PX4's plan is there when its next word has judged it, and the start needs no other: nobody acts in between.
  [[nodiscard]] static bool starts_when_ready() { return who() == personality::px4; }
  // The items of the plan on the vehicle, each place moved: as many, and another way.
  [[nodiscard]] static std::vector<io::mavlink::mission_item_int> another_plan(const flight_world& world) {
    auto result = world.durable().flown->items;
    for (auto& each : result)
      if (each.x != 0)
        each.x += 20'000; // 220 m to the north
    return result;
  }
  // Of the short mission, in flight to w2: these items follow that one.
  [[nodiscard]] static mission::assignment after_w2(std::vector<mission::item> items) {
    mission::assignment result;
    result.assignment_id = "11111111-2222-4333-8444-100000000001";
    result.base_revision = 1;
    result.revision = 2;
    result.replace_after_item_id = "w2";
    result.items = std::move(items);
    return result;
  }
  [[nodiscard]] static bool is_reported(const flight_world& world, progress_kind kind, const std::string& item) {
    return tests::is_told(world, kind, item);
  }
};

// The person's disarm meets the start before or after its heartbeat; with a slow line anywhere between two orders. On a
// slow line the copies of the arming come 0.2 s and a delay after it at most.
TEST_P(danger, a_vehicle_that_a_person_disarms_in_its_start_is_not_armed_again) {
  for (const std::int64_t delay_ms : {1, 40, 400})
    for (const double seconds : {0.0, 0.02, 0.1, 0.3, 0.6, 0.9}) {
      if (seconds < 0.2 + delay_ms / 1e3 && delay_ms > 1)
        continue;
      auto wanted = settings();
      wanted.most_delay_ms = delay_ms;
      flight_world world(wanted);
      world.load(tests::short_mission(who()));
      ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
      ASSERT_TRUE(world.say(command_kind::start).is_taken);
      ASSERT_TRUE(world.run_until([&] { return world.vehicle().describe().armed; }, 10)) << world.story();
      world.run_for(seconds);
      if (world.vehicle().describe().in_air)
        continue; // it is too late for a disarm
      world.disarm_by_hand();
      world.run_for(delay_ms / 1e3 + 0.01); // what was on the line
      EXPECT_LE(world.arms(), 1) << world.story();
      const auto starts = world.starts();
      world.run_for(30);
      EXPECT_EQ(world.arms(), 1) << world.story();
      EXPECT_LE(world.starts(), starts + 1) << world.story();
      EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
      EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
      EXPECT_EQ(world.sentence().find("stands armed"), std::string::npos) << world.sentence();
    }
}

TEST_P(danger, an_order_that_was_accepted_is_never_sent_again) {
  flight_world world(settings());
  world.load(tests::short_mission(who()));
  ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
  ASSERT_TRUE(world.say(command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until([&] { return world.vehicle().describe().armed; }, 10)) << world.story();
  world.lose_message(io::mavlink::heartbeat::message_id); // nothing shows it
  world.run_for(4.5);
  world.lose_message(0);
  world.run_for(30);
  EXPECT_EQ(world.arms(), 1) << world.story();
}

TEST_P(danger, a_pilots_hold_right_after_a_start_is_not_flown_over) {
  for (const double seconds : {0.0, 0.02, 0.05, 0.2}) {
    auto wanted = settings();
    wanted.most_delay_ms = 20;
    flight_world world(wanted);
    world.load(tests::short_mission(who()));
    ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
    const auto before = world.starts();
    ASSERT_TRUE(world.say(command_kind::start).is_taken);
    ASSERT_TRUE(world.run_until([&] { return world.starts() == before + 1; }, 10)) << world.story();
    world.run_for(0.02 + seconds); // it has come
    world.switch_mode(hold_mode(who()));
    world.run_for(30);
    EXPECT_EQ(world.starts(), before + 1) << world.story();
    EXPECT_NE(world.heard_mode(), mission_mode(who())) << world.story();
    EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
  }
}

TEST_P(danger, a_pilots_hold_right_after_the_way_to_a_new_plan_is_not_flown_over) {
  auto wanted = settings();
  wanted.start = start_policy::automatic;
  flight_world world(wanted);
  ASSERT_TRUE(tests::fly_to(world, tests::short_mission(who()), progress_kind::started, "w2"));
  world.assign(after_w2({tests::place(who(), "z", -20, 20)}));
  ASSERT_TRUE(world.run_until([&] { return world.durable().flown->mission.revision == 2; }, 60)) << world.story();
  const auto is_sent_on = [&] { return world.durable().doing && world.heard_mode() == mission_mode(who()); };
  ASSERT_TRUE(world.run_until(is_sent_on, 10) || !world.durable().doing) << world.story();
  world.run_for(0.05);
  world.switch_mode(hold_mode(who()));
  world.run_for(1.2);
  const auto orders = world.orders();
  world.run_for(30);
  EXPECT_EQ(world.orders(), orders) << world.story();
  EXPECT_NE(world.heard_mode(), mission_mode(who())) << world.story();
}

// A change of the plan is uploaded while the vehicle holds, and would be continued with by the mission mode.
TEST_P(danger, a_vehicle_that_a_person_disarms_in_its_flight_is_not_sent_into_its_mission_mode) {
  if (who() == personality::px4)
    return; // it stays in its mission mode while its plan is replaced
  int tried = 0;
  for (const double seconds : {0.1, 0.3, 0.6, 1.0, 1.5, 2.0, 3.0}) {
    auto wanted = settings();
    wanted.most_delay_ms = 150; // the upload takes a while
    wanted.start = start_policy::automatic;
    flight_world world(wanted);
    ASSERT_TRUE(tests::fly_to(world, tests::short_mission(who()), progress_kind::started, "w2"));
    std::vector<mission::item> items;
    for (int i = 0; i < 8; ++i)
      items.push_back(tests::place(who(), "z" + std::to_string(i), -20 - i, 20));
    world.assign(after_w2(std::move(items)));
    world.run_for(seconds);
    world.disarm_by_hand();
    world.run_for(1.3); // a heartbeat shows it
    if (world.heard_mode() == mission_mode(who()))
      continue; // it was on its mission then, or was sent on before anybody could know
    ++tried;
    const bool never = !world.run_until([&] { return world.heard_mode() == mission_mode(who()); }, 30);
    EXPECT_TRUE(never) << seconds << " s\n" << world.story();
  }
  EXPECT_GT(tried, 0);
}

// The plan that is brought to it is lost on its way, and would be brought once more.
TEST_P(danger, a_vehicle_that_a_person_disarms_in_its_flight_gets_no_further_plan_or_item) {
  for (const double seconds : {0.2, 2.0, 6.0, 12.0}) {
    auto wanted = settings();
    wanted.start = start_policy::automatic;
    flight_world world(wanted);
    ASSERT_TRUE(tests::fly_to(world, tests::short_mission(who()), progress_kind::started, "w2"));
    world.lose_message(io::mavlink::mission_ack::message_id);
    world.assign(after_w2({tests::place(who(), "z", -20, 20)}));
    ASSERT_TRUE(world.run_until([&] { return world.is_uploading(); }, 30)) << world.story();
    world.run_for(seconds);
    world.disarm_by_hand();
    world.run_for(1.3); // a heartbeat shows it
    const auto orders = world.orders();
    world.run_for(20);
    world.lose_message(0);
    world.run_for(60);
    EXPECT_EQ(world.orders(), orders) << seconds << " s\n" << world.story();
    EXPECT_FALSE(world.durable().progress.upload) << seconds << " s: nothing would be resumed\n" << world.story();
    EXPECT_FALSE(world.durable().progress.start) << seconds << " s\n" << world.story();
  }
}

// The vehicle stands disarmed with its plan, and would be started by itself. A person has changed its mode, in the
// upload or after it, in a form that nobody acknowledges to others.
TEST_P(danger, what_a_person_has_changed_on_the_ground_is_not_started_by_itself) {
  for (const bool is_in_upload : {true, false}) {
    if (!is_in_upload && starts_when_ready())
      continue;
    for (const auto mode :
         {pilot_mode(who()), who() == personality::px4 || who() == personality::ardupilot ? tests::landing_mode(who())
                                                                                          : pilot_mode(who())}) {
      auto wanted = settings();
      wanted.start = start_policy::automatic;
      wanted.takeoff_again = start_policy::automatic;
      flight_world world(wanted);
      world.load(tests::short_mission(who()));
      ASSERT_TRUE(world.run_until_phase(is_in_upload ? phase::uploading : phase::ready, 120)) << world.story();
      if (world.heard_mode() == mode)
        continue;
      world.switch_mode(mode);
      world.run_for(60);
      EXPECT_EQ(world.arms(), 0) << world.story();
      EXPECT_EQ(world.starts(), 0) << world.story();
      EXPECT_EQ(world.durable().status.now, phase::ready) << world.story();
      EXPECT_NE(world.sentence().find("a person has to start it"), std::string::npos) << world.sentence();
      ASSERT_TRUE(world.say(command_kind::start).is_taken) << world.sentence();
      EXPECT_TRUE(world.run_until_phase(phase::flying, 20)) << world.story();
    }
  }
}

// Any moment of the upload: what shows the mode last before the start is a heartbeat, a CURRENT_MODE (PX4), or the look
// that the start begins with.
TEST_P(danger, a_mode_of_a_person_that_is_shown_just_before_a_start_by_itself_keeps_it_back) {
  int tried = 0;
  for (const auto mode : {pilot_mode(who()), mission_mode(who())})
    for (int ms = 0; ms < 1'500; ms += 50) {
      auto wanted = settings();
      wanted.start = start_policy::automatic;
      flight_world world(wanted);
      world.load(tests::short_mission(who()));
      ASSERT_TRUE(world.run_until_phase(phase::uploading, 120)) << world.story();
      world.run_for(ms / 1e3);
      if (world.durable().status.now != phase::uploading)
        break;
      if (world.heard_mode() == mode)
        continue;
      ++tried;
      world.switch_mode(mode);
      world.run_for(30);
      EXPECT_EQ(world.arms(), 0) << ms << " ms\n" << world.story();
      EXPECT_EQ(world.starts(), 0) << ms << " ms\n" << world.story();
    }
  EXPECT_GT(tried, 0);
}

// A start that came through when a person had the vehicle already.
TEST_P(danger, a_vehicle_that_flies_our_plan_when_it_is_handed_back_is_followed_to_the_end) {
  if (who() == personality::plane)
    return; // it is not started by hand
  flight_world world(settings());
  world.load(tests::short_mission(who()));
  ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
  ASSERT_TRUE(world.say(command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until([&] { return world.vehicle().describe().armed; }, 10)) << world.story();
  world.switch_mode(pilot_mode(who()));
  ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::taken_over; }, 10))
      << world.story();
  if (who() == personality::rover) { // which does not begin in the mode in which it is
    world.fly_by_hand(hold_mode(who()));
    world.person().command(io::mavlink::mav_cmd::mission_start);
  } else {
    world.fly_by_hand(mission_mode(who()));
  }
  world.run_for(3);
  const auto orders = world.orders();
  ASSERT_TRUE(world.say(command_kind::hand_back).is_taken) << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::flying, 10)) << world.story();
  EXPECT_EQ(world.orders(), orders) << "it goes its way";
  EXPECT_TRUE(world.run_until_phase(phase::done, 300)) << world.story();
}

// An acknowledgement goes to who has asked, on that line.
class danger_on_its_line : public danger {};

TEST_P(danger_on_its_line, who_is_commanded_on_the_ground_is_not_started_by_itself) {
  auto wanted = settings();
  wanted.start = start_policy::automatic;
  flight_world world(wanted);
  world.load(tests::short_mission(who()));
  ASSERT_TRUE(world.run_until_phase(starts_when_ready() ? phase::uploading : phase::ready, 120)) << world.story();
  world.person().disarm();
  world.run_for(60);
  EXPECT_EQ(world.arms(), 0) << world.story();
  EXPECT_NE(world.sentence().find("a person has to start it"), std::string::npos) << world.sentence();
}

TEST_P(danger_on_its_line, what_somebody_else_commands_is_known_at_once) {
  auto wanted = settings();
  wanted.start = start_policy::automatic;
  flight_world world(wanted);
  ASSERT_TRUE(tests::fly_to(world, tests::short_mission(who()), progress_kind::started, "w2"));
  world.run_for(0.3);
  world.lose_message(io::mavlink::heartbeat::message_id); // and CURRENT_MODE comes each half second
  const auto orders = world.orders();
  world.switch_mode(pilot_mode(who()), tests::mode_form::do_set_mode);
  world.run_for(0.02);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  EXPECT_FALSE(world.say(command_kind::come_home).is_taken) << world.story();
  world.lose_message(0);
  world.run_for(5);
  EXPECT_EQ(world.orders(), orders) << world.story();
}

TEST_P(danger, a_plan_of_somebody_else_is_not_started) {
  flight_world world(settings());
  world.load(tests::short_mission(who()));
  ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
  world.run_for(3); // the answer to an upload of ours is a proof for 2 s
  world.person().upload(another_plan(world));
  ASSERT_TRUE(world.run_until([&] { return world.person().plan_answer().has_value(); }, 20)) << world.story();
  ASSERT_EQ(world.person().plan_answer(), 0) << world.story();
  static_cast<void>(world.say(command_kind::start));
  world.run_for(20);
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
  EXPECT_EQ(world.arms(), 0) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::foreign_plan) << world.story();
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << "it brings ours again\n" << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::ready, 60)) << world.story();
}

TEST_P(danger, a_plan_of_somebody_else_is_not_resumed) {
  auto wanted = settings();
  wanted.start = start_policy::automatic;
  flight_world world(wanted);
  ASSERT_TRUE(tests::fly_to(world, tests::short_mission(who()), progress_kind::started, "w2"));
  ASSERT_TRUE(world.say(command_kind::pause).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  world.run_for(5);
  world.person().upload(another_plan(world));
  ASSERT_TRUE(world.run_until([&] { return world.person().plan_answer().has_value(); }, 20)) << world.story();
  static_cast<void>(world.say(command_kind::resume));
  world.run_for(20);
  EXPECT_NE(world.heard_mode(), mission_mode(who())) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::foreign_plan) << world.story();
}

TEST_P(danger, a_plan_of_somebody_else_in_flight_makes_no_report) {
  auto wanted = settings();
  wanted.start = start_policy::automatic;
  flight_world world(wanted);
  ASSERT_TRUE(tests::fly_to(world, tests::short_mission(who()), progress_kind::started, "w2"));
  world.run_for(2);
  world.person().upload(another_plan(world));
  world.run_for(90);
  EXPECT_FALSE(is_reported(world, progress_kind::reached, "w3")) << world.story();
  EXPECT_FALSE(std::ranges::any_of(world.reports(), [](const auto& each) {
    return each.kind == progress_kind::complete;
  })) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::foreign_plan) << world.story();
}

// The mission is called off by then: nothing of it is followed any more.
TEST_P(danger_on_its_line, a_plan_of_somebody_else_is_not_taken_for_the_way_home) {
  if (who() == personality::plane)
    return; // it is given no plan home
  auto wanted = settings();
  wanted.start = start_policy::automatic;
  flight_world world(wanted);
  ASSERT_TRUE(tests::fly_to(world, tests::short_mission(who()), progress_kind::started, "w2"));
  world.set_home_by_hand(); // so that a plan leads home
  world.run_for(6);
  ASSERT_TRUE(world.say(command_kind::come_home).is_taken);
  const auto is_on_way = [&] { return world.durable().status.now == phase::landing && !world.durable().doing; };
  ASSERT_TRUE(world.run_until(is_on_way, 30)) << world.story();
  world.run_for(3);
  world.person().upload(another_plan(world));
  ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::foreign_plan; }, 15))
      << world.story();
  EXPECT_TRUE(world.say(command_kind::come_home).is_taken) << "by a plan of ours";
  EXPECT_TRUE(world.run_until(is_on_way, 30)) << world.story();
}

// A person has the vehicle go on with the item ID of our plan. False: the plan has none.
bool choose_item(flight_world& world, personality who, std::string_view id) {
  const auto& items = world.durable().progress.plan->map.items;
  const auto found = std::ranges::find(items, id, &progress::mapped_item::item_id);
  if (found == items.end())
    return false;
  world.person().choose_item(found->first_sequence, who == personality::px4);
  return true;
}

TEST_P(danger, items_that_somebody_else_jumps_over_are_not_reported_as_reached) {
  auto wanted = settings();
  wanted.start = start_policy::automatic;
  flight_world world(wanted);
  ASSERT_TRUE(tests::fly_to(world, tests::short_mission(who()), progress_kind::started, "w1"));
  world.run_for(1);
  ASSERT_TRUE(choose_item(world, who(), "w3"));
  world.run_for(120);
  EXPECT_FALSE(is_reported(world, progress_kind::reached, "w2")) << world.story();
}

// Whose first position comes after the start, and which has not moved yet.
TEST_P(danger, an_item_that_somebody_else_chooses_right_after_the_start_is_not_taken_for_the_way_there) {
  auto wanted = settings();
  wanted.start = start_policy::automatic;
  flight_world world(wanted);
  const auto first = who() == personality::rover ? "w1" : "up";
  ASSERT_TRUE(tests::fly_to(world, tests::short_mission(who()), progress_kind::started, first));
  world.run_for(0.3);
  ASSERT_TRUE(choose_item(world, who(), "w2"));
  world.run_for(10);
  EXPECT_FALSE(is_reported(world, progress_kind::reached, "w1")) << world.story();
}

// The vehicle has not moved when it first reports that item as its own.
TEST_P(danger, an_item_that_somebody_else_chooses_in_a_start_is_not_taken_for_the_way_there) {
  int tried = 0;
  for (const double seconds : {0.0, 0.05, 0.1, 0.2, 0.4}) {
    auto wanted = settings();
    wanted.most_delay_ms = 40;
    flight_world world(wanted);
    world.load(tests::short_mission(who()));
    ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
    ASSERT_TRUE(world.say(command_kind::start).is_taken);
    ASSERT_TRUE(world.run_until([&] { return world.arms() > 0; }, 10)) << world.story();
    world.run_for(seconds);
    tried += world.durable().status.in_flight ? 0 : 1;
    ASSERT_TRUE(choose_item(world, who(), "w3"));
    world.run_for(15);
    EXPECT_FALSE(is_reported(world, progress_kind::reached, "w1")) << seconds << " s\n" << world.story();
    EXPECT_FALSE(is_reported(world, progress_kind::reached, "w2")) << seconds << " s\n" << world.story();
  }
  EXPECT_GT(tried, 0);
}

std::string name_of_case(const testing::TestParamInfo<std::tuple<personality, bool>>& info) {
  constexpr std::array names{"rover", "px4", "copter", "plane"}; // by personality
  return std::string(names.at(static_cast<std::size_t>(std::get<0>(info.param)))) +
         (std::get<1>(info.param) ? "_person_on_another_line" : "_person_on_its_line");
}

INSTANTIATE_TEST_SUITE_P(vehicles, danger,
                         testing::Combine(testing::Values(personality::rover, personality::px4, personality::ardupilot,
                                                          personality::plane),
                                          testing::Bool()),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(vehicles, danger_on_its_line,
                         testing::Combine(testing::Values(personality::rover, personality::px4, personality::ardupilot,
                                                          personality::plane),
                                          testing::Values(false)),
                         name_of_case);

} // namespace dangers_test
} // namespace godwit::executor
