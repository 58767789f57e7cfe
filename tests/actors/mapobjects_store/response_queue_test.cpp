#include <gtest/gtest.h>

#include "actors/mapobjects_store/response_queue.hpp"

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

namespace answers_test {

TEST(answers, a_refusal_has_the_reason_for_people_and_for_the_program) {
  batch empty;
  empty.key = "k";
  const auto said = refusal(empty, {map_errc::full, "too many batches are open", "Deliver those first"});
  EXPECT_EQ(said.key, "k");
  EXPECT_EQ(said.failure, map_failure::busy);
  EXPECT_EQ(said.error, "map: too many batches are open. Deliver those first.");
}

TEST(answers, what_was_found_is_put_into_the_answer) {
  const auto put = [](moved_rows& answer, std::uint64_t rows) { answer.rows = rows; };
  const auto said = answer_from(moved_rows{}, map_result<std::uint64_t>(3), put);
  EXPECT_EQ(said.rows, 3U);
  EXPECT_EQ(said.failure, map_failure::none);
  EXPECT_TRUE(said.error.empty());
  const auto done = answer_from(map_answer{}, map_result<void>{}, [](map_answer&) {});
  EXPECT_EQ(done.failure, map_failure::none);
}

TEST(answers, what_asking_again_can_mend_is_busy_and_what_it_can_not_is_not) {
  EXPECT_EQ(failure_of(map_errc::disk), map_failure::busy);
  EXPECT_EQ(failure_of(map_errc::refused), map_failure::refused);
  EXPECT_EQ(failure_of(map_errc::load_given_up), map_failure::load_given_up);
  EXPECT_EQ(failure_of(map_errc::delivered), map_failure::delivered);
  for (const auto code : {map_errc::corrupt, map_errc::closed, map_errc::newer, map_errc::internal})
    EXPECT_EQ(failure_of(code), map_failure::broken);
}

} // namespace answers_test

} // namespace godwit::mapobjects_store
