// What stream links and listening TCP links share; with sockets in the tests of both.
#include <array>
#include <cerrno>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/socket.h>

#include "io/link/open_stream.hpp"
#include "tests/io/link/watcher.hpp"

namespace godwit::io::link {

namespace open_stream_test {

using testing::bytes_of;

// A stream over one half of a pair of sockets; the test holds the other half and turns the handlers itself.
struct open_stream_test : ::testing::Test {
  open_stream_test() { open(); }

  void open() {
    std::array<int, 2> ends{};
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends.data()), 0);
    other = descriptor(ends[1]);
    ASSERT_FALSE(stream.take(descriptor(ends[0])));
  }
  void turn() {
    io.restart();
    io.poll();
  }
  [[nodiscard]] open_stream::hooks hooks() {
    return {.write =
                [this](int to, std::span<const std::byte> bytes) {
                  if (write_error == 0)
                    return ::send(to, bytes.data(), bytes.size(), MSG_NOSIGNAL);
                  errno = write_error;
                  return ssize_t{-1};
                },
            .discard_output = [this](int) { ++discarded; },
            .received = [this](std::span<const std::byte> bytes) { received += bytes.size(); },
            .ended = [this](int error) { ended.push_back(error); }};
  }

  static constexpr std::size_t queue_bytes = 1'000;
  boost::asio::io_context io;
  std::array<std::byte, 256> buffer{};
  counter_set counters;
  int write_error = 0;
  int discarded = 0;
  std::size_t received = 0;
  std::vector<int> ended;
  descriptor other;
  open_stream stream{io, buffer, queue_bytes, counters, hooks()};
};

TEST_F(open_stream_test, what_comes_is_handed_on_until_the_other_side_ends_it) {
  ASSERT_EQ(::write(other.number(), "12345", 5), 5);
  turn();
  EXPECT_EQ(received, 5U);
  other.reset();
  turn();
  EXPECT_EQ(ended, std::vector{0});
  EXPECT_FALSE(stream.send(bytes_of("x")));
  EXPECT_EQ(counters.values().tx_dropped, 1U);
}

TEST_F(open_stream_test, what_the_system_does_not_take_waits_and_goes_out_when_it_does) {
  write_error = EAGAIN;
  EXPECT_TRUE(stream.send(bytes_of("waits")));
  EXPECT_EQ(stream.queued_bytes(), 5U);
  EXPECT_FALSE(stream.send(bytes_of(std::string(queue_bytes, 'x')))) << "it does not fit as a whole";
  write_error = 0;
  turn();
  turn();
  EXPECT_EQ(stream.queued_bytes(), 0U);
  std::array<char, 16> text{};
  EXPECT_EQ(::read(other.number(), text.data(), text.size()), 5);
}

TEST_F(open_stream_test, a_write_that_fails_ends_it_in_its_own_thread_and_not_in_the_senders) {
  write_error = EPIPE;
  EXPECT_FALSE(stream.send(bytes_of("x")));
  EXPECT_TRUE(ended.empty());
  turn();
  EXPECT_EQ(ended, std::vector{EPIPE});
  EXPECT_EQ(discarded, 1);
}

TEST_F(open_stream_test, it_serves_for_the_next_stream_when_one_is_over) {
  other.reset();
  turn();
  ASSERT_EQ(ended.size(), 1U);
  open();
  EXPECT_TRUE(stream.send(bytes_of("again")));
  ASSERT_EQ(::write(other.number(), "x", 1), 1);
  turn();
  EXPECT_EQ(received, 1U);
}

} // namespace open_stream_test

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
