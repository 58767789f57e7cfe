// A fence that is none is refused: by our server at the item that makes it none, by PX4 at the first vertex of a
// polygon of two, by ArduPilot at its end. The fence that was held stays.
#include "actors/ground_port/mission_server/server.hpp"

#include <gtest/gtest.h>

#include "tests/actors/ground_port/mission_server/plan_types.hpp"
#include "tests/actors/ground_port/mission_server/server_fixture.hpp"

namespace godwit::ground_port::mission_server::test {
namespace server_fence_test {

using mavlink::mav_cmd;
using mavlink::number;

using words = dialogue::words;

mavlink::mission_item_int vertex(int seq, float vertices) {
  auto result = waypoint(seq, fence);
  result.command = number(mav_cmd::nav_fence_polygon_vertex_inclusion);
  result.param1 = vertices;
  return result;
}

mavlink::mission_item_int circle(int seq, float radius_m) {
  auto result = waypoint(seq, fence);
  result.param1 = radius_m;
  return result;
}

// What the vehicle says to each item until it ends the upload.
words answers_to(dialogue& with, const std::vector<mavlink::mission_item_int>& items) {
  words result;
  (void)with.tell(count_of(static_cast<int>(items.size()), fence));
  for (const auto& each : items)
    if (with.vehicle().is_receiving())
      result.push_back(with.tell(each).at(0));
  return result;
}

TEST(server_fence, a_polygon_of_two_vertices_is_refused_at_its_first_or_at_its_end) {
  const std::vector two{vertex(0, 2), vertex(1, 2)};
  dialogue plain(plain_profile());
  EXPECT_EQ(answers_to(plain, two), words{"ACK invalid_param1 type 1"});
  EXPECT_EQ(plain.texts(), words{"Fence: item 0: no polygon and no circle"});
  dialogue px4(px4_profile());
  EXPECT_EQ(answers_to(px4, two), words{"ACK error type 1"});
  dialogue ardupilot(ardupilot_copter_profile());
  EXPECT_EQ(answers_to(ardupilot, two), (words{"REQUEST 1 type 1", "ACK error type 1"}));
}

TEST(server_fence, a_polygon_of_three_is_taken_by_all) {
  for (const auto& vehicle : {plain_profile(), px4_profile(), ardupilot_rover_profile()}) {
    dialogue with(vehicle);
    EXPECT_EQ(answers_to(with, {vertex(0, 3), vertex(1, 3), vertex(2, 3)}).back(), "ACK accepted type 1");
  }
}

TEST(server_fence, polygons_that_do_not_add_up_are_refused_at_the_item_or_at_the_end) {
  const std::vector mixed{vertex(0, 3), vertex(1, 3), vertex(2, 4), circle(3, 5)};
  dialogue plain(plain_profile());
  EXPECT_EQ(answers_to(plain, mixed),
            (words{"REQUEST_INT 1 type 1", "REQUEST_INT 2 type 1", "ACK invalid_param1 type 1"}));
  dialogue ardupilot(ardupilot_copter_profile());
  EXPECT_EQ(answers_to(ardupilot, mixed).back(), "ACK error type 1");
}

TEST(server_fence, a_circle_without_a_radius_is_refused) {
  dialogue plain(plain_profile());
  EXPECT_EQ(answers_to(plain, {circle(0, 0)}), words{"ACK invalid_param1 type 1"});
}

TEST(server_fence, the_old_fence_is_held_until_the_new_one_is_one) {
  for (const auto& vehicle : {plain_profile(), px4_profile(), ardupilot_rover_profile()}) {
    dialogue with(vehicle);
    (void)answers_to(with, {circle(0, 7)});
    (void)answers_to(with, {vertex(0, 2), vertex(1, 2)});
    EXPECT_TRUE(with.vehicle().is_idle());
    ASSERT_EQ(with.held(fence).items.size(), 1U);
    EXPECT_EQ(with.held(fence).items[0].param1, 7.0F);
    EXPECT_EQ(with.changes().size(), 1U);
  }
}

} // namespace server_fence_test
} // namespace godwit::ground_port::mission_server::test
