#include <gtest/gtest.h>

#include <cstring>
#include <thread>
#include <vector>

#include <unistd.h>

#include "runtime/random.hpp"
#include "runtime/trace/ring_trace.hpp"

namespace byte_ring_test {

using namespace godwit::runtime;

std::size_t page_bytes() { return static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)); }

TEST(byte_ring, a_new_ring_is_empty_and_all_of_it_is_free) {
  const auto ring = byte_ring::make(page_bytes());
  ASSERT_TRUE(ring);
  EXPECT_EQ(ring->readable().size(), 0U);
  EXPECT_EQ(ring->free_space(1).size(), page_bytes());
  EXPECT_FALSE(ring->more_than_half_full());
}

TEST(byte_ring, what_is_published_is_read_in_order_and_freed_when_consumed) {
  const auto ring = byte_ring::make(page_bytes());
  ASSERT_TRUE(ring);
  std::memcpy(ring->free_space(6).data(), "godwit", 6);
  ring->publish(6);
  ASSERT_EQ(ring->readable().size(), 6U);
  EXPECT_EQ(std::memcmp(ring->readable().data(), "godwit", 6), 0);
  ring->consume(3);
  ASSERT_EQ(ring->readable().size(), 3U);
  EXPECT_EQ(std::memcmp(ring->readable().data(), "wit", 3), 0);
  ring->consume(3);
  EXPECT_EQ(ring->readable().size(), 0U);
  EXPECT_EQ(ring->free_space(page_bytes()).size(), page_bytes());
}

TEST(byte_ring, a_record_over_the_end_is_still_one_piece) {
  const auto ring = byte_ring::make(page_bytes());
  ASSERT_TRUE(ring);
  ring->publish(page_bytes() - 10);
  ring->consume(page_bytes() - 10);
  std::vector<char> text(100);
  for (std::size_t i = 0; i < text.size(); ++i)
    text[i] = static_cast<char>(i);
  const auto space = ring->free_space(text.size());
  ASSERT_EQ(space.size(), page_bytes());
  std::memcpy(space.data(), text.data(), text.size());
  ring->publish(text.size());
  ASSERT_EQ(ring->readable().size(), text.size());
  EXPECT_EQ(std::memcmp(ring->readable().data(), text.data(), text.size()), 0);
}

TEST(byte_ring, a_full_ring_has_no_free_space_until_something_is_consumed) {
  const auto ring = byte_ring::make(page_bytes());
  ASSERT_TRUE(ring);
  ring->publish(page_bytes());
  EXPECT_EQ(ring->free_space(1).size(), 0U);
  EXPECT_TRUE(ring->more_than_half_full());
  EXPECT_EQ(ring->readable().size(), page_bytes());
  ring->consume(8);
  EXPECT_EQ(ring->free_space(1).size(), 8U);
}

// Records of random length, each with its number and a checksum over it, through a ring that is far too small for them.
struct record_head {
  std::uint64_t number = 0;
  std::uint64_t checksum = 0;
  std::uint32_t words = 0;
  std::uint32_t padding = 0;
};

std::uint64_t word_of(std::uint64_t number, std::uint32_t index) {
  return random_source(number * 1'000 + index).next();
}

TEST(byte_ring, two_threads_exchange_a_million_records_without_a_wrong_byte) {
  constexpr std::uint64_t records = 1'000'000;
  const auto ring = byte_ring::make(page_bytes());
  ASSERT_TRUE(ring);
  std::thread producer([&] {
    for (std::uint64_t number = 1; number <= records; ++number) {
      record_head head{number, number, static_cast<std::uint32_t>(number * 7 % 23), 0};
      const auto bytes = sizeof head + head.words * sizeof(std::uint64_t);
      auto space = ring->free_space(bytes);
      for (; space.size() < bytes; space = ring->free_space(bytes))
        std::this_thread::yield();
      for (std::uint32_t i = 0; i < head.words; ++i) {
        const auto word = word_of(number, i);
        head.checksum ^= word;
        std::memcpy(space.data() + sizeof head + i * sizeof word, &word, sizeof word);
      }
      std::memcpy(space.data(), &head, sizeof head);
      ring->publish(bytes);
    }
  });
  std::uint64_t wrong = 0;
  for (std::uint64_t expected = 1; expected <= records;) {
    auto bytes = ring->readable();
    if (bytes.empty())
      std::this_thread::yield();
    while (!bytes.empty()) {
      record_head head;
      std::memcpy(&head, bytes.data(), sizeof head);
      auto checksum = head.number;
      for (std::uint32_t i = 0; i < head.words; ++i) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + sizeof head + i * sizeof word, sizeof word);
        checksum ^= word;
      }
      wrong += head.number != expected || checksum != head.checksum ? 1 : 0;
      ++expected;
      const auto size = sizeof head + head.words * sizeof(std::uint64_t);
      ring->consume(size);
      bytes = bytes.subspan(size);
    }
  }
  producer.join();
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(ring->readable().size(), 0U);
}

} // namespace byte_ring_test
