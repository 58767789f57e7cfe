#include "programs/godwit-sim/vehicle/world/way.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "programs/godwit-sim/vehicle/world/angle.hpp"
#include "programs/godwit-sim/vehicle/world/nearby.hpp"

namespace godwit::sim::test {
namespace way_test {

RC_GTEST_PROP(sim_way, who_steps_along_it_arrives_from_anywhere, ()) {
  position here{*rc::gen::inRange(-89'000, 89'000) / 1e3, *rc::gen::inRange(-180'000, 180'000) / 1e3, 0};
  way home(moved(here, {*rc::gen::inRange(0, 360'000) / 1e3, 15'000}));
  int steps = 0;
  for (auto course = home.from(here); course.distance_m > 2; course = home.from(here)) {
    RC_ASSERT(++steps < 15'000 / 8);
    const double bearing_rad = course.bearing_deg * degree;
    const double step_m = std::min(10.0, course.distance_m);
    here = stepped(here, step_m * std::cos(bearing_rad), step_m * std::sin(bearing_rad));
  }
}

TEST(sim_way, far_away_an_answer_serves_for_a_second_of_steps) {
  const position start{47, 8, 0};
  way far(moved(start, {0, 50'000}));
  const double first_m = far.from(start).distance_m;
  position here = start;
  int answers = 1;
  for (; far.from(here).distance_m == first_m; ++answers)
    here = stepped(here, 1, 0);
  EXPECT_EQ(answers, 50);
}

} // namespace way_test
} // namespace godwit::sim::test
