#include "actors/ground_port/mission_server/fence_check.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace godwit::ground_port::mission_server {
namespace fence_check_test {

using mavlink::mav_cmd;
using mavlink::number;

constexpr auto inclusion = mav_cmd::nav_fence_polygon_vertex_inclusion;
constexpr auto exclusion = mav_cmd::nav_fence_polygon_vertex_exclusion;
constexpr auto circle = mav_cmd::nav_fence_circle_exclusion;
constexpr auto return_point = mav_cmd::nav_fence_return_point;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

struct part {
  mav_cmd command{};
  float param1 = 0;
};

// The first item that is not taken; as many as there are: all are.
std::size_t fault_in(const std::vector<part>& fence, const fence_quirks& vehicle = {}) {
  fence_check check(vehicle, static_cast<int>(fence.size()));
  for (std::size_t i = 0; i < fence.size(); ++i) {
    mavlink::mission_item_int item;
    item.command = number(fence[i].command);
    item.param1 = fence[i].param1;
    if (!check.takes(item))
      return i;
  }
  return fence.size();
}

TEST(fence_check, takes_polygons_circles_and_a_return_point_one_after_the_other) {
  EXPECT_EQ(fault_in({{inclusion, 3}, {inclusion, 3}, {inclusion, 3}}), 3U);
  EXPECT_EQ(fault_in({{circle, 0.5F},
                      {exclusion, 3},
                      {exclusion, 3},
                      {exclusion, 3},
                      {inclusion, 4},
                      {inclusion, 4},
                      {inclusion, 4},
                      {inclusion, 4},
                      {return_point, 0}}),
            9U);
}

TEST(fence_check, a_polygon_has_three_vertices_at_least) {
  EXPECT_EQ(fault_in({{inclusion, 2}, {inclusion, 2}}), 0U);
  EXPECT_EQ(fault_in({{circle, 5}, {inclusion, 0}}), 1U);
}

TEST(fence_check, a_polygon_has_as_many_vertices_as_it_says) {
  EXPECT_EQ(fault_in({{inclusion, 4}, {inclusion, 4}, {inclusion, 4}}), 0U) << "more than there are items";
  EXPECT_EQ(fault_in({{inclusion, 3}, {inclusion, 3}, {inclusion, 4}, {circle, 1}}), 2U);
  EXPECT_EQ(fault_in({{inclusion, 3}, {inclusion, 3}, {exclusion, 3}}), 2U);
  EXPECT_EQ(fault_in({{inclusion, 3}, {inclusion, 3}, {circle, 3}}), 2U);
}

TEST(fence_check, a_number_of_vertices_is_a_whole_number) {
  for (const float vertices : {nan, infinity, -infinity, -3.0F, 3.5F})
    EXPECT_EQ(fault_in({{inclusion, vertices}, {inclusion, 3}, {inclusion, 3}, {inclusion, 3}}), 0U) << vertices;
}

TEST(fence_check, a_circle_has_a_radius) {
  for (const float radius : {0.0F, -1.0F, nan, infinity})
    EXPECT_EQ(fault_in({{circle, radius}}), 0U) << radius;
}

TEST(fence_check, px4_counts_vertices_and_looks_at_nothing_else) {
  const auto px4 = px4_quirks().fence;
  EXPECT_EQ(fault_in({{inclusion, 2}, {inclusion, 2}}, px4), 0U);
  EXPECT_EQ(fault_in({{inclusion, nan}}, px4), 0U);
  EXPECT_EQ(fault_in({{inclusion, 5}, {exclusion, 3}, {circle, -1}}, px4), 3U);
}

} // namespace fence_check_test
} // namespace godwit::ground_port::mission_server
