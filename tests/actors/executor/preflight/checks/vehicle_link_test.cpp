#include "actors/executor/preflight/checks/vehicle_link.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace vehicle_link_test {

using namespace test;

using vehicle_link::connection_phase;

result with(connection_phase link) {
  auto seen = good_facts();
  seen.vehicle.link = link;
  return look_at_vehicle_link(seen, {});
}

TEST(vehicle_link_check, passes_when_the_vehicle_is_heard) {
  EXPECT_EQ(with(connection_phase::connected).how, verdict::pass);
}

TEST(vehicle_link_check, fails_in_every_other_phase_and_says_what_to_look_at) {
  EXPECT_EQ(with(connection_phase::down),
            fail("The link to the vehicle is not open; look at the device or address that "
                 "it is set to."));
  EXPECT_EQ(with(connection_phase::silent).how, verdict::fail);
  EXPECT_EQ(with(connection_phase::lost).how, verdict::fail);
  EXPECT_NE(with(connection_phase::silent), with(connection_phase::lost));
}

TEST(vehicle_link_check, a_vehicle_with_another_key_is_not_called_silent) {
  auto seen = good_facts();
  seen.vehicle.link = connection_phase::silent;
  seen.vehicle.link_reason = "frames are refused for their signature: it is signed with another key";
  const auto verdict = look_at_vehicle_link(seen, {});
  EXPECT_EQ(verdict.how, verdict::fail);
  EXPECT_NE(verdict.sentence.find("another key"), std::string::npos);
}

} // namespace vehicle_link_test
} // namespace godwit::executor::preflight
