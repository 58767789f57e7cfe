#include "io/link/link.hpp"

#include <atomic>
#include <future>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "tests/io/link/far_ends.hpp"
#include "tests/io/link/watcher.hpp"

namespace godwit::io::link {
namespace link_test {

using namespace std::chrono_literals;
using testing::bytes_of;
using testing::watcher;
using clock = std::chrono::steady_clock;

TEST(link, the_phases_have_names) {
  EXPECT_EQ(name_of(link_phase::connecting), "connecting");
  EXPECT_EQ(name_of(link_phase::up), "up");
  EXPECT_EQ(name_of(link_phase::down), "down");
}

TEST(link, what_can_never_work_does_not_open) {
  watcher heard;
  const auto where = *parse_uri("udpin://127.0.0.1:0");
  const auto refused = [&](const uri& asked, const link_options& options) {
    const auto opened = open_link(asked, heard.callbacks(), options);
    return !opened && !opened.error().empty();
  };
  EXPECT_TRUE(refused(where, {.first_retry = 0ms}));
  EXPECT_TRUE(refused(where, {.serial_retry_cap = 2'001ms}));
  EXPECT_TRUE(refused(where, {.udp_retry_cap = 5'001ms}));
  EXPECT_TRUE(refused(where, {.tcp_retry_cap = 99ms})) << "below the first retry";
  EXPECT_TRUE(refused(where, {.connect_timeout = 0ms}));
  EXPECT_TRUE(refused(where, {.send_queue_bytes = 65'506}));
  EXPECT_TRUE(refused(where, {.max_peers = 0}));
  EXPECT_TRUE(refused(where, {.forget_peer_after = 0ms}));
  EXPECT_TRUE(refused({.which = uri::kind::serial, .host = {}, .port = 0, .device = "tty", .baud = 57'600}, {}));
  EXPECT_TRUE(refused({.which = uri::kind::tcp, .host = "a", .port = 1, .device = "/dev/tty", .baud = 0}, {}));
  EXPECT_FALSE(open_link(where, {}));
}

TEST(link, the_callback_for_the_status_may_be_left_out) {
  std::atomic<int> received{0};
  const auto opened = open_link(*parse_uri("udpin://127.0.0.1:0"),
                                {[&](peer_id, std::span<const std::byte>, bool) { ++received; }, {}});
  ASSERT_TRUE(opened);
  const auto& link = *opened;
  ASSERT_TRUE(testing::eventually([&] { return testing::port_of(*link) != 0; }));
  const testing::udp_end peer;
  peer.send(testing::port_of(*link), "x");
  EXPECT_TRUE(testing::eventually([&] { return received == 1; }));
}

TEST(link, two_links_reach_each_other_over_udp) {
  watcher server_heard;
  watcher client_heard;
  const auto server = testing::open("udpin://127.0.0.1:0", server_heard);
  ASSERT_TRUE(server_heard.wait_for_phase(link_phase::up));
  const auto client = testing::open("udpout://localhost:" + std::to_string(testing::port_of(*server)), client_heard);
  ASSERT_TRUE(client_heard.wait_for_phase(link_phase::up)) << client_heard.last_status().reason;
  ASSERT_TRUE(client->send(bytes_of("ping")));
  ASSERT_TRUE(server_heard.wait_for_bytes("ping"));
  ASSERT_TRUE(server->send(bytes_of("pong")));
  EXPECT_TRUE(client_heard.wait_for_bytes("pong"));
}

TEST(link, both_families_are_heard_where_no_host_is_named) {
  watcher server_heard;
  const auto server = testing::open("udp://:0", server_heard);
  ASSERT_TRUE(server_heard.wait_for_phase(link_phase::up)) << server_heard.last_status().reason;
  const auto port = std::to_string(testing::port_of(*server));
  watcher client_heard;
  const auto client = testing::open("udpout://127.0.0.1:" + port, client_heard);
  ASSERT_TRUE(client_heard.wait_for_phase(link_phase::up));
  ASSERT_TRUE(client->send(bytes_of("four")));
  ASSERT_TRUE(server_heard.wait_for_bytes("four"));
  ASSERT_TRUE(server->send(bytes_of("answer"), server_heard.last_chunk().from));
  EXPECT_TRUE(client_heard.wait_for_bytes("answer"));
  watcher six_heard;
  const auto six = testing::open("udpout://[::1]:" + port, six_heard);
  ASSERT_TRUE(six_heard.wait_for([](const watcher& w) { return w.statuses.size() >= 2; }));
  if (six_heard.last_status().phase == link_phase::up) { // else this computer has no IPv6
    ASSERT_TRUE(six->send(bytes_of("six")));
    EXPECT_TRUE(server_heard.wait_for_bytes("foursix"));
  }
}

TEST(link, a_callback_may_send) {
  const testing::udp_end peer;
  std::atomic<link*> answers{nullptr};
  auto opened =
      open_link(*parse_uri("udpin://127.0.0.1:0"), {[&](peer_id from, std::span<const std::byte> bytes, bool) {
                                                      if (auto* link = answers.load())
                                                        link->send(bytes, from);
                                                    },
                                                    {}});
  ASSERT_TRUE(opened);
  answers = opened->get();
  ASSERT_TRUE(testing::eventually([&] { return testing::port_of(**opened) != 0; }));
  peer.send(testing::port_of(**opened), "echo");
  EXPECT_EQ(peer.receive(), "echo");
}

TEST(link, senders_in_many_threads_do_not_mix_their_chunks_on_a_stream) {
  testing::tcp_end server;
  watcher heard;
  const auto link = testing::open(server.uri(), heard);
  server.accept();
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
  constexpr std::size_t chunk_bytes = 100;
  constexpr int threads = 4;
  std::atomic<std::size_t> accepted{0};
  std::vector<std::thread> senders;
  for (int n = 0; n < threads; ++n) {
    senders.emplace_back([&, letter = static_cast<char>('a' + n)] {
      const std::string chunk(chunk_bytes, letter);
      for (int sent = 0; sent < 1'000; ++sent)
        accepted += link->send(bytes_of(chunk)) ? 1 : 0;
    });
  }
  for (auto& each : senders)
    each.join();
  const auto all = server.read(accepted * chunk_bytes);
  ASSERT_EQ(all.size(), accepted * chunk_bytes);
  for (std::size_t at = 0; at < all.size(); at += chunk_bytes)
    ASSERT_EQ(all.substr(at, chunk_bytes), std::string(chunk_bytes, all[at]));
}

TEST(link, links_of_every_kind_are_made_and_destroyed_quickly_while_traffic_runs) {
  const testing::serial_line line;
  const testing::tcp_end server;
  const testing::udp_end peer;
  const std::string uris[] = {"udpin://127.0.0.1:0",
                              "udpout://127.0.0.1:" + std::to_string(peer.port()),
                              line.uri(),
                              server.uri(),
                              "udpout://127.0.0.1:" + std::to_string(testing::unused_udp_port()),
                              "serial:///dev/ttyNoSuchDevice",
                              "tcp://no-such-host.invalid:1"};
  for (int n = 0; n < 60; ++n) {
    for (const auto& text : uris) {
      watcher heard;
      const auto link = testing::open(text, heard);
      if (n % 3 != 0) {
        ASSERT_TRUE(heard.wait_for([](const watcher& w) { return !w.statuses.empty(); }));
      }
      static_cast<void>(link->send(bytes_of("traffic")));
      static_cast<void>(link->counters());
    }
  }
}

TEST(link, a_link_ends_while_its_callbacks_are_busy_and_calls_nobody_afterwards) {
  const testing::udp_end peer;
  for (int n = 0; n < 20; ++n) {
    std::atomic<bool> called{false};
    std::atomic<bool> ended{false};
    std::atomic<bool> called_too_late{false};
    const auto slow = [&](peer_id, std::span<const std::byte>, bool) {
      called = true;
      std::this_thread::sleep_for(1ms);
      called_too_late = called_too_late || ended;
    };
    auto opened = open_link(*parse_uri("udpin://127.0.0.1:0"), {slow, {}});
    ASSERT_TRUE(opened);
    ASSERT_TRUE(testing::eventually([&] { return testing::port_of(**opened) != 0; }));
    for (int sent = 0; sent < 100; ++sent)
      peer.send(testing::port_of(**opened), "x");
    ASSERT_TRUE(testing::eventually([&] { return called.load(); }));
    opened->reset();
    ended = true;
    EXPECT_FALSE(called_too_late);
  }
}

TEST(link, a_name_server_that_does_not_answer_does_not_hold_up_the_end) {
  watcher heard;
  auto link = testing::open("tcp://no-such-host.invalid:5760", heard);
  ASSERT_TRUE(heard.wait_for([](const watcher& w) { return !w.statuses.empty(); }));
  const auto began = clock::now();
  link.reset();
  EXPECT_LT(clock::now() - began, 1s);
}

// Opens a link whose status callback is HOSTILE, and waits for the end that must come.
void run_with(const std::function<void(std::unique_ptr<link>&)>& hostile) {
  std::promise<void> is_made;
  std::unique_ptr<link> made;
  auto opened = open_link(*parse_uri("udpin://127.0.0.1:0"), {[](peer_id, std::span<const std::byte>, bool) {},
                                                              [&](const link_status&) {
                                                                is_made.get_future().wait();
                                                                hostile(made);
                                                              }});
  made = std::move(*opened);
  is_made.set_value();
  std::this_thread::sleep_for(testing::patience); // in the process that is to die
}

TEST(link_death_test, an_exception_out_of_a_callback_ends_the_process) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto throws = [](std::unique_ptr<link>&) { throw std::runtime_error("not allowed"); };
  EXPECT_DEATH(run_with(throws), "not allowed");
}

TEST(link_death_test, a_link_that_is_destroyed_inside_its_callback_ends_the_process) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto destroys = [](std::unique_ptr<link>& mine) { mine.reset(); };
  EXPECT_DEATH(run_with(destroys), "inside one of its own callbacks");
}

} // namespace link_test
} // namespace godwit::io::link
