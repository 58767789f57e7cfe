#include "actors/executor/plan/fence_items.hpp"

#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"

namespace godwit::executor::plan {
namespace fence_items_test {

using io::mavlink::mav_cmd;
using io::mavlink::number;
using mission::fence_kind;
using mission::geofence;

geofence triangle(fence_kind kind) { return {kind, {{47, 8}, {47.001, 8}, {47, 8.001}}, {}, {}}; }

TEST(fence_items, a_polygon_is_one_item_for_each_corner_which_says_how_many_there_are) {
  const auto list = fence_items({triangle(fence_kind::inclusion), triangle(fence_kind::exclusion)});
  ASSERT_EQ(list.items.size(), 6U);
  EXPECT_TRUE(list.left_out.empty());
  EXPECT_EQ(list.items[0].command, number(mav_cmd::nav_fence_polygon_vertex_inclusion));
  EXPECT_EQ(list.items[5].command, number(mav_cmd::nav_fence_polygon_vertex_exclusion));
  EXPECT_EQ(list.items[4].x, 470'010'000);
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    EXPECT_EQ(list.items[i].seq, i);
    EXPECT_EQ(list.items[i].param1, 3);
  }
}

// PX4 and ArduPilot have to be inside of all of them at once, and the mission means one of them.
TEST(fence_items, several_inclusions_are_left_out_for_every_vehicle) {
  const std::vector fences{triangle(fence_kind::inclusion), triangle(fence_kind::inclusion),
                           triangle(fence_kind::exclusion)};
  const auto list = fence_items(fences);
  ASSERT_EQ(list.items.size(), 3U);
  EXPECT_EQ(list.items.front().command, number(mav_cmd::nav_fence_polygon_vertex_exclusion));
  EXPECT_EQ(list.left_out.size(), 1U);
}

TEST(fence_items, air_that_may_be_flown_through_is_not_closed) {
  auto above = triangle(fence_kind::exclusion);
  above.floor_m = 50;
  auto below = triangle(fence_kind::inclusion);
  below.ceiling_m = 80;
  const auto list = fence_items({above, below, above});
  ASSERT_EQ(list.items.size(), 3U) << "an inclusion without its ceiling is wider";
  EXPECT_EQ(list.items.front().command, number(mav_cmd::nav_fence_polygon_vertex_inclusion));
  EXPECT_EQ(list.left_out.size(), 1U) << "said once";
}

} // namespace fence_items_test
} // namespace godwit::executor::plan
