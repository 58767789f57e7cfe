#include "programs/godwit-trace/link_session.hpp"

#include <gtest/gtest.h>
#include <poll.h>

namespace godwit::trace_tool {
namespace chunk_queue_test {

bool is_readable(const chunk_queue& queue) {
  pollfd watched{queue.descriptor(), POLLIN, 0};
  return ::poll(&watched, 1, 0) == 1;
}

heard_chunk chunk_of(std::size_t bytes) { return {1, true, std::vector<std::byte>(bytes), std::nullopt}; }

TEST(chunk_queue, the_descriptor_is_readable_while_something_waits) {
  chunk_queue queue;
  EXPECT_FALSE(is_readable(queue));
  queue.push(chunk_of(3));
  queue.push(chunk_of(4));
  EXPECT_TRUE(is_readable(queue));
  const auto taken = queue.take();
  ASSERT_EQ(taken.size(), 2U);
  EXPECT_EQ(taken[1].bytes.size(), 4U);
  EXPECT_FALSE(is_readable(queue));
  EXPECT_TRUE(queue.take().empty());
}

TEST(chunk_queue, what_does_not_fit_is_dropped_and_counted_until_there_is_room) {
  chunk_queue queue;
  queue.push(chunk_of(chunk_queue::max_waiting_bytes));
  queue.push(chunk_of(5));
  EXPECT_EQ(queue.dropped_bytes(), 5U);
  EXPECT_EQ(queue.take().size(), 1U);
  queue.push(chunk_of(5));
  EXPECT_EQ(queue.take().size(), 1U);
  EXPECT_EQ(queue.dropped_bytes(), 5U);
}

TEST(chunk_queue, the_number_of_chunks_is_bounded_too) {
  chunk_queue queue;
  for (std::size_t i = 0; i < chunk_queue::max_waiting_chunks + 2; ++i)
    queue.push(chunk_of(1));
  EXPECT_EQ(queue.take().size(), chunk_queue::max_waiting_chunks);
  EXPECT_EQ(queue.dropped_bytes(), 2U);
}

TEST(chunk_queue, a_change_of_the_status_is_never_dropped) {
  chunk_queue queue;
  queue.push(chunk_of(chunk_queue::max_waiting_bytes));
  queue.push({2, false, {}, io::link::link_status{io::link::link_phase::down, "gone", 0}});
  const auto taken = queue.take();
  ASSERT_EQ(taken.size(), 2U);
  EXPECT_EQ(taken[1].status->reason, "gone");
}

} // namespace chunk_queue_test
} // namespace godwit::trace_tool
