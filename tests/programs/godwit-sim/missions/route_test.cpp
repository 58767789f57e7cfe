#include "programs/godwit-sim/missions/route.hpp"

#include <gtest/gtest.h>

#include "actors/domain/mission/read.hpp"
#include "tests/programs/godwit-sim/missions/missions_fixture.hpp"

namespace godwit::sim::missions {
namespace route_test {

TEST(missions_route, each_call_of_the_contract_is_known) {
  const struct {
    const char* method;
    std::string rest;
    endpoint where;
  } calls[] = {
      {"GET", "", endpoint::get_mission},
      {"DELETE", "", endpoint::delete_mission},
      {"GET", "/mapobjects", endpoint::get_map_objects},
      {"POST", "/mapobjects", endpoint::post_map_objects},
      {"GET", "/mapobjects/ignored", endpoint::get_ignored},
      {"POST", "/mapobjects/ignored", endpoint::post_ignored},
      {"POST", "/pictures", endpoint::post_picture},
      {"POST", "/waypoints", endpoint::post_waypoints},
      {"POST", "/tail", endpoint::post_tail},
      {"GET", "/progress", endpoint::get_progress},
      {"POST", "/progress", endpoint::post_progress},
      {"GET", "/assignments?after=1", endpoint::get_assignments},
      {"POST", "/assignments/" + uuid(1) + "/response", endpoint::post_response},
  };
  for (const auto& each : calls) {
    const auto found = route_of(each.method, target(each.rest));
    ASSERT_TRUE(found) << each.method << each.rest << found.error().sentence;
    EXPECT_EQ(found->where, each.where);
    EXPECT_EQ(found->mission_id, mission_id);
    EXPECT_EQ(found->path, target(each.rest.substr(0, each.rest.find('?'))));
  }
}

TEST(missions_route, the_next_mission_is_asked_for_by_the_vehicles_name) {
  const auto found = route_of("GET", "/vehicles/bird%2D1/missions/next?wait_s=5").value();
  EXPECT_EQ(found.where, endpoint::get_next);
  EXPECT_EQ(found.vehicle_id, "bird-1");
  EXPECT_EQ(found.wait_s, 5U);
  EXPECT_EQ(route_of("POST", "/vehicles/a/missions/next").error().status, 405U);
  EXPECT_EQ(route_of("GET", "/vehicles/a/missions/next?after=1").error().status, 400U);
  for (const auto* path : {"/vehicles//missions/next", "/vehicles/a/b/missions/next", "/vehicles/a/missions"})
    EXPECT_EQ(route_of("GET", path).error().status, 404U) << path;
}

TEST(missions_route, parameters_are_read_and_have_defaults) {
  const auto page = route_of("GET", target("/mapobjects?limit=17&next=a%2Bb%20")).value();
  EXPECT_EQ(page.limit, 17U);
  EXPECT_EQ(page.next, "a+b ");
  EXPECT_EQ(route_of("GET", target("/mapobjects"))->limit, 1000U);
  const auto poll = route_of("GET", target("/assignments?wait_s=5&after=12")).value();
  EXPECT_EQ(poll.after, 12);
  EXPECT_EQ(poll.wait_s, 5U);
  EXPECT_EQ(route_of("GET", target("/assignments?after=12"))->wait_s, 30U);
}

TEST(missions_route, what_is_not_understood_is_refused_with_the_reason) {
  const struct {
    const char* method;
    std::string target;
    unsigned status;
    const char* part;
  } mistakes[] = {
      {"GET", "", 404, "There is nothing"},
      {"GET", "/", 404, "There is nothing"},
      {"GET", "/missions", 404, "There is nothing"},
      {"GET", target("/mapobjects/"), 404, "There is nothing"},
      {"GET", target("/assignments//response"), 404, "There is nothing"},
      {"GET", "/missions/..", 400, "no id of a mission"},
      {"GET", "/missions/7D1C1F0E-6B0C-4C55-9D0D-2F6D3C8B1A42", 400, "no id of a mission"},
      {"POST", target("/assignments/x/response"), 400, "no id of an assignment"},
      {"PATCH", target(), 405, "possible: GET, DELETE"},
      {"GET", target("/mapobjects?limit=0"), 400, "from 1 to 2000"},
      {"GET", target("/mapobjects?limit=2001"), 400, "from 1 to 2000"},
      {"GET", target("/mapobjects?limit=1e3"), 400, "from 1 to 2000"},
      {"GET", target("/mapobjects?limit="), 400, "from 1 to 2000"},
      {"GET", target("/mapobjects?next="), 400, "as it was"},
      {"GET", target("/mapobjects?next=%2"), 400, "percent-encoded"},
      {"GET", target("/mapobjects?page=2"), 400, "no parameter \"page\""},
      {"GET", target("?limit=1"), 400, "no parameter \"limit\""},
      {"GET", target("/assignments"), 400, "after is missing"},
      {"GET", target("/assignments?after=0"), 400, "from 1 to"},
      {"GET", target("/assignments?after=1&wait_s=61"), 400, "from 0 to 60"},
  };
  for (const auto& each : mistakes) {
    const auto found = route_of(each.method, each.target);
    ASSERT_FALSE(found) << each.target;
    EXPECT_EQ(found.error().status, each.status) << each.target;
    EXPECT_NE(found.error().sentence.find(each.part), std::string::npos) << found.error().sentence;
  }
}

TEST(missions_route, a_body_may_be_as_large_as_its_document) {
  EXPECT_EQ(max_body_bytes("POST", target("/tail")), mission::max_mission_bytes);
  EXPECT_EQ(max_body_bytes("POST", target("/mapobjects")), mission::max_batch_bytes);
  EXPECT_EQ(max_body_bytes("POST", target("/waypoints")), mission::max_answer_bytes);
  EXPECT_EQ(max_body_bytes("GET", target()), 0U);
}

} // namespace route_test
} // namespace godwit::sim::missions
