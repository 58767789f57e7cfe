// Another vehicle of the same kind on the line.
#include <gtest/gtest.h>

#include "programs/godwit-drill/flight_simulation/flight_simulation.hpp"

namespace neighbour_test {

using namespace godwit;
using namespace godwit::drill;

TEST(neighbour, hears_what_goes_to_the_vehicle_and_does_nothing_of_it) {
  for (const auto who : {sim::personality::px4, sim::personality::ardupilot}) {
    flight_simulation flight({.who = who, .starts_by_itself = false, .speed = 1, .has_neighbour = true});
    ASSERT_NE(flight.neighbour(), nullptr);
    const auto before = flight.neighbour()->describe();
    flight.run_for(8);
    flight.person().arm();
    EXPECT_TRUE(flight.vehicle().describe().armed) << flight.story();
    const auto after = flight.neighbour()->describe();
    EXPECT_FALSE(after.armed);
    EXPECT_EQ(after.mode, before.mode);
    EXPECT_GT(after.world_ms, before.world_ms) << "it lives";
    EXPECT_NEAR(sim::between(flight.vehicle().describe().where, after.where).distance_m, 100, 1);
  }
}

} // namespace neighbour_test
