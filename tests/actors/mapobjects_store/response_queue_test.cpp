#include "actors/mapobjects_store/response_queue.hpp"

#include <gtest/gtest.h>

namespace godwit::mapobjects_store {
namespace response_queue_test {

TEST(response_queue, answers_come_in_their_order_and_only_the_first_wakes) {
  response_queue box;
  ASSERT_TRUE(box.reserve() && box.reserve());
  EXPECT_TRUE(box.put({1, map_answer{}}));
  EXPECT_FALSE(box.put({2, map_answer{}}));
  EXPECT_EQ(box.take()->request_id, 1U);
  EXPECT_EQ(box.take()->request_id, 2U);
  EXPECT_FALSE(box.take());
}

TEST(response_queue, it_has_room_for_so_many_asks_and_each_answer_that_is_taken_makes_room) {
  response_queue box;
  for (std::size_t i = 0; i < response_queue::max_asks; ++i)
    ASSERT_TRUE(box.reserve());
  EXPECT_FALSE(box.reserve());
  box.give_back();
  EXPECT_TRUE(box.reserve());
  static_cast<void>(box.put({1, map_answer{}}));
  EXPECT_FALSE(box.reserve());
  static_cast<void>(box.take());
  EXPECT_TRUE(box.reserve());
}

} // namespace response_queue_test
} // namespace godwit::mapobjects_store
