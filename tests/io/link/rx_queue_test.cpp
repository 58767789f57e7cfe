#include <gtest/gtest.h>

#include <array>

#include "io/link/rx_queue.hpp"

namespace rx_queue_test {

using namespace godwit::io::link;

constexpr std::array<std::byte, 100> chunk{};

TEST(rx_queue, the_actor_is_woken_once_until_it_has_taken_all) {
  rx_queue queue;
  EXPECT_TRUE(queue.put(1, chunk, true));
  EXPECT_FALSE(queue.put(1, chunk, true));
  EXPECT_TRUE(queue.take());
  EXPECT_FALSE(queue.put(1, chunk, true));
  EXPECT_TRUE(queue.take());
  EXPECT_TRUE(queue.take());
  EXPECT_FALSE(queue.take());
  EXPECT_TRUE(queue.put(1, chunk, true));
}

TEST(rx_queue, a_flood_is_dropped_at_the_bound_and_counted) {
  rx_queue queue;
  std::size_t put = 0;
  for (; put < 10'000; ++put)
    (void)queue.put(1, chunk, true);
  std::size_t taken = 0;
  while (queue.take())
    ++taken;
  EXPECT_EQ(taken, max_waiting_bytes / chunk.size());
  EXPECT_EQ(queue.dropped_bytes(), (put - taken) * chunk.size());
}

TEST(rx_queue, an_empty_datagram_takes_no_room) {
  rx_queue queue;
  EXPECT_FALSE(queue.put(1, {}, true));
  EXPECT_FALSE(queue.take());
}

TEST(rx_queue, of_the_state_of_the_link_only_the_newest_counts) {
  rx_queue queue;
  EXPECT_TRUE(queue.put(link_status{link_phase::up, "a", 0}));
  EXPECT_FALSE(queue.put(link_status{link_phase::down, "b", 0}));
  EXPECT_EQ(std::get<link_status>(queue.take().value()).reason, "b");
  EXPECT_FALSE(queue.take());
}

TEST(rx_queue, a_state_comes_before_the_bytes_that_wait) {
  rx_queue queue;
  (void)queue.put(1, chunk, true);
  (void)queue.put(link_status{link_phase::down, "b", 0});
  EXPECT_TRUE(std::holds_alternative<link_status>(queue.take().value()));
  EXPECT_TRUE(std::holds_alternative<arrival>(queue.take().value()));
}

TEST(rx_queue, a_state_that_comes_when_the_last_chunk_is_taken_is_not_forgotten) {
  rx_queue queue;
  (void)queue.put(1, chunk, true);
  EXPECT_TRUE(queue.take());
  EXPECT_FALSE(queue.put(link_status{link_phase::down, "b", 0})) << "awake: it still takes";
  EXPECT_TRUE(queue.take());
  EXPECT_FALSE(queue.take());
  EXPECT_TRUE(queue.put(link_status{link_phase::up, "", 0})) << "asleep";
}

TEST(rx_queue, the_newest_status_is_known_after_it_was_taken) {
  rx_queue queue;
  EXPECT_FALSE(queue.newest_status());
  (void)queue.put(link_status{link_phase::up, "a", 0});
  (void)queue.take();
  ASSERT_TRUE(queue.newest_status());
  EXPECT_EQ(queue.newest_status()->reason, "a");
}

} // namespace rx_queue_test
