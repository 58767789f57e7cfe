#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace vehicle_link_test {

using namespace test;

using vehicle_link::connection_phase;

result with(connection_phase link) {
  auto seen = good_facts();
  seen.vehicle.link = link;
  return check_vehicle_link(seen, {});
}

TEST(vehicle_link_check, passes_when_the_vehicle_is_heard) {
  EXPECT_EQ(with(connection_phase::connected).how, verdict::pass);
}

TEST(vehicle_link_check, fails_in_every_other_phase_and_names_what_to_check) {
  EXPECT_EQ(with(connection_phase::down),
            fail("The link to the vehicle is not open; check the configured device or address."));
  EXPECT_EQ(with(connection_phase::silent).how, verdict::fail);
  EXPECT_EQ(with(connection_phase::lost).how, verdict::fail);
  EXPECT_NE(with(connection_phase::silent), with(connection_phase::lost));
}

TEST(vehicle_link_check, two_autopilots_on_the_line_fail_by_name_unless_one_is_chosen) {
  auto seen = good_facts();
  seen.vehicle.line.vehicle = vehicle_link::vehicle_name{1, 1};
  seen.vehicle.line.others = {{2, 1}};
  const auto verdict = check_vehicle_link(seen, {});
  EXPECT_EQ(verdict.how, verdict::fail);
  for (const char* part : {"system 1 and system 2", "vehicle.system"})
    EXPECT_NE(verdict.sentence.find(part), std::string::npos) << verdict.sentence;
  seen.vehicle.line.is_chosen = true;
  EXPECT_EQ(check_vehicle_link(seen, {}).how, verdict::pass);
}

TEST(vehicle_link_check, two_vehicles_under_one_name_fail_also_when_one_is_chosen) {
  auto seen = good_facts();
  seen.vehicle.line.is_chosen = true;
  seen.vehicle.line.twin = "Two vehicles speak as system 1.";
  EXPECT_EQ(check_vehicle_link(seen, {}), fail("Two vehicles speak as system 1."));
}

TEST(vehicle_link_check, a_vehicle_with_another_key_is_not_called_silent) {
  auto seen = good_facts();
  seen.vehicle.link = connection_phase::silent;
  seen.vehicle.link_reason = "frames are refused for their signature: it is signed with another key";
  const auto verdict = check_vehicle_link(seen, {});
  EXPECT_EQ(verdict.how, verdict::fail);
  EXPECT_NE(verdict.sentence.find("another key"), std::string::npos);
}

TEST(vehicle_link_check, names_what_is_heard_in_place_of_a_vehicle) {
  auto seen = good_facts();
  seen.vehicle.link = connection_phase::silent;
  seen.vehicle.link_reason =
      "no heartbeat of an autopilot yet; heard and not accepted: ground station 255/190 (12 heartbeats)";
  EXPECT_EQ(check_vehicle_link(seen, {}),
            fail("No autopilot is heard on the link; heard and not accepted: ground station 255/190 (12 heartbeats); "
                 "switch the vehicle on, and check the baud rate of the line."));
}

} // namespace vehicle_link_test
} // namespace godwit::executor::preflight
