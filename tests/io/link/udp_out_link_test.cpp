#include <optional>

#include <gtest/gtest.h>

#include "io/link/udp_out_link.hpp"
#include "tests/io/link/far_ends.hpp"
#include "tests/io/link/watcher.hpp"

namespace godwit::io::link {

namespace udp_out_link_test {

using namespace std::chrono_literals;
using testing::bytes_of;
using testing::udp_end;
using testing::watcher;
using clock = std::chrono::steady_clock;

constexpr auto required_to_be_back_within = 5s;

std::string uri_of(std::uint16_t port) { return "udpout://127.0.0.1:" + std::to_string(port); }

// Sends until the link has the phase, as the heartbeat would, only faster.
bool send_until(link& link, watcher& heard, link_phase phase) {
  return testing::eventually([&] {
    static_cast<void>(link.send(bytes_of("beat")));
    return heard.last_status().phase == phase;
  });
}

TEST(udp_out_link, datagrams_go_both_ways_from_one_port) {
  const udp_end peer;
  watcher heard;
  const auto link = testing::open(uri_of(peer.port()), heard);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up)) << heard.last_status().reason;
  EXPECT_TRUE(link->send(bytes_of("one")));
  EXPECT_EQ(peer.receive(), "one");
  const auto port = peer.last_sender();
  EXPECT_TRUE(link->send(bytes_of("two"), only_peer));
  EXPECT_EQ(peer.receive(), "two");
  EXPECT_EQ(peer.last_sender(), port);
  peer.send(port, "answer");
  ASSERT_TRUE(heard.wait_for_bytes("answer"));
  EXPECT_EQ(heard.last_chunk().from, only_peer);
  EXPECT_TRUE(heard.last_chunk().is_datagram);
  EXPECT_FALSE(link->send(bytes_of("x"), 2)) << "there is one peer only";
  EXPECT_EQ(link->description(), uri_of(peer.port()));
}

TEST(udp_out_link, strangers_are_not_heard) {
  const udp_end peer;
  const udp_end stranger;
  watcher heard;
  const auto link = testing::open(uri_of(peer.port()), heard);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
  ASSERT_TRUE(link->send(bytes_of("hello")));
  ASSERT_EQ(peer.receive(), "hello");
  stranger.send(peer.last_sender(), "from a stranger");
  peer.send(peer.last_sender(), "from the peer");
  EXPECT_TRUE(heard.wait_for_bytes("from the peer"));
}

TEST(udp_out_link, when_nobody_listens_it_says_so_and_goes_on_sending) {
  const auto port = testing::unused_udp_port();
  watcher heard;
  const auto link = testing::open(uri_of(port), heard);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
  ASSERT_TRUE(send_until(*link, heard, link_phase::down));
  EXPECT_EQ(heard.last_status().reason,
            "127.0.0.1:" + std::to_string(port) + ": nobody listens there (connection refused); still sending");
  const auto before = link->counters();
  for (int n = 0; n < 20; ++n)
    EXPECT_TRUE(link->send(bytes_of("beat"))) << "each goes out, although the one before was refused";
  EXPECT_EQ(link->counters().tx_chunks, before.tx_chunks + 20);
  EXPECT_EQ(link->counters().tx_dropped, before.tx_dropped);
}

TEST(udp_out_link, a_peer_that_comes_back_and_answers_is_up_at_once) {
  std::optional<udp_end> peer(std::in_place);
  const auto port = peer->port();
  watcher heard;
  const auto link = testing::open(uri_of(port), heard);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
  peer.reset();
  ASSERT_TRUE(send_until(*link, heard, link_phase::down));
  peer.emplace(port);
  const auto back_at = clock::now();
  ASSERT_TRUE(link->send(bytes_of("beat")));
  ASSERT_TRUE(peer->receive());
  peer->send(peer->last_sender(), "back");
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
  const auto took = clock::now() - back_at;
  EXPECT_LE(took, required_to_be_back_within);
  RecordProperty("back_after_ms", static_cast<int>(took / 1ms));
  EXPECT_EQ(heard.last_status().reconnects, 1U);
  EXPECT_TRUE(heard.wait_for_bytes("back"));
}

TEST(udp_out_link, a_peer_that_comes_back_and_only_listens_is_up_within_5_s) {
  std::optional<udp_end> peer(std::in_place);
  const auto port = peer->port();
  watcher heard;
  const auto link = testing::open(uri_of(port), heard);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
  peer.reset();
  ASSERT_TRUE(send_until(*link, heard, link_phase::down));
  peer.emplace(port);
  const auto back_at = clock::now();
  ASSERT_TRUE(send_until(*link, heard, link_phase::up));
  const auto took = clock::now() - back_at;
  EXPECT_LE(took, required_to_be_back_within);
  RecordProperty("back_after_ms", static_cast<int>(took / 1ms));
}

TEST(udp_out_link, a_host_name_that_does_not_exist_is_a_reason_and_not_an_error) {
  watcher heard;
  const auto link = testing::open("udpout://no-such-host.invalid:14550", heard);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::down));
  EXPECT_NE(heard.last_status().reason.find("host name not found"), std::string::npos) << heard.last_status().reason;
}

TEST(udp_out_link, when_nobody_reads_every_send_returns_at_once_and_is_accounted_for) {
  const udp_end peer; // its buffer fills up
  watcher heard;
  const auto link = testing::open(uri_of(peer.port()), heard);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
  const std::string frame(1'000, 'x');
  std::uint64_t accepted = 0;
  for (int n = 0; n < 20'000; ++n)
    accepted += link->send(bytes_of(frame)) ? 1 : 0;
  const auto counted = link->counters();
  EXPECT_EQ(counted.tx_chunks, accepted);
  EXPECT_EQ(counted.tx_chunks + counted.tx_dropped, 20'000U);
}

} // namespace udp_out_link_test

namespace refusal_watch_test {

using namespace std::chrono_literals;

refusal_watch::time_point moment(std::chrono::milliseconds since_start) {
  return refusal_watch::time_point{} + 1h + since_start;
}

TEST(link_refusal_watch, silence_alone_is_no_answer) {
  refusal_watch watch;
  watch.refused();
  EXPECT_FALSE(watch.is_over(moment(1h)));
}

TEST(link_refusal_watch, a_send_that_is_not_refused_for_the_answer_time_ends_the_refusal) {
  refusal_watch watch;
  watch.refused();
  watch.sent(moment(1s));
  watch.sent(moment(3s));
  EXPECT_FALSE(watch.is_over(moment(3'499ms)));
  EXPECT_TRUE(watch.is_over(moment(3'500ms)));
}

TEST(link_refusal_watch, a_new_refusal_starts_the_wait_anew) {
  refusal_watch watch;
  watch.sent(moment(0s));
  watch.refused();
  EXPECT_FALSE(watch.is_over(moment(10s)));
  watch.sent(moment(10s));
  EXPECT_FALSE(watch.is_over(moment(11s)));
}

} // namespace refusal_watch_test

} // namespace godwit::io::link
