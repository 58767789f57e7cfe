// Whole flights of a VTOL's mission: up on its rotors, on its wings, hovering in between, down on its rotors.
#include <gtest/gtest.h>

#include "programs/godwit-sim/vehicle/world/position.hpp"
#include "tests/actors/executor/command_samples.hpp"
#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace vtol_flight_test {

using command_samples::act;
using command_samples::at_place;
using mission::progress_kind;
using sim::personality;
using tests::flight_world;

constexpr std::uint16_t vtol_takeoff = 84;
constexpr std::uint16_t vtol_land = 85;
constexpr std::uint16_t transition = 3000;

mission::document there_and_back(personality who) {
  auto result = tests::short_mission(who);
  result.schema_version = mission::schema_version_2;
  const auto far = [&](const char* id, double north_m, double east_m) {
    return tests::place(personality::plane, id, north_m, east_m);
  };
  result.items = {at_place("up", vtol_takeoff, tests::place(who, "", 0, 0)),
                  far("out", 100, 0),
                  act("hover", transition, 3),
                  far("look", 100, 40),
                  act("fly", transition, 4),
                  far("back", 0, 100),
                  at_place("down", vtol_land, tests::place(who, "", 0, 0))};
  return result;
}

TEST(vtol_flight, a_mission_on_rotors_and_wings_is_flown_and_reported_to_its_end) {
  for (const auto who : {personality::px4_vtol, personality::quadplane}) {
    flight_world world({.who = who});
    world.load(there_and_back(who));
    ASSERT_TRUE(world.run_until_phase(phase::done, 900)) << io::name_of(who) << world.story();
    for (const auto* const id : {"up", "out", "look", "back", "down"})
      EXPECT_TRUE(tests::is_told(world, progress_kind::reached, id)) << io::name_of(who) << id << world.story();
    for (const auto* const id : {"hover", "fly"})
      EXPECT_TRUE(tests::is_told(world, progress_kind::passed, id)) << io::name_of(who) << id << world.story();
    EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << io::name_of(who) << world.story();
    const auto seen = world.vehicle().describe();
    EXPECT_FALSE(seen.armed || seen.in_air) << io::name_of(who) << world.story();
    EXPECT_LT(between(seen.where, sim::vehicle_settings{}.home).distance_m, 3);
  }
}

} // namespace vtol_flight_test
} // namespace godwit::executor
