#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace on_ground_test {

using namespace test;

TEST(on_ground_check, passes_while_the_vehicle_stands) {
  EXPECT_EQ(check_on_ground(good_facts(), {}).how, verdict::pass);
}

TEST(on_ground_check, fails_while_somebody_else_flies_it) {
  auto seen = good_facts();
  seen.vehicle.is_moving = true;
  EXPECT_EQ(check_on_ground(seen, {}).how, verdict::fail);
}

TEST(on_ground_check, says_what_to_do_about_a_vehicle_that_stands_armed_in_its_mission_mode) {
  auto seen = good_facts();
  seen.vehicle.is_moving = true;
  seen.vehicle.stands_ready_to_move = true;
  const auto found = check_on_ground(seen, {});
  EXPECT_EQ(found.how, verdict::fail);
  EXPECT_NE(found.sentence.find("disarm it"), std::string::npos) << found.sentence;
}

TEST(on_ground_check, is_skipped_while_the_vehicle_is_not_heard) {
  auto seen = good_facts();
  seen.vehicle.link = vehicle_link::connection_phase::lost;
  EXPECT_EQ(check_on_ground(seen, {}).how, verdict::skipped);
}

} // namespace on_ground_test
} // namespace godwit::executor::preflight
