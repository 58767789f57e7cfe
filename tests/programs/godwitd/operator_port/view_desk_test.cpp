// The plan and the preflight report over HTTP, from whoever has them.
#include "programs/godwitd/operator_port/view_desk.hpp"

#include <gtest/gtest.h>

#include "tests/programs/godwitd/operator_port/api_world.hpp"

namespace {

using namespace godwit;
using namespace godwit::operator_port;

TEST(view_desk, anybody_who_may_look_sees_the_plan_and_what_the_checks_have_found) {
  tests::api_world world;
  const auto plan = world.ask("GET", "/api/v1/plan");
  ASSERT_EQ(plan.status, 200U);
  EXPECT_EQ(plan.body.at("mission").at("mission_id"), "m");
  EXPECT_EQ(plan.body.at("mission").at("items").at(0).at("kind"), "waypoint");
  EXPECT_TRUE(plan.body.at("home").is_null());
  const auto preflight = world.ask("GET", "/api/v1/preflight");
  ASSERT_EQ(preflight.status, 200U);
  EXPECT_EQ(preflight.body.at("findings").at(0).at("sentence"), "Charge it.");
  EXPECT_TRUE(world.obeyed.empty());
  EXPECT_EQ(world.rows(), 0U);
}

} // namespace
