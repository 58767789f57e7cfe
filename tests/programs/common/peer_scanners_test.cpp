#include "programs/common/peer_scanners.hpp"

#include <gtest/gtest.h>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/messages/heartbeat.hpp"

namespace peer_scanners_test {

using namespace godwit;
using programs::peer_scanners;

TEST(peer_scanners, frames_that_are_split_over_datagrams_are_joined_while_another_peer_speaks) {
  peer_scanners all;
  int found = 0;
  const auto sink = [&](const io::mavlink::frame_view&) { ++found; };
  for (std::uint8_t i = 0; i < 40; ++i) {
    const auto one = io::mavlink::encode(io::mavlink::heartbeat{}, {1, 1}, i);
    const auto other = io::mavlink::encode(io::mavlink::heartbeat{}, {2, 1}, i);
    all.feed(1, true, one.span().first(11), sink);
    all.feed(2, true, other.span().first(5), sink);
    all.feed(1, true, one.span().subspan(11), sink);
    all.feed(2, true, other.span().subspan(5), sink);
  }
  EXPECT_EQ(found, 80);
  EXPECT_EQ(all.counters().frames, 80U);
  EXPECT_EQ(all.counters().cut_off, 0U);
  EXPECT_EQ(all.senders().size(), 2U);
  EXPECT_EQ(all.waiting_bytes(), 0U);
}

TEST(peer_scanners, peers_are_bounded_and_what_they_sent_stays_counted) {
  peer_scanners all;
  const auto frame = io::mavlink::encode(io::mavlink::heartbeat{}, {1, 1}, 0);
  for (io::link::peer_id peer = 1; peer <= 2 * peer_scanners::max_peers; ++peer)
    all.feed(peer, true, frame.span(), [](const io::mavlink::frame_view&) {});
  EXPECT_EQ(all.counters().frames, 2 * peer_scanners::max_peers);
  EXPECT_EQ(all.senders().size(), peer_scanners::max_peers);
}

} // namespace peer_scanners_test
