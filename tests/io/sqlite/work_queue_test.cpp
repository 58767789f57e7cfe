#include "io/sqlite/work_queue.hpp"

#include <gtest/gtest.h>

namespace godwit::io::sqlite {
namespace work_queue_test {

bool anybody(const int&) { return true; }

TEST(work_queue, it_takes_up_to_its_bound_until_something_is_finished) {
  work_queue<int> queue({.max_items = 2});
  EXPECT_TRUE(queue.push(1, {}, anybody));
  EXPECT_TRUE(queue.push(2, {}, anybody));
  EXPECT_EQ(queue.push(3, {}, anybody).error(), refusal::full);
  work_queue<int>::backlog taken;
  EXPECT_FALSE(queue.collect(taken));
  EXPECT_EQ(taken.size(), 2U);
  EXPECT_EQ(queue.push(3, {}, anybody).error(), refusal::full) << "taken is not finished";
  queue.finished({.items = 1});
  EXPECT_TRUE(queue.push(3, {}, anybody));
  EXPECT_EQ(queue.load().items, 2U);
  EXPECT_EQ(queue.load().refused, 2U);
}

TEST(work_queue, bytes_are_bounded_too_and_the_fill_is_that_of_the_nearer_bound) {
  work_queue<int> queue({.max_items = 10, .max_bytes = 100});
  EXPECT_EQ(queue.push(1, {.items = 1, .bytes = 101}, anybody).error(), refusal::full);
  EXPECT_TRUE(queue.push(1, {.items = 1, .bytes = 80}, anybody));
  EXPECT_DOUBLE_EQ(queue.load().fill, 0.8);
  EXPECT_EQ(queue.push(1, {.items = 1, .bytes = 21}, anybody).error(), refusal::full);
  queue.finished({.items = 1, .bytes = 80});
  EXPECT_TRUE(queue.push(1, {.items = 1, .bytes = 10}, anybody));
  EXPECT_DOUBLE_EQ(queue.load().fill, 0.1);
}

TEST(work_queue, what_takes_no_room_is_never_refused_for_want_of_it) {
  work_queue<int> queue({.max_items = 1});
  EXPECT_TRUE(queue.push(1, {}, anybody));
  EXPECT_TRUE(queue.push(2, {.items = 0}, anybody));
}

TEST(work_queue, who_is_not_admitted_is_told_so) {
  work_queue<int> queue({});
  EXPECT_EQ(queue.push(1, {}, [](const int& item) { return item != 1; }).error(), refusal::not_admitted);
  EXPECT_TRUE(queue.push(2, {}, [](const int& item) { return item != 1; }));
}

TEST(work_queue, arrivals_are_seen_until_they_are_collected) {
  work_queue<int> queue({});
  EXPECT_FALSE(queue.has_arrivals());
  ASSERT_TRUE(queue.push(1, {}, anybody));
  EXPECT_TRUE(queue.has_arrivals());
  work_queue<int>::backlog taken;
  static_cast<void>(queue.collect(taken));
  EXPECT_FALSE(queue.has_arrivals());
}

TEST(work_queue, a_wait_ends_at_its_time) {
  work_queue<int> queue({});
  queue.wait(work_queue<int>::time_point{});
  work_queue<int>::backlog taken;
  EXPECT_FALSE(queue.collect(taken));
  EXPECT_TRUE(taken.empty());
}

TEST(work_queue, closing_wakes_who_waits_and_refuses_what_comes) {
  work_queue<int> queue({});
  std::thread waiting([&] { queue.wait(std::nullopt); });
  queue.close();
  waiting.join();
  work_queue<int>::backlog taken;
  EXPECT_TRUE(queue.collect(taken));
  EXPECT_EQ(queue.push(1, {}, anybody).error(), refusal::closed);
}

} // namespace work_queue_test
} // namespace godwit::io::sqlite
