// The plan and the preflight report over HTTP, from whoever has them.
#include "programs/godwitd/operator_port/view_handler.hpp"

#include <gtest/gtest.h>

#include "tests/programs/godwitd/operator_port/api_world.hpp"

namespace view_handler_test {

using namespace godwit;
using namespace godwit::operator_port;

TEST(view_handler, anybody_who_may_look_sees_the_plan_and_what_the_checks_have_found) {
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

TEST(view_handler, objects_of_the_map_are_asked_for_by_the_part_that_is_looked_at) {
  tests::api_world world;
  const auto all = world.ask("GET", "/api/v1/map/objects");
  ASSERT_EQ(all.status, 200U) << all.body;
  EXPECT_EQ(all.body.at("counted"), 1);
  const auto& object = all.body.at("objects").at(0);
  EXPECT_EQ(object.at("class_group"), "person");
  EXPECT_EQ(object.at("last_seen_ms"), 1'795'459'713'049);
  EXPECT_EQ(object.at("is_seen_here"), true);
  EXPECT_EQ(world.ask("GET", "/api/v1/map/objects?bbox=8.4,47.3,8.6,47.5&limit=20").status, 200U);
  ASSERT_EQ(world.looked_at.size(), 2U);
  EXPECT_EQ(world.looked_at[0].limit, mapobjects_store::max_shown_objects);
  const auto& asked = world.looked_at[1];
  EXPECT_EQ(asked.limit, 20U);
  EXPECT_EQ(asked.within.west_deg, 8.4);
  EXPECT_EQ(asked.within.south_deg, 47.3);
  EXPECT_EQ(asked.within.east_deg, 8.6);
  EXPECT_EQ(asked.within.north_deg, 47.5);
}

TEST(view_handler, a_map_that_can_not_be_looked_at_is_said_with_the_reason) {
  tests::api_world world;
  world.objects.failure = mapobjects_store::map_failure::broken;
  world.objects.error = "the file is damaged";
  const auto answer = world.ask("GET", "/api/v1/map/objects");
  EXPECT_EQ(answer.status, 503U);
  EXPECT_NE(answer.body.at("detail").get<std::string>().find("the file is damaged"), std::string::npos);
}

TEST(view_handler, a_part_of_the_map_that_is_none_is_refused) {
  for (const auto* query : {"bbox=1,2,3", "bbox=1,2,3,4,5", "bbox=1,5,3,4", "bbox=-181,0,0,1", "bbox=0,-91,1,1",
                            "bbox=nan,0,1,1", "bbox=1e999,0,1,1", "bbox=a,b,c,d", "bbox=1,2,3,", "limit=0", "limit=-1",
                            "limit=many", "limit=99999999999999", "box=1,2,3,4", "bbox"})
    EXPECT_FALSE(read_objects_query("/api/v1/map/objects?" + std::string(query))) << query;
  const auto across = read_objects_query("/api/v1/map/objects?bbox=179,-10,-179,10");
  ASSERT_TRUE(across);
  EXPECT_GT(across->within.west_deg, across->within.east_deg);
  EXPECT_TRUE(read_objects_query("/api/v1/map/objects?"));
}

} // namespace view_handler_test
