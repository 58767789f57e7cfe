// tcp_opener and stream_link together, over loopback.
#include "io/link/tcp_opener.hpp"

#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

#include "io/link/stream_link.hpp"
#include "tests/io/link/far_ends.hpp"
#include "tests/io/link/watcher.hpp"

namespace godwit::io::link {
namespace tcp_link_test {

using namespace std::chrono_literals;
using testing::bytes_of;
using testing::tcp_end;
using testing::watcher;
using clock = std::chrono::steady_clock;

TEST(tcp_link, bytes_go_both_ways) {
  tcp_end server;
  watcher heard;
  const auto link = testing::open(server.uri(), heard);
  server.accept();
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up)) << heard.last_status().reason;
  EXPECT_TRUE(link->send(bytes_of("to the server")));
  EXPECT_EQ(server.read(13), "to the server");
  server.write("to the link");
  EXPECT_TRUE(heard.wait_for_bytes("to the link"));
  EXPECT_FALSE(heard.last_chunk().is_datagram);
  EXPECT_FALSE(link->send(bytes_of("x"), 7)) << "there is one peer only";
  EXPECT_EQ(link->counters().tx_no_peer, 1U);
}

TEST(tcp_link, a_name_is_looked_up) {
  tcp_end server;
  watcher heard;
  const auto link = testing::open("tcp://localhost:" + std::to_string(server.port()), heard);
  server.accept();
  EXPECT_TRUE(heard.wait_for_phase(link_phase::up)) << heard.last_status().reason;
}

TEST(tcp_link, a_server_that_goes_and_comes_back_is_connected_to_again) {
  std::optional<tcp_end> server(std::in_place);
  const auto port = server->port();
  watcher heard;
  const auto link = testing::open(server->uri(), heard);
  server->accept();
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
  server.reset();
  ASSERT_TRUE(heard.wait_for_phase(link_phase::down));
  ASSERT_TRUE(heard.wait_for_reason("nobody listens there (connection refused)"));
  ASSERT_TRUE(testing::eventually([&] { return link->counters().open_failures >= 4; }));
  const auto back_at = clock::now();
  server.emplace(port);
  server->accept();
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
  const auto took = clock::now() - back_at;
  EXPECT_LE(took, 5s);
  RecordProperty("back_after_ms", static_cast<int>(took / 1ms));
  EXPECT_EQ(heard.last_status().reconnects, 1U);
  server->write("again");
  EXPECT_TRUE(heard.wait_for_bytes("again"));
}

TEST(tcp_link, a_server_that_hangs_up_is_told_as_that) {
  tcp_end server;
  watcher heard;
  const auto link = testing::open(server.uri(), heard);
  server.accept();
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
  server.close();
  ASSERT_TRUE(heard.wait_for([](const watcher& w) { return w.statuses.back().reconnects == 1; }));
  const auto told = heard.all_statuses();
  EXPECT_EQ(told[2].reason,
            "127.0.0.1:" + std::to_string(server.port()) + ": the other side has closed the connection");
}

TEST(tcp_link, a_host_name_that_does_not_exist_is_a_reason_and_not_an_error) {
  watcher heard;
  const auto link = testing::open("tcp://no-such-host.invalid:5760", heard);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::down));
  EXPECT_NE(heard.last_status().reason.find("no-such-host.invalid: host name not found"), std::string::npos)
      << heard.last_status().reason;
}

TEST(tcp_link, when_nobody_reads_the_queue_stays_bounded_and_what_does_not_fit_is_counted) {
  tcp_end server;
  watcher heard;
  const link_options options;
  const auto link = testing::open(server.uri(), heard, options);
  server.accept();
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
  const std::string frame(16 * 1024, 'x');
  std::uint64_t accepted = 0;
  std::uint64_t refused = 0;
  for (int n = 0; n < 6'000; ++n) { // 100 MB
    ++(link->send(bytes_of(frame)) ? accepted : refused);
    ASSERT_LE(link->counters().tx_queued_bytes, options.send_queue_bytes);
  }
  EXPECT_GT(refused, 3'000U);
  EXPECT_EQ(link->counters().tx_dropped, refused);
  const auto bytes = static_cast<std::size_t>(accepted) * frame.size();
  EXPECT_EQ(server.read(bytes).size(), bytes) << "what was accepted arrives as a whole";
}

TEST(tcp_link, a_server_that_does_not_answer_is_given_up_after_the_time_out) {
  const tcp_end server(0, 0);
  std::vector<watcher> heard(3);
  std::vector<std::unique_ptr<link>> links;
  for (auto& each : heard)
    links.push_back(testing::open(server.uri(), each, {.connect_timeout = 100ms}));
  const auto timed_out = [](watcher& each) {
    return each.last_status().reason.find("no answer (timed out)") != std::string::npos;
  };
  EXPECT_TRUE(testing::eventually([&] { return std::any_of(heard.begin(), heard.end(), timed_out); }));
}

} // namespace tcp_link_test
} // namespace godwit::io::link
