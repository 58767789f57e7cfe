#include "actors/vehicle_link/heard_watch.hpp"

#include <gtest/gtest.h>

#include "io/mavlink/codec.hpp"
#include "tests/actors/vehicle_link/vehicle_frames.hpp"

namespace godwit::vehicle_link {
namespace heard_watch_test {

using test::s;

template <class M>
void hear(heard_watch& by, const M& message, mavlink::sender from, std::int64_t now_ns, int times = 1) {
  for (int i = 0; i < times; ++i) {
    const auto frame = mavlink::encode(message, from, static_cast<std::uint8_t>(i));
    by.on_frame(frame.view(), now_ns);
  }
}

mavlink::heartbeat beat(mavlink::mav_type type, mavlink::mav_autopilot autopilot) {
  return {.type = mavlink::number(type), .autopilot = mavlink::number(autopilot)};
}

const auto station = beat(mavlink::mav_type::gcs, mavlink::mav_autopilot::invalid);
const auto companion = beat(mavlink::mav_type::onboard_controller, mavlink::mav_autopilot::invalid);
const auto copter = beat(mavlink::mav_type::quadrotor, mavlink::mav_autopilot::px4);

TEST(heard_watch, names_each_sender_with_what_it_is_and_its_numbers) {
  heard_watch heard({});
  hear(heard, station, {255, 190}, s, 12);
  hear(heard, companion, {1, 191}, s);
  hear(heard, copter, {1, 5}, s, 3);
  hear(heard, copter, {2, 1}, s, 2);
  hear(heard, mavlink::attitude{}, {7, 1}, s, 20);
  EXPECT_EQ(heard.sentence({}, s),
            "; heard and not accepted: autopilot 1/5 (3 heartbeats; its component has to be 1), "
            "program 1/191 (1 heartbeat), autopilot 2/1 (2 heartbeats), sender 7/1 (20 frames, no heartbeat), "
            "ground station 255/190 (12 heartbeats)");
}

TEST(heard_watch, counts_frames_that_can_not_be_used_since_the_vehicle_was_there) {
  heard_watch heard({});
  heard.restart({100, 7, 2}, s);
  EXPECT_EQ(heard.sentence({100, 7, 2}, 2 * s), "");
  EXPECT_EQ(heard.sentence({117, 8, 5}, 2 * s),
            "; heard and not accepted: 17 frames not believed, 1 frame damaged, 3 frames of MAVLink 1");
  EXPECT_EQ(heard.sentence({100, 7, 0}, 2 * s), "") << "a peer was forgotten";
}

TEST(heard_watch, forgets_who_is_silent_and_the_longest_silent_one_when_there_are_too_many) {
  heard_watch heard({});
  hear(heard, station, {255, 190}, s);
  EXPECT_EQ(heard.sentence({}, s + others_count_ns), "");
  for (std::uint8_t system = 1; system <= heard_watch::max_senders; ++system)
    hear(heard, copter, {system, 1}, s + system);
  EXPECT_EQ(heard.sentence({}, 2 * s).find("ground station"), std::string::npos);
  EXPECT_NE(heard.sentence({}, 2 * s).find("autopilot 8/1"), std::string::npos);
}

TEST(heard_watch, is_announced_when_others_are_heard_and_not_when_only_the_numbers_are_others) {
  heard_watch heard({});
  heard.restart({}, s);
  hear(heard, station, {255, 190}, s);
  EXPECT_FALSE(heard.may_be_announced(s + heard_watch::announces_after_ns - 1));
  EXPECT_TRUE(heard.may_be_announced(s + heard_watch::announces_after_ns));
  EXPECT_TRUE(heard.on_announcement({}, 6 * s));
  EXPECT_FALSE(heard.may_be_announced(7 * s));
  hear(heard, station, {255, 190}, 7 * s, 100);
  EXPECT_FALSE(heard.on_announcement({}, 12 * s));
  EXPECT_TRUE(heard.on_announcement({.damaged = 1}, 12 * s));
  EXPECT_FALSE(heard.on_announcement({.damaged = 9}, 12 * s));
}

} // namespace heard_watch_test
} // namespace godwit::vehicle_link
