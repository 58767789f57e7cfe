#include "io/link/peer_table.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

namespace godwit::io::link {
namespace peer_table_test {

using namespace std::chrono_literals;

peer_table::endpoint address(std::uint16_t port) { return {boost::asio::ip::address_v4::loopback(), port}; }

peer_table::time_point at(std::chrono::milliseconds since_start) { return peer_table::time_point{} + 1h + since_start; }

TEST(link_peer_table, an_address_keeps_its_number_while_it_is_remembered) {
  peer_table peers(4, 30s);
  const auto first = peers.heard(address(1), at(0s));
  const auto second = peers.heard(address(2), at(1s));
  EXPECT_NE(first, second);
  EXPECT_NE(first, every_peer);
  EXPECT_EQ(peers.heard(address(1), at(29s)), first);
  EXPECT_EQ(peers.heard(address(1), at(58s)), first);
}

TEST(link_peer_table, who_is_silent_for_the_whole_time_is_forgotten_and_new_when_he_comes_back) {
  peer_table peers(4, 30s);
  const auto before = peers.heard(address(1), at(0s));
  peers.forget_silent(at(29'999ms));
  EXPECT_EQ(peers.all().size(), 1U);
  peers.forget_silent(at(30s));
  EXPECT_TRUE(peers.all().empty());
  EXPECT_EQ(peers.forgotten(), 1U);
  EXPECT_NE(peers.heard(address(1), at(31s)), before);
}

TEST(link_peer_table, a_new_peer_takes_the_place_of_the_longest_silent) {
  peer_table peers(3, 30s);
  for (std::uint16_t port = 1; port <= 3; ++port)
    peers.heard(address(port), at(std::chrono::seconds(port)));
  const auto first = peers.heard(address(1), at(4s)); // now 2 is the longest silent
  peers.heard(address(4), at(5s));
  EXPECT_EQ(peers.evicted(), 1U);
  EXPECT_EQ(peers.all().size(), 3U);
  for (const auto& each : peers.all())
    EXPECT_NE(each.address, address(2));
  EXPECT_EQ(peers.heard(address(1), at(6s)), first);
}

TEST(link_peer_table, a_flood_of_newcomers_pushes_out_nobody_who_speaks) {
  peer_table peers(3, 30s);
  const auto vehicle = peers.heard(address(1), at(0s));
  for (int i = 1; i < 10'000; ++i) {
    (void)peers.heard(address(static_cast<std::uint16_t>(i + 1)), at(std::chrono::milliseconds(i)));
    if (i % 1'000 == 0) {
      EXPECT_EQ(peers.heard(address(1), at(std::chrono::milliseconds(i))), vehicle);
    }
  }
  EXPECT_GT(peers.refused(), 0U);
}

RC_GTEST_PROP(link_peer_table_property, the_table_is_bounded_and_its_numbers_differ, ()) {
  const auto max_peers = *rc::gen::inRange<std::size_t>(1, 5);
  peer_table peers(max_peers, 10s);
  std::chrono::milliseconds now{0};
  const auto steps = *rc::gen::container<std::vector<std::pair<std::uint16_t, int>>>(
      rc::gen::pair(rc::gen::inRange<std::uint16_t>(1, 8), rc::gen::inRange(0, 6000)));
  for (const auto& [port, pause_ms] : steps) {
    now += std::chrono::milliseconds(pause_ms);
    const auto id = peers.heard(address(port), at(now));
    RC_ASSERT(peers.all().size() <= max_peers);
    RC_ASSERT(id != every_peer);
    for (const auto& each : peers.all())
      RC_ASSERT((each.id == id) == (each.address == address(port)));
  }
}

} // namespace peer_table_test
} // namespace godwit::io::link
