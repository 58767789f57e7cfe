#include "programs/godwit-sim/vehicle/flight/flight.hpp"

#include <bit>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/programs/godwit-sim/vehicle/flight/flight_fixture.hpp"

namespace godwit::sim::test {
namespace flight_test {

using heard = std::vector<std::string>;

TEST(sim_flight, a_leg_of_100_m_at_2_m_s_takes_50_to_60_s) {
  auto it = rover();
  it.follow({waypoint(0, 100)}); // to its right: it turns first
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_GT(it.time_of("completed"), 50);
  EXPECT_LT(it.time_of("completed"), 60);
  EXPECT_NEAR(it.from_home_m(), 98, 0.1);
}

TEST(sim_flight, a_multirotor_flies_500_m_at_its_speed_and_arrives_within_the_radius) {
  auto it = multirotor();
  it.follow({at(nav_takeoff, 0, 0, 20), waypoint(0, 500, 20)});
  ASSERT_TRUE(it.run_until_said("reached 0"));
  EXPECT_NEAR(it.time_of("reached 0"), 20 / 2.5, 3);
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_NEAR(it.time_of("completed") - it.time_of("reached 0"), 500 / 5.0, 6);
  EXPECT_NEAR(it.from_home_m(), 498, 0.1);
  EXPECT_NEAR(it.vehicle.altitude_above_home_m(), 20, 0.5);
}

TEST(sim_flight, go_leads_there_and_says_that_it_has_arrived) {
  auto it = rover();
  it.vehicle.set_task(task::go{moved(home, {45, 30})});
  ASSERT_TRUE(it.run_until_said("arrived"));
  it.run(5);
  EXPECT_EQ(it.said, heard{"arrived"});
  EXPECT_NEAR(it.from_home_m(), 30, 2);
}

TEST(sim_flight, go_has_a_speed_of_its_own) {
  auto it = rover();
  it.vehicle.set_task(task::go{moved(home, {0, 30}), 0.7});
  it.run(5);
  EXPECT_NEAR(it.vehicle.where().ground_speed_mps, 0.7, 1e-9);
}

TEST(sim_flight, climb_takes_off_and_changes_the_altitude) {
  auto it = multirotor();
  it.vehicle.set_task(task::climb{410});
  ASSERT_TRUE(it.run_until_said("arrived"));
  it.run(5);
  EXPECT_EQ(it.said, (heard{"took off", "arrived"}));
  EXPECT_EQ(it.vehicle.where().where.altitude_m, 410);
  it.vehicle.set_task(task::climb{405});
  it.run(20);
  EXPECT_EQ(it.vehicle.where().where.altitude_m, 405);
  EXPECT_LT(it.from_home_m(), 0.01);
}

TEST(sim_flight, land_comes_down_where_it_is) {
  auto it = multirotor();
  it.vehicle.set_task(task::climb{410});
  it.run(10);
  it.vehicle.set_task(task::land{});
  ASSERT_TRUE(it.run_until_said("landed"));
  EXPECT_EQ(it.vehicle.altitude_above_home_m(), 0);
  EXPECT_EQ(it.said.back(), "landed");
}

TEST(sim_flight, come_back_climbs_returns_and_lands_and_a_rover_drives_home) {
  auto drone = multirotor();
  auto away = moved(home, {0, 80});
  away.altitude_m = 405;
  drone.vehicle.set_task(task::go{away});
  ASSERT_TRUE(drone.run_until_said("arrived"));
  drone.vehicle.set_task(task::come_back{});
  ASSERT_TRUE(drone.run_until([&] { return drone.from_home_m() < 40; }));
  EXPECT_NEAR(drone.vehicle.altitude_above_home_m(), 15, 0.5);
  ASSERT_TRUE(drone.run_until_said("landed"));
  EXPECT_LT(drone.from_home_m(), 1);

  auto car = rover();
  car.vehicle.set_task(task::go{moved(home, {0, 30})});
  ASSERT_TRUE(car.run_until_said("arrived"));
  car.said.clear();
  car.vehicle.set_task(task::come_back{});
  ASSERT_TRUE(car.run_until_said("arrived"));
  EXPECT_LT(car.from_home_m(), 2.1);
}

TEST(sim_flight, hold_and_coast_come_to_a_stop_and_stay) {
  for (const task::any what : {task::any(task::hold{}), task::any(task::coast{})}) {
    auto it = multirotor();
    it.vehicle.set_task(task::go{{47.001, 8, 430}});
    it.run(25);
    it.vehicle.set_task(what);
    it.run(10);
    const auto stays = it.vehicle.where().where;
    EXPECT_FALSE(it.vehicle.is_moving());
    EXPECT_TRUE(it.vehicle.is_in_air());
    it.run(60);
    EXPECT_EQ(it.vehicle.where().where, stays);
  }
}

TEST(sim_flight, rest_in_the_air_falls) {
  auto it = multirotor();
  it.vehicle.set_task(task::climb{420});
  it.run(15);
  it.vehicle.set_task(task::rest{});
  EXPECT_TRUE(it.run_until_said("landed", 3));
}

TEST(sim_flight, the_same_task_again_does_not_begin_again) {
  auto it = rover();
  it.follow({waypoint(10, 0, 0, 10)});
  ASSERT_TRUE(it.run_until([&] { return it.from_home_m() > 8; }));
  const double arrival_s = static_cast<double>(it.now_ns) * 1e-9;
  for (int i = 0; i < 100; ++i) {
    it.vehicle.set_task(task::follow_mission{});
    it.run(0.15);
  }
  EXPECT_NEAR(it.time_of("reached 0") - arrival_s, 10, 0.3);
}

TEST(sim_flight, restart_leaves_it_on_the_ground_where_it_is_and_the_mission_idle) {
  auto it = multirotor();
  it.follow({waypoint(50, 0, 20)});
  it.run(15);
  const double from_home_m = it.from_home_m();
  it.vehicle.restart();
  it.run(5);
  EXPECT_EQ(it.vehicle.altitude_above_home_m(), 0);
  EXPECT_NEAR(it.from_home_m(), from_home_m, 1e-6);
  EXPECT_EQ(it.vehicle.mission().state(), run_state::idle);
  EXPECT_EQ(it.vehicle.mission().count(), 1);
  EXPECT_TRUE(std::holds_alternative<task::rest>(it.vehicle.current_task()));
}

TEST(sim_flight, at_rest_it_takes_no_steps_and_asks_for_none) {
  auto it = rover();
  EXPECT_EQ(it.vehicle.next_step_ns(), flight::never_ns);
  EXPECT_TRUE(it.vehicle.advance(3'600 * second_ns).empty());
  EXPECT_EQ(it.vehicle.steps(), 0U);
}

TEST(sim_flight, a_second_of_motion_is_50_steps) {
  auto it = rover();
  it.vehicle.set_task(task::go{moved(home, {0, 100})});
  it.run(1);
  const auto steps = it.vehicle.steps();
  (void)it.vehicle.advance(it.now_ns + second_ns);
  EXPECT_EQ(it.vehicle.steps() - steps, 50U);
}

TEST(sim_flight, what_a_vehicle_at_rest_is_told_takes_effect_when_time_goes_on_and_not_before) {
  auto it = rover();
  it.vehicle.set_task(task::go{moved(home, {0, 100})});
  it.now_ns = 3'600 * second_ns;
  (void)it.vehicle.advance(it.now_ns);
  EXPECT_LT(it.from_home_m(), 0.01);
  EXPECT_EQ(it.vehicle.next_step_ns(), it.now_ns + craft::step_ns);
}

TEST(sim_flight, after_its_mission_it_comes_to_rest) {
  for (auto it : {rover(), multirotor()}) {
    it.follow({waypoint(20, 10)});
    ASSERT_TRUE(it.run_until_said("completed"));
    EXPECT_TRUE(it.run_until([&] { return it.vehicle.next_step_ns() == flight::never_ns; }, 10));
  }
}

TEST(sim_flight, time_does_not_go_back) {
  auto it = rover();
  it.vehicle.set_task(task::go{moved(home, {0, 100})});
  it.run(5);
  const auto before = it.vehicle.where().where;
  EXPECT_TRUE(it.vehicle.advance(second_ns).empty());
  EXPECT_EQ(it.vehicle.where().where, before);
}

// Of every number that telemetry shows, to the bit.
std::vector<std::uint64_t> bits_of(const body& what) {
  std::vector<std::uint64_t> bits;
  for (const double each :
       {what.where.latitude_deg, what.where.longitude_deg, what.where.altitude_m, what.heading_deg,
        what.ground_speed_mps, what.track_deg, what.climb_mps, what.roll_rad, what.pitch_rad, what.throttle})
    bits.push_back(std::bit_cast<std::uint64_t>(each));
  return bits;
}

TEST(sim_flight, the_same_calls_at_the_same_times_give_the_same_bytes) {
  const auto fly = [] {
    auto it = multirotor();
    it.follow({at(nav_takeoff, 0, 0, 10), waypoint(30, 10, 15, 2), command(do_change_speed, 1, 8), waypoint(-50, 70),
               command(nav_return_to_launch)});
    std::vector<std::vector<std::uint64_t>> all;
    for (int i = 1; i <= 3'000; ++i) {
      it.run(0.01 * (i % 7)); // of many lengths
      all.push_back(bits_of(it.vehicle.where()));
    }
    EXPECT_EQ(it.said.back(), "completed");
    return std::pair(all, it.said);
  };
  EXPECT_EQ(fly(), fly());
}

// Whatever it is told and whenever: it stays on Earth, above the ground and within its speeds.
RC_GTEST_PROP(sim_flight, whatever_it_is_told_it_stays_a_vehicle, ()) {
  const bool flies = *rc::gen::arbitrary<bool>();
  auto it = flies ? multirotor() : rover();
  const plan items{
      at(nav_takeoff, 5, 0, 8), waypoint(20, 0, 5, 1), command(do_change_speed, 1, 12), at(31, 0, 0),
      waypoint(20, 30),         jump_to(1, 2),         held(waypoint(0, 30)),           at(nav_land, 0, 0, 0)};
  const int orders = *rc::gen::inRange(1, 15);
  for (int i = 0; i < orders; ++i) {
    auto& run = it.vehicle.mission();
    const auto place = moved({47, 8, 400.0 + *rc::gen::inRange(-20, 60)}, {*rc::gen::inRange(0, 360) * 1.0, 40});
    switch (*rc::gen::inRange(0, 12)) {
    case 0:
      it.vehicle.set_task(task::rest{});
      break;
    case 1:
      it.vehicle.set_task(task::hold{});
      break;
    case 2:
      it.vehicle.set_task(task::go{place, *rc::gen::inRange(0, 10) * 1.0});
      break;
    case 3:
      it.vehicle.set_task(task::climb{place.altitude_m});
      break;
    case 4:
      it.vehicle.set_task(task::land{});
      break;
    case 5:
      it.vehicle.set_task(task::come_back{});
      break;
    case 6:
      run.load(items);
      break;
    case 7:
      run.replace(items, 0, *rc::gen::inRange(0, 9));
      break;
    case 8:
      (void)run.set_current(*rc::gen::inRange(0, 9));
      break;
    case 9:
      it.vehicle.restart();
      break;
    default:
      it.follow(items, *rc::gen::inRange(0, static_cast<int>(items.size())));
    }
    it.run(*rc::gen::inRange(1, 300) / 10.0);
    const auto& body = it.vehicle.where();
    RC_ASSERT(it.from_home_m() < 2'000);
    RC_ASSERT(body.where.altitude_m >= home.altitude_m && body.where.altitude_m < home.altitude_m + 100);
    RC_ASSERT(body.ground_speed_mps >= 0 && body.ground_speed_mps < 20);
    RC_ASSERT(std::abs(body.roll_rad) < 1 && std::abs(body.pitch_rad) < 1);
    RC_ASSERT(flies || (!it.vehicle.is_in_air() && body.climb_mps == 0));
    RC_ASSERT(it.vehicle.is_in_air() || body.where.altitude_m < home.altitude_m + 0.2);
    RC_ASSERT(it.vehicle.is_in_air() || !flies || body.ground_speed_mps < 0.2);
  }
}

} // namespace flight_test
} // namespace godwit::sim::test
