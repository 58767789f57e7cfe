#include <gtest/gtest.h>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/mission.hpp"
#include "programs/godwit-sim/host/hosted_vehicle.hpp"

namespace godwit::sim {

namespace event_watch_test {

using sentences = std::vector<std::string>;
namespace mavlink = io::mavlink;

vehicle_picture standing() {
  vehicle_picture picture;
  picture.mode = "HOLD";
  picture.mission_state = "idle";
  picture.battery_percent = 100;
  picture.world_ms = 1'000;
  return picture;
}

mavlink::frame_buffer reached(std::uint16_t sequence) {
  return mavlink::encode(mavlink::mission_item_reached{.seq = sequence}, {1, 1}, 0);
}

TEST(event_watch, the_first_picture_is_no_news_and_neither_is_the_same_again) {
  event_watch watch;
  EXPECT_EQ(watch.look(standing()), sentences{});
  EXPECT_EQ(watch.look(standing()), sentences{});
}

TEST(event_watch, each_change_is_told_once) {
  event_watch watch;
  auto now = standing();
  static_cast<void>(watch.look(now));
  now.mission_count = 3;
  EXPECT_EQ(watch.look(now), sentences{"has a mission of 3 items"});
  now.armed = true;
  now.mode = "AUTO";
  now.mission_state = "running";
  EXPECT_EQ(watch.look(now), (sentences{"armed", "mode AUTO", "mission running, item 0 of a plan of 3"}));
  now.in_air = true;
  EXPECT_EQ(watch.look(now), sentences{"took off"});
  now.has_position = false;
  EXPECT_EQ(watch.look(now), sentences{"has lost its position"});
  now.has_position = true;
  now.in_air = false;
  now.armed = false;
  now.mission_state = "completed";
  EXPECT_EQ(watch.look(now), (sentences{"has a position", "disarmed", "landed", "mission completed"}));
  now.mission_count = 0;
  now.world_ms = 0;
  EXPECT_EQ(watch.look(now), (sentences{"started again", "has no mission any more"}));
}

TEST(event_watch, the_battery_is_told_in_steps) {
  event_watch watch;
  auto now = standing();
  static_cast<void>(watch.look(now));
  std::size_t told = 0;
  for (int percent = 100; percent >= 0; --percent) {
    now.battery_percent = percent;
    told += watch.look(now).size();
  }
  EXPECT_EQ(told, 10U);
}

TEST(event_watch, an_item_that_is_reached_is_told_once_however_often_it_is_sent) {
  event_watch watch;
  EXPECT_EQ(watch.sent(reached(2).view()), "item 2 reached");
  EXPECT_EQ(watch.sent(reached(2).view()), "");
  EXPECT_EQ(watch.sent(reached(3).view()), "item 3 reached");
}

TEST(event_watch, an_item_is_told_again_when_the_mission_runs_again) {
  event_watch watch;
  auto now = standing();
  static_cast<void>(watch.look(now));
  EXPECT_EQ(watch.sent(reached(0).view()), "item 0 reached");
  now.mission_state = "running";
  static_cast<void>(watch.look(now));
  EXPECT_EQ(watch.sent(reached(0).view()), "item 0 reached");
}

TEST(event_watch, what_the_vehicle_says_is_told) {
  event_watch watch;
  mavlink::statustext text;
  std::copy_n("Mission started", 15, text.text.begin());
  EXPECT_EQ(watch.sent(mavlink::encode(text, {1, 1}, 0).view()), "says: Mission started");
}

TEST(event_watch, a_station_is_told_when_it_is_heard_first_and_their_number_is_bounded) {
  event_watch watch;
  const auto from = [](std::uint8_t system) { return mavlink::encode(mavlink::heartbeat{}, {system, 190}, 0); };
  EXPECT_EQ(watch.heard(from(255).view()), "hears 255/190");
  EXPECT_EQ(watch.heard(from(255).view()), "");
  EXPECT_EQ(watch.heard(reached(1).view()), "") << "no heartbeat";
  for (std::uint8_t system = 1; system < 100; ++system)
    static_cast<void>(watch.heard(from(system).view()));
  EXPECT_EQ(watch.heard(from(200).view()), "");
}

} // namespace event_watch_test

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
