#include "io/link/tcp_in_link.hpp"

#include <optional>

#include <gtest/gtest.h>

#include "tests/io/link/far_ends.hpp"
#include "tests/io/link/watcher.hpp"

namespace godwit::io::link {
namespace tcp_in_link_test {

using namespace std::chrono_literals;
using testing::bytes_of;
using testing::tcp_caller;
using testing::watcher;

struct tcp_in_link_test : ::testing::Test {
  void listen(const link_options& options = {}) {
    link = testing::open("tcpin://127.0.0.1:0", heard, options);
    ASSERT_TRUE(heard.wait_for_phase(link_phase::up)) << heard.last_status().reason;
    port = testing::port_of(*link);
  }
  // TEXT comes from FROM, in one piece or several; gives the number of the peer.
  peer_id say(const tcp_caller& from, const std::string& text) {
    from.write(text);
    EXPECT_TRUE(heard.wait_for([&](const watcher& w) { return !w.chunks.empty() && w.chunks.back().bytes == text; }));
    return heard.last_chunk().from;
  }

  watcher heard;
  std::unique_ptr<class link> link;
  std::uint16_t port = 0;
};

TEST_F(tcp_in_link_test, the_description_shows_the_real_port) {
  listen();
  EXPECT_NE(port, 0);
  EXPECT_EQ(link->description(), "tcpin://127.0.0.1:" + std::to_string(port));
  EXPECT_EQ(heard.last_status().reason, "listening on " + link->description());
}

TEST_F(tcp_in_link_test, each_connection_is_a_peer_and_is_answered_alone_or_with_all) {
  listen();
  const tcp_caller first(port);
  const tcp_caller second(port);
  const auto first_id = say(first, "first");
  const auto second_id = say(second, "second");
  EXPECT_NE(first_id, second_id);
  EXPECT_FALSE(heard.last_chunk().is_datagram);
  EXPECT_TRUE(link->send(bytes_of("to the second "), second_id));
  EXPECT_TRUE(link->send(bytes_of("to all")));
  EXPECT_EQ(first.read(6), "to all");
  EXPECT_EQ(second.read(20), "to the second to all");
  EXPECT_EQ(link->counters().tx_chunks, 3U);
  EXPECT_EQ(link->counters().tx_bytes, 26U);
  EXPECT_EQ(link->counters().peers, 2U);
}

TEST_F(tcp_in_link_test, a_peer_that_only_listens_is_sent_what_goes_to_all) {
  listen();
  const tcp_caller quiet(port);
  ASSERT_TRUE(testing::eventually([&] { return link->counters().peers == 1; }));
  EXPECT_TRUE(link->send(bytes_of("telemetry")));
  EXPECT_EQ(quiet.read(9), "telemetry");
}

TEST_F(tcp_in_link_test, a_send_that_nobody_can_get_is_counted) {
  listen();
  EXPECT_FALSE(link->send(bytes_of("hello?")));
  const tcp_caller peer(port);
  const auto id = say(peer, "here");
  EXPECT_FALSE(link->send(bytes_of("hello?"), id + 1));
  EXPECT_EQ(link->counters().tx_no_peer, 2U);
  EXPECT_EQ(link->counters().tx_dropped, 0U);
}

TEST_F(tcp_in_link_test, a_peer_that_leaves_is_told_and_its_number_does_not_come_back) {
  listen();
  std::optional<tcp_caller> first(std::in_place, port);
  const auto first_id = say(*first, "first");
  first.reset();
  ASSERT_TRUE(heard.wait_for([&](const watcher& w) { return w.left == std::vector{first_id}; }));
  EXPECT_EQ(link->counters().peers, 0U);
  EXPECT_FALSE(link->send(bytes_of("x"), first_id));
  const tcp_caller second(port);
  EXPECT_NE(say(second, "second"), first_id);
  EXPECT_EQ(heard.last_status().phase, link_phase::up) << "a peer that leaves is no loss of the link";
}

TEST_F(tcp_in_link_test, one_peer_too_many_is_turned_away_and_the_others_stay) {
  listen({.max_peers = 2});
  const tcp_caller first(port);
  const tcp_caller second(port);
  const auto first_id = say(first, "first");
  static_cast<void>(say(second, "second"));
  const tcp_caller third(port);
  EXPECT_TRUE(third.is_hung_up());
  EXPECT_EQ(link->counters().peers_refused, 1U);
  EXPECT_EQ(link->counters().peers, 2U);
  EXPECT_TRUE(link->send(bytes_of("still here"), first_id));
  EXPECT_EQ(first.read(10), "still here");
}

TEST_F(tcp_in_link_test, one_that_does_not_read_holds_up_nobody_and_loses_whole_chunks) {
  const link_options options;
  listen(options);
  const tcp_caller deaf(port);
  const tcp_caller reader(port);
  const auto deaf_id = say(deaf, "deaf");
  const auto reader_id = say(reader, "reader");
  const std::string frame(16 * 1024, 'x');
  std::uint64_t accepted = 0;
  for (int n = 0; n < 2'000; ++n) // 33 MB
    accepted += link->send(bytes_of(frame), deaf_id) ? 1 : 0;
  EXPECT_LT(accepted, 2'000U);
  EXPECT_EQ(link->counters().tx_dropped, 2'000U - accepted);
  EXPECT_LE(link->counters().tx_queued_bytes, options.send_queue_bytes);
  EXPECT_TRUE(link->send(bytes_of("not held up"), reader_id));
  EXPECT_EQ(reader.read(11), "not held up");
  const auto bytes = static_cast<std::size_t>(accepted) * frame.size();
  EXPECT_EQ(deaf.read(bytes).size(), bytes) << "what was accepted arrives as a whole";
}

TEST_F(tcp_in_link_test, a_port_in_use_is_taken_when_it_is_free) {
  std::optional<testing::tcp_end> other(std::in_place);
  link = testing::open("tcpin://127.0.0.1:" + std::to_string(other->port()), heard);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::down));
  EXPECT_NE(heard.last_status().reason.find("another program listens on this port"), std::string::npos)
      << heard.last_status().reason;
  EXPECT_FALSE(link->send(bytes_of("x")));
  EXPECT_EQ(link->counters().tx_dropped, 1U);
  other.reset();
  EXPECT_TRUE(heard.wait_for_phase(link_phase::up));
}

TEST_F(tcp_in_link_test, the_port_can_be_taken_again_right_after_the_end_with_peers) {
  listen();
  const tcp_caller peer(port);
  static_cast<void>(say(peer, "here"));
  link.reset();
  EXPECT_TRUE(peer.is_hung_up());
  link = testing::open("tcpin://127.0.0.1:" + std::to_string(port), heard);
  EXPECT_TRUE(heard.wait_for([](const watcher& w) { return w.statuses.back().phase == link_phase::up; }));
}

TEST_F(tcp_in_link_test, a_connecting_link_reaches_it_by_name_and_over_both_families) {
  link = testing::open("tcpin://:0", heard);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up)) << heard.last_status().reason;
  watcher client_heard;
  const auto client = testing::open("tcp://localhost:" + std::to_string(testing::port_of(*link)), client_heard);
  ASSERT_TRUE(client_heard.wait_for_phase(link_phase::up)) << client_heard.last_status().reason;
  ASSERT_TRUE(client->send(bytes_of("ping")));
  ASSERT_TRUE(heard.wait_for_bytes("ping"));
  ASSERT_TRUE(link->send(bytes_of("pong"), heard.last_chunk().from));
  EXPECT_TRUE(client_heard.wait_for_bytes("pong"));
}

} // namespace tcp_in_link_test
} // namespace godwit::io::link
