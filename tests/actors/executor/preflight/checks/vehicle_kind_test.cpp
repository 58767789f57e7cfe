#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace vehicle_kind_test {

using namespace test;

using flight::vehicle_class;
using io::mavlink::mav_autopilot;

result with(vehicle_class what, mav_autopilot autopilot) {
  auto seen = good_facts();
  seen.vehicle.what = what;
  seen.vehicle.autopilot = autopilot;
  return check_vehicle_kind(seen, {});
}

TEST(vehicle_kind_check, passes_for_each_class_and_each_autopilot_that_is_known) {
  for (const auto what : {vehicle_class::multirotor, vehicle_class::fixed_wing, vehicle_class::rover})
    for (const auto autopilot : {mav_autopilot::px4, mav_autopilot::ardupilotmega, mav_autopilot::generic})
      EXPECT_EQ(with(what, autopilot).how, verdict::pass);
  EXPECT_EQ(with(vehicle_class::rover, mav_autopilot::px4).sentence, "The vehicle is a rover with the autopilot px4.");
}

TEST(vehicle_kind_check, fails_for_a_vehicle_of_no_known_class) {
  EXPECT_EQ(with(vehicle_class::unknown, mav_autopilot::px4).how, verdict::fail);
}

TEST(vehicle_kind_check, fails_for_what_is_no_autopilot_or_one_that_nobody_knows) {
  EXPECT_EQ(with(vehicle_class::rover, mav_autopilot::invalid).how, verdict::fail);
  const auto found = with(vehicle_class::rover, static_cast<mav_autopilot>(4));
  EXPECT_EQ(found.how, verdict::fail);
  EXPECT_TRUE(has(found.sentence, "number 4")) << found.sentence;
}

TEST(vehicle_kind_check, is_skipped_while_the_vehicle_is_not_heard) {
  auto seen = good_facts();
  seen.vehicle.link = vehicle_link::connection_phase::lost;
  EXPECT_EQ(check_vehicle_kind(seen, {}).how, verdict::skipped);
}

} // namespace vehicle_kind_test
} // namespace godwit::executor::preflight
