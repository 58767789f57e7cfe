// What people are told of other aircraft in a flight, and that nothing is flown or refused by it.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"
#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace traffic_flight_test {

using io::mavlink::adsb_flag;
using operators::command_kind;
using sim::personality;
using tests::flight_world;

// From 3 km to the south of home straight over it, at 30 m/s and 50 m above.
io::mavlink::adsb_vehicle passing(double after_s) {
  constexpr double metres_of_latitude = 111'200;
  io::mavlink::adsb_vehicle result;
  result.icao_address = 0x4B1234;
  result.lat = static_cast<std::int32_t>((47.397742 + (30 * after_s - 3'000) / metres_of_latitude) * 1e7);
  result.lon = 85'455'940;
  result.altitude = 538'000;
  result.heading = 0;
  result.hor_velocity = 3'000;
  result.flags = io::mavlink::number(adsb_flag::valid_coords) | io::mavlink::number(adsb_flag::valid_altitude) |
                 io::mavlink::number(adsb_flag::valid_heading) | io::mavlink::number(adsb_flag::valid_velocity);
  return result;
}

// Each second for so long.
void pass(flight_world& world, double from_s, double to_s) {
  for (double t = from_s; t < to_s; ++t) {
    world.vehicle_tells(passing(t));
    world.run_for(1);
  }
}

int said(const flight_world& world, std::string_view words) {
  return static_cast<int>(std::ranges::count_if(
      world.said(), [&](const std::string& each) { return each.find(words) != std::string::npos; }));
}

mission::document waiting_mission(personality who) {
  auto result = tests::short_mission(who);
  std::get<mission::waypoint>(result.items.at(sim::drives(who) ? 0 : 1)).hold_s = 250;
  return result;
}

class traffic_flight : public testing::TestWithParam<personality> {};

TEST_P(traffic_flight, an_aircraft_that_passes_is_told_of_once_as_it_comes_and_once_when_it_has_passed) {
  flight_world world({.who = GetParam(), .speed = 1});
  world.load(waiting_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::flying, 120)) << world.story();
  pass(world, 0, 6);
  EXPECT_EQ(said(world, "aircraft close: "), 0) << "it is not within the time yet";
  pass(world, 6, 100);
  EXPECT_EQ(said(world, "aircraft close: ICAO 4B1234, "), 1) << world.story();
  EXPECT_EQ(said(world, "close no more"), 0);
  pass(world, 100, 160);
  EXPECT_EQ(said(world, "aircraft close: "), 1) << world.story();
  EXPECT_EQ(said(world, "aircraft ICAO 4B1234 is close no more"), 1) << world.story();
}

// So far to the north of home, and nothing else of it is known.
io::mavlink::adsb_vehicle beacon(std::uint32_t icao, double north_m) {
  auto result = passing((3'000 + north_m) / 30);
  result.icao_address = icao;
  result.flags = io::mavlink::number(adsb_flag::valid_coords);
  return result;
}

TEST_P(traffic_flight, an_aircraft_that_flies_along_the_limit_is_told_of_once) {
  flight_world world({.who = GetParam(), .speed = 1});
  world.load(waiting_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::flying, 120)) << world.story();
  for (int t = 0; t < 120; ++t) {
    world.vehicle_tells(beacon(0xA, t / 10 % 2 == 0 ? 800 : 1'300));
    world.run_for(1);
  }
  EXPECT_EQ(said(world, "aircraft close: "), 1) << world.story();
  EXPECT_EQ(said(world, "close no more"), 0) << world.story();
}

TEST_P(traffic_flight, of_a_crowd_the_nearest_are_told_of) {
  flight_world world({.who = GetParam(), .speed = 1});
  world.load(waiting_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::flying, 120)) << world.story();
  for (std::uint32_t i = 20; i >= 1; --i)
    world.vehicle_tells(beacon(i, 900 - i * 20.0));
  world.run_for(3);
  EXPECT_EQ(said(world, "aircraft close: "), static_cast<int>(traffic_watch::max_told)) << world.story();
  EXPECT_EQ(said(world, "aircraft close: ICAO 000014, "), 1) << "the nearest";
  EXPECT_EQ(said(world, "aircraft close: ICAO 000001, "), 0) << "the farthest";
}

TEST_P(traffic_flight, nothing_is_refused_or_flown_by_other_aircraft_alone) {
  const auto fly = [](bool has_traffic) {
    auto world = std::make_unique<flight_world>(flight_world::options{.who = GetParam(), .speed = 1});
    world->load(tests::short_mission(GetParam()));
    for (double t = 80; world->durable().status.now != phase::done && t < 600; ++t) {
      if (has_traffic) {
        world->vehicle_tells(passing(80 + std::fmod(t, 40))); // close from the beginning to the end
        world->vehicle_tells(io::mavlink::collision{.id = 0x4B1234, .action = 5, .threat_level = 2});
      }
      world->run_for(1);
    }
    return world;
  };
  const auto alone = fly(false);
  const auto among = fly(true);
  ASSERT_EQ(among->durable().status.now, phase::done) << among->story();
  EXPECT_EQ(said(*among, "aircraft close: "), 1) << among->story();
  EXPECT_EQ(said(*among, "the autopilot warns of a collision with ICAO 4B1234"), 1) << among->story();
  EXPECT_EQ(among->commands(), alone->commands());
  EXPECT_EQ(among->orders(), alone->orders());
  EXPECT_EQ(among->now_ns(), alone->now_ns()) << "it was done in the same second";
  EXPECT_TRUE(among->reactions().empty());
  ASSERT_EQ(among->reports().size(), alone->reports().size());
}

TEST_P(traffic_flight, before_a_start_it_is_said_by_the_preflight_checks_and_keeps_nobody_from_it) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
  EXPECT_EQ(world.found("traffic").how, preflight::verdict::skipped);
  pass(world, 60, 64);
  const auto found = world.found("traffic");
  EXPECT_EQ(found.how, preflight::verdict::pass);
  EXPECT_NE(found.sentence.find("ICAO 4B1234, 1.1 km to the south, 50 m higher, closest in"), std::string::npos)
      << found.sentence;
  EXPECT_EQ(said(world, "aircraft close: "), 0) << "nobody is told while it is not armed";
  EXPECT_TRUE(world.say(command_kind::start).is_taken);
  EXPECT_TRUE(world.run_until_phase(phase::flying, 60)) << world.story();
}

TEST_P(traffic_flight, who_sends_the_vehicle_near_the_way_of_another_aircraft_is_told_with_the_answer) {
  flight_world world({.who = GetParam(), .speed = 1, .has_service = false});
  world.load(waiting_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::flying, 120)) << world.story();
  world.run_for(20);
  operators::command there;
  there.kind = command_kind::go_to;
  there.place = std::get<mission::waypoint>(tests::place(GetParam(), "there", 100, 100)).at;
  const auto alone = world.say(there);
  ASSERT_TRUE(alone.is_taken) << alone.reason;
  EXPECT_EQ(alone.advice, "");
  world.run_for(60);
  world.vehicle_tells(passing(70));
  const auto among = world.say(there);
  ASSERT_TRUE(among.is_taken) << among.reason;
  EXPECT_NE(among.advice.find("near the way there: ICAO 4B1234, "), std::string::npos) << among.advice;
}

TEST_P(traffic_flight, what_a_crash_has_forgotten_is_heard_again) {
  flight_world world({.who = GetParam(), .speed = 1});
  world.load(waiting_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::flying, 120)) << world.story();
  pass(world, 60, 62);
  world.crash();
  EXPECT_TRUE(world.traffic().aircraft.empty());
  pass(world, 62, 64);
  ASSERT_EQ(world.traffic().aircraft.size(), 1U);
  EXPECT_TRUE(world.traffic().aircraft[0].is_close);
}

INSTANTIATE_TEST_SUITE_P(hovering_and_driving, traffic_flight,
                         testing::Values(personality::px4, personality::ardupilot, personality::rover),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

} // namespace traffic_flight_test
} // namespace godwit::executor
