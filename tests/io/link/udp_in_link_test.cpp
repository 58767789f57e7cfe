#include <future>
#include <optional>
#include <utility>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "io/link/udp_in_link.hpp"
#include "tests/io/link/far_ends.hpp"
#include "tests/io/link/watcher.hpp"

namespace godwit::io::link {

namespace udp_in_link_test {

using namespace std::chrono_literals;
using testing::bytes_of;
using testing::port_of;
using testing::udp_end;
using testing::watcher;

struct udp_in_link_test : ::testing::Test {
  // Opens on a free port and waits until it listens.
  void listen(const link_options& options = {}) {
    link = testing::open("udpin://127.0.0.1:0", heard, options);
    ASSERT_TRUE(heard.wait_for_phase(link_phase::up)) << heard.last_status().reason;
    port = port_of(*link);
  }
  // TEXT comes from FROM; gives the number of the peer.
  peer_id say(const udp_end& from, const std::string& text) {
    from.send(port, text);
    EXPECT_TRUE(heard.wait_for([&](const watcher& w) { return !w.chunks.empty() && w.chunks.back().bytes == text; }));
    return heard.last_chunk().from;
  }

  watcher heard;
  std::unique_ptr<class link> link;
  std::uint16_t port = 0;
};

TEST_F(udp_in_link_test, the_description_shows_the_real_port) {
  listen();
  EXPECT_NE(port, 0);
  EXPECT_EQ(link->description(), "udpin://127.0.0.1:" + std::to_string(port));
  EXPECT_EQ(heard.last_status().reason, "listening on " + link->description());
}

TEST_F(udp_in_link_test, answers_go_to_whoever_was_heard_or_to_all) {
  listen();
  const udp_end first;
  const udp_end second;
  const auto first_id = say(first, "first");
  const auto second_id = say(second, "second");
  EXPECT_NE(first_id, second_id);
  EXPECT_TRUE(heard.last_chunk().is_datagram);
  EXPECT_TRUE(link->send(bytes_of("to the second"), second_id));
  EXPECT_EQ(second.receive(), "to the second");
  EXPECT_EQ(second.last_sender(), port);
  EXPECT_TRUE(link->send(bytes_of("to all")));
  EXPECT_EQ(first.receive(), "to all");
  EXPECT_EQ(second.receive(), "to all");
  EXPECT_EQ(link->counters().tx_chunks, 3U);
  EXPECT_EQ(link->counters().peers, 2U);
}

TEST_F(udp_in_link_test, a_send_that_nobody_can_get_is_counted) {
  listen();
  EXPECT_FALSE(link->send(bytes_of("hello?")));
  const udp_end peer;
  const auto id = say(peer, "here");
  EXPECT_FALSE(link->send(bytes_of("hello?"), id + 1));
  EXPECT_EQ(link->counters().tx_no_peer, 2U);
  EXPECT_EQ(link->counters().tx_dropped, 0U);
}

TEST_F(udp_in_link_test, datagrams_of_every_size_arrive_whole) {
  listen();
  const udp_end peer;
  for (const std::size_t size : {std::size_t{1}, std::size_t{280}, std::size_t{65'507}}) {
    const auto id = say(peer, std::string(size, 'a'));
    EXPECT_TRUE(link->send(bytes_of(std::string(size, 'b')), id));
    EXPECT_EQ(peer.receive(), std::string(size, 'b'));
  }
  EXPECT_FALSE(link->send(bytes_of(std::string(65'508, 'b')))) << "more than UDP carries";
  EXPECT_EQ(link->counters().tx_dropped, 1U);
}

// Somebody has stopped the process, or it gets no processor. 5 s of a vehicle that sends 80 frames a second.
TEST_F(udp_in_link_test, what_comes_while_nobody_reads_is_kept_for_some_seconds) {
  constexpr std::size_t sent = 400;
  std::promise<void> stopped;
  std::promise<void> goes_on;
  auto callbacks = heard.callbacks();
  callbacks.received = [&, hear = callbacks.received, waits = true](peer_id from, std::span<const std::byte> bytes,
                                                                    bool is_datagram) mutable {
    if (std::exchange(waits, false)) {
      stopped.set_value();
      goes_on.get_future().wait();
    }
    hear(from, bytes, is_datagram);
  };
  auto opened = open_link(*parse_uri("udpin://127.0.0.1:0"), std::move(callbacks), {});
  ASSERT_TRUE(opened) << opened.error();
  link = std::move(*opened);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
  const udp_end peer;
  peer.send(port_of(*link), std::string(40, 'a'));
  stopped.get_future().wait();
  for (std::size_t n = 1; n < sent; ++n)
    peer.send(port_of(*link), std::string(40, 'a'));
  goes_on.set_value();
  EXPECT_TRUE(heard.wait_for_chunks(sent));
}

TEST_F(udp_in_link_test, the_seventeenth_peer_pushes_out_nobody_who_has_just_spoken) {
  listen();
  std::vector<udp_end> peers(17);
  std::vector<peer_id> ids;
  for (std::size_t n = 0; n < peers.size(); ++n)
    ids.push_back(say(peers[n], "peer " + std::to_string(n)));
  EXPECT_EQ(link->counters().peers, 16U);
  EXPECT_EQ(link->counters().peers_evicted, 0U);
  EXPECT_EQ(link->counters().peers_refused, 1U);
  EXPECT_TRUE(link->send(bytes_of("x"), ids.front()));
  EXPECT_FALSE(link->send(bytes_of("x"), ids.back())) << "it was heard, and is not remembered";
}

TEST_F(udp_in_link_test, a_peer_that_was_silent_for_long_is_forgotten) {
  listen({.forget_peer_after = 20ms});
  const udp_end peer;
  static_cast<void>(say(peer, "here"));
  EXPECT_TRUE(testing::eventually([&] { return !link->send(bytes_of("x")); }));
  EXPECT_EQ(link->counters().peers, 0U);
  EXPECT_GE(link->counters().peers_forgotten, 1U);
}

TEST_F(udp_in_link_test, a_peer_that_goes_and_comes_back_is_answered_at_once) {
  listen();
  std::optional<udp_end> peer(std::in_place);
  const auto peer_port = peer->port();
  const auto id = say(*peer, "here");
  peer.reset();
  for (int n = 0; n < 10; ++n)
    static_cast<void>(link->send(bytes_of("anybody?")));
  peer.emplace(peer_port);
  const auto back_at = std::chrono::steady_clock::now();
  EXPECT_EQ(say(*peer, "here again"), id);
  EXPECT_TRUE(link->send(bytes_of("welcome"), id));
  EXPECT_EQ(peer->receive(), "welcome");
  EXPECT_LE(std::chrono::steady_clock::now() - back_at, 5s);
  EXPECT_EQ(heard.last_status().phase, link_phase::up);
}

TEST_F(udp_in_link_test, a_port_in_use_is_taken_when_it_is_free) {
  std::optional<udp_end> other(std::in_place);
  link = testing::open("udpin://127.0.0.1:" + std::to_string(other->port()), heard);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::down));
  EXPECT_NE(heard.last_status().reason.find("another program listens on this port"), std::string::npos)
      << heard.last_status().reason;
  EXPECT_FALSE(link->send(bytes_of("x")));
  EXPECT_EQ(link->counters().tx_dropped, 1U);
  other.reset();
  EXPECT_TRUE(heard.wait_for_phase(link_phase::up));
}

TEST_F(udp_in_link_test, an_address_of_another_computer_is_told_in_words) {
  link = testing::open("udpin://203.0.113.1:0", heard);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::down));
  EXPECT_NE(heard.last_status().reason.find("no interface of this computer has this address"), std::string::npos)
      << heard.last_status().reason;
}

TEST_F(udp_in_link_test, a_burst_is_received_in_order) {
  listen();
  const udp_end peer;
  constexpr int burst = 200; // as many as the system's buffer holds, even when nobody reads yet
  std::string all;
  for (int n = 0; n < burst; ++n) {
    const auto text = std::to_string(n) + ";";
    peer.send(port, text);
    all += text;
  }
  EXPECT_TRUE(heard.wait_for_bytes(all));
  EXPECT_EQ(link->counters().rx_chunks, static_cast<std::uint64_t>(burst));
}

} // namespace udp_in_link_test

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
