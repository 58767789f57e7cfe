// serial_opener and stream_link together, over pseudo-terminals.
#include "io/link/serial_port.hpp"

#include <thread>

#include <gtest/gtest.h>

#include "io/link/stream_link.hpp"
#include "tests/io/link/far_ends.hpp"
#include "tests/io/link/watcher.hpp"

namespace godwit::io::link {
namespace serial_link_test {

using namespace std::chrono_literals;
using testing::bytes_of;
using testing::serial_line;
using testing::watcher;
using clock = std::chrono::steady_clock;

constexpr auto required_to_be_back_within = 2s;

TEST(serial_link, bytes_go_both_ways_unchanged) {
  serial_line line;
  watcher heard;
  const auto link = testing::open(line.uri(), heard);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up)) << heard.last_status().reason;
  std::string every_byte;
  for (int value = 0; value < 256; ++value)
    every_byte += static_cast<char>(value);
  EXPECT_TRUE(link->send(bytes_of(every_byte)));
  EXPECT_EQ(line.read(every_byte.size()), every_byte);
  line.write(every_byte);
  EXPECT_TRUE(heard.wait_for_bytes(every_byte));
  EXPECT_EQ(heard.last_chunk().from, only_peer);
  EXPECT_FALSE(heard.last_chunk().is_datagram);
  EXPECT_EQ(link->counters().tx_bytes, 256U);
  EXPECT_EQ(link->counters().rx_bytes, 256U);
  EXPECT_EQ(link->description(), line.uri());
}

// The wait between tries has grown to its cap when the line comes back: the longest that it can take.
TEST(serial_link, a_line_that_was_gone_for_long_is_up_again_within_2_s) {
  serial_line line;
  watcher heard;
  const auto link = testing::open(line.uri(), heard);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
  line.unplug();
  ASSERT_TRUE(heard.wait_for_phase(link_phase::down));
  ASSERT_TRUE(heard.wait_for_reason("no such device; is the autopilot plugged in?"));
  ASSERT_TRUE(testing::eventually([&] { return link->counters().open_failures >= 5; }));
  EXPECT_FALSE(link->send(bytes_of("into nothing")));
  const auto back_at = clock::now();
  line.plug_in();
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
  const auto took = clock::now() - back_at;
  EXPECT_LE(took, required_to_be_back_within);
  RecordProperty("back_after_ms", static_cast<int>(took / 1ms));
  EXPECT_EQ(heard.last_status().reconnects, 1U);
  line.write("again");
  EXPECT_TRUE(heard.wait_for_bytes("again"));
}

TEST(serial_link, another_terminal_under_the_same_name_is_found) {
  serial_line line;
  watcher heard;
  const auto link = testing::open(line.uri(), heard);
  for (std::uint64_t n = 1; n <= 5; ++n) {
    ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
    line.hang_up();
    line.plug_in();
    ASSERT_TRUE(heard.wait_for([n](const watcher& w) { return w.statuses.back().reconnects == n; }));
    ASSERT_TRUE(link->send(bytes_of("hello")));
    EXPECT_EQ(line.read(5), "hello");
  }
  EXPECT_EQ(link->counters().losses, 5U);
}

TEST(serial_link, a_device_that_is_missing_at_first_is_used_when_it_appears) {
  serial_line line;
  line.unplug();
  watcher heard;
  const auto link = testing::open(line.uri(), heard);
  ASSERT_TRUE(heard.wait_for_reason("no such device; is the autopilot plugged in?"));
  EXPECT_EQ(heard.last_status().phase, link_phase::down);
  line.plug_in();
  EXPECT_TRUE(heard.wait_for_phase(link_phase::up));
  EXPECT_EQ(heard.last_status().reconnects, 0U);
}

TEST(serial_link, a_line_that_another_link_holds_is_taken_over_when_it_is_free) {
  serial_line line;
  watcher first_heard;
  watcher second_heard;
  auto first = testing::open(line.uri(), first_heard);
  ASSERT_TRUE(first_heard.wait_for_phase(link_phase::up));
  const auto second = testing::open(line.uri(), second_heard);
  ASSERT_TRUE(second_heard.wait_for_reason("another program holds the device"));
  first.reset();
  EXPECT_TRUE(second_heard.wait_for_phase(link_phase::up));
}

TEST(serial_link, when_nobody_reads_the_queue_stays_bounded_and_what_does_not_fit_is_counted) {
  serial_line line;
  watcher heard;
  const link_options options;
  const auto link = testing::open(line.uri(), heard, options);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
  const std::string frame(280, 'x');
  std::uint64_t accepted = 0;
  std::uint64_t refused = 0;
  for (int n = 0; n < 20'000; ++n) {
    ++(link->send(bytes_of(frame)) ? accepted : refused);
    ASSERT_LE(link->counters().tx_queued_bytes, options.send_queue_bytes);
  }
  EXPECT_GT(refused, 19'000U);
  EXPECT_EQ(link->counters().tx_dropped, refused);
  // Then somebody reads, and gets whole frames, exactly those that were accepted.
  const auto bytes = static_cast<std::size_t>(accepted) * frame.size();
  EXPECT_EQ(line.read(bytes), std::string(bytes, 'x'));
  EXPECT_TRUE(testing::eventually([&] { return link->counters().tx_chunks == accepted; }));
  EXPECT_EQ(link->counters().tx_queued_bytes, 0U);
}

TEST(serial_link, what_waits_is_thrown_away_and_counted_when_the_line_goes) {
  serial_line line;
  watcher heard;
  const auto link = testing::open(line.uri(), heard);
  ASSERT_TRUE(heard.wait_for_phase(link_phase::up));
  const std::string frame(280, 'x');
  std::uint64_t sent = 0;
  while (link->send(bytes_of(frame)))
    ++sent;
  line.hang_up();
  line.plug_in();
  ASSERT_TRUE(heard.wait_for([](const watcher& w) { return w.statuses.back().reconnects == 1; }));
  const auto counted = link->counters();
  EXPECT_EQ(counted.tx_queued_bytes, 0U);
  EXPECT_EQ(counted.tx_chunks + counted.tx_dropped, sent + 1);
  ASSERT_TRUE(link->send(bytes_of("new")));
  EXPECT_EQ(line.read(3), "new") << "nothing old comes out of the new line";
}

} // namespace serial_link_test
} // namespace godwit::io::link
