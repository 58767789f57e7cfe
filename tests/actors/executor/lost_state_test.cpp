// What an ArduPilot has forgotten over a pause, it gets again.
#include <gtest/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace lost_state_test {

using mission::progress_kind;
using operators::command_kind;
using sim::personality;
using tests::flight_world;

constexpr double slow_mps = 3; // a copter's own speed is 5

// Up, slowly and with the eyes on the yard to a far place, home.
mission::document watching(personality who) {
  auto result = tests::short_mission(who);
  result.schema_version = "2.1.0";
  const auto end = result.items.back();
  const auto yard = std::get<mission::waypoint>(tests::place(who, "", 60, 60)).at;
  constexpr std::uint8_t above_home = 3;
  result.items = {result.items.front(), mission::change_speed{"slowly", slow_mps},
                  mission::command_item{"yard",
                                        io::mavlink::number(io::mavlink::mav_cmd::do_set_roi_location),
                                        above_home,
                                        {0, 0, 0, 0, yard.latitude, yard.longitude, 0},
                                        true},
                  tests::place(who, "far", 0, 400), end};
  return result;
}

bool looks_at_yard(flight_world& world, personality who) {
  const auto yard = std::get<mission::waypoint>(tests::place(who, "", 60, 60)).at;
  const auto region = world.vehicle().describe().region_of_interest;
  return region && geo::distance_m(geo::point{yard.latitude, yard.longitude},
                                   geo::point{region->latitude_deg, region->longitude_deg}) < 1;
}

bool fly_and_pause(flight_world& world, personality who) {
  if (!tests::fly_to(world, watching(who), progress_kind::started, "far"))
    return false;
  world.run_for(5);
  return world.say(command_kind::pause).is_taken &&
         world.run_until([&] { return world.durable().status.now == phase::paused; }, 20);
}

TEST(lost_state, after_a_pause_a_copter_has_the_speed_and_the_region_of_interest_of_its_plan_again) {
  const auto who = personality::ardupilot;
  flight_world world({.who = who});
  ASSERT_TRUE(fly_and_pause(world, who)) << world.story();
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
  world.run_for(5);
  EXPECT_NEAR(world.vehicle().describe().ground_speed_mps, slow_mps, 0.3) << world.story();
  EXPECT_TRUE(looks_at_yard(world, who));
  EXPECT_FALSE(world.durable().owes_state);
  ASSERT_TRUE(world.run_until([&] { return world.durable().status.now == phase::done; }, 900)) << world.story();
}

TEST(lost_state, it_gets_them_also_after_a_crash_as_it_goes_on) {
  const auto who = personality::ardupilot;
  for (const double after_s : {0.05, 0.3, 0.6, 1.0}) {
    flight_world world({.who = who});
    ASSERT_TRUE(fly_and_pause(world, who)) << world.story();
    ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
    world.run_for(after_s);
    world.crash_all();
    world.run_for(10);
    EXPECT_NEAR(world.vehicle().describe().ground_speed_mps, slow_mps, 0.3) << after_s << world.story();
    EXPECT_TRUE(looks_at_yard(world, who)) << after_s << world.story();
  }
}

TEST(lost_state, what_it_refuses_is_told_and_the_rest_comes_all_the_same) {
  const auto who = personality::ardupilot;
  flight_world world({.who = who});
  ASSERT_TRUE(fly_and_pause(world, who)) << world.story();
  world.vehicle().refuse_command(io::mavlink::number(io::mavlink::mav_cmd::do_change_speed), 2, -1);
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
  world.run_for(6);
  EXPECT_TRUE(looks_at_yard(world, who)) << world.story();
  EXPECT_NE(world.story().find("did not take DO_CHANGE_SPEED of its plan again"), std::string::npos) << world.story();
  EXPECT_EQ(world.durable().status.now, phase::flying);
  EXPECT_FALSE(world.durable().owes_state);
}

TEST(lost_state, nothing_is_set_once_a_pilot_has_the_vehicle) {
  const auto who = personality::ardupilot;
  flight_world world({.who = who});
  ASSERT_TRUE(fly_and_pause(world, who)) << world.story();
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
  ASSERT_TRUE(world.run_until([&] { return world.durable().owes_state; }, 10)) << world.story();
  ASSERT_FALSE(looks_at_yard(world, who)) << "not yet";
  world.fly_by_hand(0);
  world.run_for(20);
  EXPECT_FALSE(looks_at_yard(world, who)) << world.story();
}

} // namespace lost_state_test
} // namespace godwit::executor
