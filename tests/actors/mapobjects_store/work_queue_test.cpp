#include "actors/mapobjects_store/work_queue.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace godwit::mapobjects_store {
namespace {

queued_work some_change() {
  return queued_change{.work = [](map_tables&) -> map_result<void> { return {}; }, .done = [](const auto&) {}};
}

TEST(work_queue, it_takes_up_to_its_bound_until_something_is_finished) {
  work_queue queue(2);
  EXPECT_TRUE(queue.push(some_change()));
  EXPECT_TRUE(queue.push(some_change()));
  EXPECT_EQ(queue.push(some_change()).error().code, map_errc::full);
  std::deque<queued_work> taken;
  EXPECT_FALSE(queue.take(taken, std::nullopt));
  EXPECT_EQ(taken.size(), 2U);
  EXPECT_EQ(queue.push(some_change()).error().code, map_errc::full); // taken is not finished
  queue.finished(1);
  EXPECT_TRUE(queue.push(some_change()));
  EXPECT_EQ(queue.size(), 2U);
}

TEST(work_queue, arrivals_are_seen_until_they_are_taken) {
  work_queue queue(2);
  EXPECT_FALSE(queue.has_arrivals());
  ASSERT_TRUE(queue.push(some_change()));
  EXPECT_TRUE(queue.has_arrivals());
  std::deque<queued_work> taken;
  static_cast<void>(queue.take(taken, std::nullopt));
  EXPECT_FALSE(queue.has_arrivals());
}

TEST(work_queue, a_wait_ends_at_its_time) {
  work_queue queue(2);
  std::deque<queued_work> taken;
  EXPECT_FALSE(queue.take(taken, work_queue::time_point{}));
  EXPECT_TRUE(taken.empty());
}

TEST(work_queue, closing_wakes_who_waits_and_refuses_what_comes) {
  work_queue queue(2);
  bool closed = false;
  std::thread waiting([&] {
    std::deque<queued_work> taken;
    closed = queue.take(taken, std::nullopt);
  });
  queue.close();
  waiting.join();
  EXPECT_TRUE(closed);
  EXPECT_EQ(queue.push(some_change()).error().code, map_errc::closed);
}

} // namespace
} // namespace godwit::mapobjects_store
