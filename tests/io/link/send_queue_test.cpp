#include "io/link/send_queue.hpp"

#include <string>

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

namespace godwit::io::link {
namespace send_queue_test {

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

std::string take(send_queue& queue, std::size_t most) {
  const auto front = queue.front();
  const auto size = std::min(front.size(), most);
  std::string taken(reinterpret_cast<const char*>(front.data()), size);
  queue.pop(size);
  return taken;
}

TEST(link_send_queue, what_does_not_fit_as_a_whole_does_not_fit) {
  send_queue queue(10);
  queue.push(bytes_of("1234567"));
  EXPECT_TRUE(queue.fits(3));
  EXPECT_FALSE(queue.fits(4));
  EXPECT_EQ(queue.size_bytes(), 7U);
}

TEST(link_send_queue, a_chunk_counts_when_its_last_byte_is_taken) {
  send_queue queue(10);
  queue.push(bytes_of("abc"));
  queue.push(bytes_of("de"));
  EXPECT_EQ(queue.pop(2), 0U);
  EXPECT_EQ(queue.pop(3), 2U);
  EXPECT_TRUE(queue.empty());
}

TEST(link_send_queue, clearing_counts_the_chunk_that_was_begun) {
  send_queue queue(10);
  queue.push(bytes_of("abc"));
  queue.push(bytes_of("de"));
  queue.pop(1);
  EXPECT_EQ(queue.clear(), 2U);
  EXPECT_TRUE(queue.empty());
  EXPECT_TRUE(queue.front().empty());
  EXPECT_TRUE(queue.fits(10));
}

RC_GTEST_PROP(link_send_queue_property, bytes_come_out_as_they_went_in_and_all_chunks_are_counted, ()) {
  send_queue queue(*rc::gen::inRange<std::size_t>(1, 20));
  const auto steps = *rc::gen::container<std::vector<std::pair<std::string, std::size_t>>>(
      rc::gen::pair(rc::gen::nonEmpty<std::string>(), rc::gen::inRange<std::size_t>(0, 12)));
  std::string in;
  std::string out;
  for (const auto& [chunk, taken] : steps) {
    if (queue.fits(chunk.size())) {
      queue.push(bytes_of(chunk));
      in += chunk;
    }
    out += take(queue, taken);
    RC_ASSERT(queue.size_bytes() == in.size() - out.size());
  }
  while (!queue.empty())
    out += take(queue, 100);
  RC_ASSERT(in == out);
  RC_ASSERT(queue.clear() == 0U);
}

} // namespace send_queue_test
} // namespace godwit::io::link
