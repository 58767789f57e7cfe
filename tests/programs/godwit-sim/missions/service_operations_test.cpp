#include "programs/godwit-sim/missions/service_operations.hpp"

#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/missions/missions_fixture.hpp"

namespace godwit::sim::missions {
namespace service_operations_test {

TEST(missions_service_operations, an_assignment_must_fit_its_mission_unless_it_is_meant_to_be_stale) {
  judged_service service;
  auto& file = service.file();
  const std::vector<mission::item> items{mission::return_home{"h"}};
  EXPECT_FALSE(service_operations::assign(file, uuid(1), {items, {}, {}, {}, {}}, 1));
  EXPECT_FALSE(service_operations::assign(file, mission_id, {items, "w9", {}, {}, {}}, 1));
  EXPECT_FALSE(service_operations::assign(file, mission_id, {{waypoint("up")}, "w1", {}, {}, {}}, 1));
  EXPECT_FALSE(service_operations::assign(file, mission_id, {items, {}, {}, {}, 2}, 1)); // a revision that there was
  const auto stale = service_operations::assign(file, mission_id, {items, "w9", {}, 1, {}}, 1);
  ASSERT_TRUE(stale) << stale.error();
  EXPECT_EQ(stale->base_revision, 1);
  EXPECT_EQ(stale->revision, 3);
  EXPECT_EQ(service_operations::assign(file, mission_id, {items, "w1", {}, {}, {}}, 1)->revision, 4);
}

TEST(missions_service_operations, what_is_refused_has_changed_nothing) {
  judged_service service;
  auto& file = service.file();
  EXPECT_FALSE(service_operations::add_mission(file, small_mission()));
  EXPECT_FALSE(service_operations::delete_mission(file, uuid(1), 0));
  EXPECT_FALSE(service_operations::set_map_objects(file, mission_id, {map_object(1), map_object(1)}));
  EXPECT_FALSE(service_operations::set_map_objects(file, uuid(1), {map_object(1)}));
  auto broken = small_mission();
  broken.mission_id = uuid(5);
  broken.items.clear();
  EXPECT_FALSE(service_operations::add_mission(file, broken));
  EXPECT_EQ(service.ask(get("/mapobjects")).body, R"({"schema_version":"1.0.0","map_objects":[]})");
}

} // namespace service_operations_test
} // namespace godwit::sim::missions
