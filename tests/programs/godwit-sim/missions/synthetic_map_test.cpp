#include "programs/godwit-sim/missions/synthetic_map.hpp"

#include <utility>

#include <gtest/gtest.h>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/write.hpp"
#include "messages/mission/document.hpp"

namespace godwit::sim::missions {
namespace synthetic_map_test {

TEST(missions_synthetic_map, objects_are_those_of_their_seed_and_lie_around_their_place) {
  const map_request wanted{500, 47.4, 8.5};
  const auto first = synthetic_map(wanted, 7);
  EXPECT_EQ(first, synthetic_map(wanted, 7));
  EXPECT_NE(first, synthetic_map(wanted, 8));
  const mission::map_object_page page{std::string(mission::schema_version), first, {}};
  EXPECT_TRUE(mission::read<mission::map_object_page>(mission::to_text(page)));
  for (const auto& each : first) {
    EXPECT_NEAR(each.latitude, 47.4, 0.14);
    EXPECT_NEAR(each.longitude, 8.5, 0.21);
  }
}

TEST(missions_synthetic_map, a_map_at_the_end_of_the_world_is_one_too) {
  for (const auto& [latitude, longitude] : {std::pair{89.0, 180.0}, {-89.0, -180.0}, {0.0, 0.0}}) {
    const mission::map_object_page page{
        std::string(mission::schema_version), synthetic_map({200, latitude, longitude}, 1), {}};
    EXPECT_TRUE(mission::read<mission::map_object_page>(mission::to_text(page)));
  }
}

} // namespace synthetic_map_test
} // namespace godwit::sim::missions
