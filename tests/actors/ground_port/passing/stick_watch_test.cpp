#include "actors/ground_port/passing/stick_watch.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>

namespace godwit::ground_port::passing {
namespace stick_watch_test {

constexpr io::mavlink::sender anna{255, 190};
constexpr io::mavlink::sender bert{254, 190};
constexpr std::int64_t ms = 1'000'000;

struct sticks {
  std::int16_t x = 0;
  std::int16_t y = 0;
  std::int16_t z = 500;
  std::int16_t r = 0;
  std::uint16_t buttons = 0;
};

class stick_watch_of_stations : public testing::Test {
protected:
  bool is_held(const sticks& how, io::mavlink::sender by = anna) {
    std::vector<std::byte> payload;
    for (const auto each : {static_cast<std::uint16_t>(how.x), static_cast<std::uint16_t>(how.y),
                            static_cast<std::uint16_t>(how.z), static_cast<std::uint16_t>(how.r), how.buttons}) {
      payload.push_back(static_cast<std::byte>(each & 0xFFU));
      payload.push_back(static_cast<std::byte>(each >> 8U));
    }
    payload.push_back(std::byte{1});
    now_ns_ += 50 * ms;
    return watch_.is_held(by, payload, now_ns_);
  }
  std::int64_t now_ns_ = 0;
  stick_watch watch_;
};

TEST_F(stick_watch_of_stations, sticks_in_the_middle_are_not_held_wherever_the_throttle_rests) {
  for (const std::int16_t throttle : {0, 500, 1000, -1000}) {
    watch_ = {};
    for (int i = 0; i < 100; ++i)
      EXPECT_FALSE(is_held({.x = 20, .y = -30, .z = throttle, .r = 50})) << throttle;
  }
}

TEST_F(stick_watch_of_stations, a_stick_that_is_moved_by_more_than_a_twentieth_is_held) {
  EXPECT_TRUE(is_held({.x = 51}));
  EXPECT_TRUE(is_held({.y = -51}));
  EXPECT_TRUE(is_held({.r = 1000}));
}

TEST_F(stick_watch_of_stations, the_throttle_is_held_when_it_leaves_where_it_was_first_however_slowly) {
  EXPECT_FALSE(is_held({.z = 0}));
  bool was_held = false;
  for (std::int16_t z = 0; z <= 100; z += 5)
    was_held = is_held({.z = z}) || was_held;
  EXPECT_TRUE(was_held);
  EXPECT_FALSE(is_held({.z = 100})) << "there it rests now";
}

TEST_F(stick_watch_of_stations, a_button_that_is_pressed_or_let_go_is_a_persons) {
  EXPECT_FALSE(is_held({.buttons = 4})) << "a switch that was on before";
  EXPECT_TRUE(is_held({.buttons = 5}));
  EXPECT_FALSE(is_held({.buttons = 5}));
  EXPECT_TRUE(is_held({.buttons = 4}));
}

TEST_F(stick_watch_of_stations, an_axis_that_is_absent_is_not_looked_at) {
  constexpr auto absent = std::numeric_limits<std::int16_t>::max();
  EXPECT_FALSE(is_held({.x = absent, .y = absent, .z = absent, .r = absent}));
}

TEST_F(stick_watch_of_stations, stations_have_one_each_and_begin_anew_after_a_silence) {
  EXPECT_FALSE(is_held({.z = 0}));
  EXPECT_FALSE(is_held({.z = 1000}, bert));
  EXPECT_FALSE(is_held({.z = 0}));
  now_ns_ += stick_watch::silent_ns + ms;
  EXPECT_FALSE(is_held({.z = 800}));
}

} // namespace stick_watch_test
} // namespace godwit::ground_port::passing
