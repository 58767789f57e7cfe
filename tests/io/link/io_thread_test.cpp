#include "io/link/io_thread.hpp"

#include <atomic>
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/io/link/far_ends.hpp"
#include "tests/io/link/watcher.hpp"

namespace godwit::io::link {
namespace io_thread_test {

using testing::bytes_of;
using testing::watcher;

std::ptrdiff_t threads_of_this_process() {
  const std::filesystem::directory_iterator tasks("/proc/self/task");
  return std::distance(begin(tasks), end(tasks));
}

TEST(io_thread, a_link_without_a_given_thread_has_its_own) {
  const link_thread own(nullptr);
  const auto shared = start_io_thread();
  const link_thread first(shared);
  const link_thread second(shared);
  EXPECT_EQ(&first.context(), &second.context());
  EXPECT_NE(&own.context(), &first.context());
  EXPECT_EQ(first.buffer().data(), second.buffer().data());
}

TEST(io_thread, what_runs_inside_is_done_when_the_call_returns) {
  const auto thread = start_io_thread();
  std::thread::id inside;
  thread->run_inside([&] { inside = std::this_thread::get_id(); });
  EXPECT_NE(inside, std::this_thread::get_id());
  EXPECT_NE(inside, std::thread::id());
}

TEST(io_thread, many_links_share_one_thread_and_all_of_them_work) {
  constexpr std::size_t many = 100;
  const auto thread = start_io_thread();
  const auto before = threads_of_this_process();
  std::vector<watcher> heard(many);
  std::vector<std::unique_ptr<link>> links;
  for (auto& each : heard)
    links.push_back(testing::open("udpin://127.0.0.1:0", each, {.thread = thread}));
  const testing::udp_end peer;
  for (std::size_t n = 0; n < many; ++n) {
    ASSERT_TRUE(heard[n].wait_for_phase(link_phase::up));
    peer.send(testing::port_of(*links[n]), std::to_string(n));
    ASSERT_TRUE(heard[n].wait_for_bytes(std::to_string(n)));
    ASSERT_TRUE(links[n]->send(bytes_of("answer")));
    ASSERT_EQ(peer.receive(), "answer");
  }
  EXPECT_EQ(threads_of_this_process(), before);
}

TEST(io_thread, a_link_that_ends_leaves_the_others_at_work) {
  const auto thread = start_io_thread();
  watcher first_heard;
  watcher second_heard;
  auto first = testing::open("udpin://127.0.0.1:0", first_heard, {.thread = thread});
  const auto second = testing::open("udpin://127.0.0.1:0", second_heard, {.thread = thread});
  ASSERT_TRUE(second_heard.wait_for_phase(link_phase::up));
  first.reset();
  const testing::udp_end peer;
  peer.send(testing::port_of(*second), "still there?");
  EXPECT_TRUE(second_heard.wait_for_bytes("still there?"));
}

TEST(io_thread, links_of_every_kind_come_and_go_on_a_shared_thread_while_traffic_runs) {
  const auto thread = start_io_thread();
  const testing::serial_line line;
  const testing::tcp_end server;
  const testing::udp_end peer;
  const std::string uris[] = {"udpin://127.0.0.1:0",
                              "tcpin://127.0.0.1:0",
                              "udpout://127.0.0.1:" + std::to_string(peer.port()),
                              line.uri(),
                              server.uri(),
                              "udpout://127.0.0.1:" + std::to_string(testing::unused_udp_port()),
                              "tcp://localhost:" + std::to_string(server.port()),
                              "tcp://no-such-host.invalid:1"};
  for (int n = 0; n < 60; ++n) {
    for (const auto& text : uris) {
      watcher heard;
      const auto link = testing::open(text, heard, {.thread = thread});
      if (n % 3 != 0) {
        ASSERT_TRUE(heard.wait_for([](const watcher& w) { return !w.statuses.empty(); }));
      }
      static_cast<void>(link->send(bytes_of("traffic")));
      static_cast<void>(link->counters());
    }
  }
}

TEST(io_thread, nobody_is_called_after_his_link_has_ended) {
  const auto thread = start_io_thread();
  const testing::udp_end peer;
  for (int n = 0; n < 50; ++n) {
    std::atomic<int> calls{0};
    auto opened = open_link(*parse_uri("udpin://127.0.0.1:0"),
                            {[&](peer_id, std::span<const std::byte>, bool) { ++calls; }, {}}, {.thread = thread});
    ASSERT_TRUE(opened);
    ASSERT_TRUE(testing::eventually([&] { return testing::port_of(**opened) != 0; }));
    for (int sent = 0; sent < 50; ++sent)
      peer.send(testing::port_of(**opened), "x");
    opened->reset();
    const int at_the_end = calls;
    thread->run_inside([] {}); // whatever was queued has had its turn
    EXPECT_EQ(calls, at_the_end);
  }
}

TEST(io_thread_death_test, a_link_that_is_destroyed_in_a_callback_of_another_on_its_thread_ends_the_process) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto hostile = [] {
    const auto thread = start_io_thread();
    watcher heard;
    auto link = testing::open("udpin://127.0.0.1:0", heard, {.thread = thread});
    thread->run_inside([&] { link.reset(); });
  };
  EXPECT_DEATH(hostile(), "inside one of its own callbacks");
}

} // namespace io_thread_test
} // namespace godwit::io::link
