#include "programs/godwit-sim/host/frame_finder.hpp"

#include <gtest/gtest.h>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::sim {
namespace frame_finder_test {

namespace mavlink = io::mavlink;

struct frame_finder_test : ::testing::Test {
  void feed(io::link::peer_id from, mavlink::byte_view bytes, bool is_datagram, std::int64_t now_ns = 0) {
    finder.feed(from, bytes, is_datagram, now_ns, count());
  }
  [[nodiscard]] std::function<void(const mavlink::frame_view&)> count() {
    return [this](const mavlink::frame_view&) { ++found; };
  }

  mavlink::scanner datagrams;
  frame_finder finder{datagrams};
  int found = 0;
  mavlink::frame_buffer frame = mavlink::encode(mavlink::heartbeat{.type = 6}, {255, 190}, 0);
};

TEST_F(frame_finder_test, a_frame_in_a_datagram_is_found_at_once) {
  feed(1, frame.span(), true);
  EXPECT_EQ(found, 1);
  EXPECT_EQ(finder.next_deadline_ns(), frame_finder::never);
}

TEST_F(frame_finder_test, frames_that_streams_tear_are_put_together_for_each_stream) {
  const auto bytes = frame.span();
  for (std::size_t n = 0; n < bytes.size(); ++n)
    for (const io::link::peer_id from : {1U, 2U})
      feed(from, bytes.subspan(n, 1), false);
  EXPECT_EQ(found, 2);
}

TEST_F(frame_finder_test, what_waits_too_long_is_let_go) {
  // The header of a heartbeat with 255 bytes that never come.
  const unsigned char false_start[] = {0xfd, 255, 0, 0, 0, 1, 1, 0, 0, 0};
  feed(1, std::as_bytes(std::span(false_start)), false, 1'000);
  feed(1, frame.span(), false, 1'000);
  EXPECT_EQ(found, 0) << "it may still be part of a long frame";
  ASSERT_EQ(finder.next_deadline_ns(), 1'000 + frame_finder::silence_ns);
  finder.on_time(finder.next_deadline_ns(), count());
  EXPECT_EQ(found, 1);
  EXPECT_EQ(finder.next_deadline_ns(), frame_finder::never);
}

TEST_F(frame_finder_test, a_stream_that_has_ended_leaves_nothing_to_the_next) {
  const auto bytes = frame.span();
  feed(1, bytes.first(5), false);
  finder.forget(1);
  feed(1, bytes.subspan(5), false);
  EXPECT_EQ(found, 0);
}

TEST_F(frame_finder_test, streams_are_bounded_and_the_longest_silent_one_goes) {
  const auto bytes = frame.span();
  for (io::link::peer_id from = 1; from <= frame_finder::max_streams + 1; ++from)
    feed(from, bytes.first(5), false, from);
  feed(1, bytes.subspan(5), false);
  EXPECT_EQ(found, 0) << "it was forgotten";
  feed(frame_finder::max_streams, bytes.subspan(5), false);
  EXPECT_EQ(found, 1);
}

} // namespace frame_finder_test
} // namespace godwit::sim
