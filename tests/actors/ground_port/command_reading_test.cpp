#include "actors/ground_port/command_reading.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace godwit::ground_port {
namespace command_reading_test {

using mavlink::mav_cmd;
using mavlink::mav_result;
using operators::command_kind;

constexpr mavlink::sender station{255, 190};
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::int32_t absent = std::numeric_limits<std::int32_t>::max();

mavlink::command_int reposition() {
  return {.frame = mavlink::number(mavlink::mav_frame::global_relative_alt),
          .command = mavlink::number(mav_cmd::do_reposition),
          .param1 = -1,
          .param2 = 1,
          .param3 = 0,
          .param4 = nan,
          .x = 500'000'001,
          .y = -364'000'000,
          .z = 30.5F};
}

mavlink::command_long pause_continue(float which) {
  return {.command = mavlink::number(mav_cmd::do_pause_continue), .param1 = which};
}

template <class M>
tl::expected<operators::command, word_refusal> read(const M& m, std::optional<double> home_altitude_m = 100.0) {
  return read_word(vehicle_role::read_order(station, m), {mavlink::mav_autopilot::generic, home_altitude_m, {}});
}

template <class M>
mav_result result_of(const M& m, std::optional<double> home_altitude_m = 100.0) {
  const auto command = read(m, home_altitude_m);
  return command ? mav_result::accepted : command.error().result;
}

// DO_REPOSITION with one thing changed.
template <class T>
mavlink::command_int with(T mavlink::command_int::*field, T value) {
  auto result = reposition();
  result.*field = value;
  return result;
}

TEST(word_reading, a_reposition_is_go_to_with_the_place_and_who_says_it) {
  const auto command = read(reposition());
  ASSERT_TRUE(command);
  EXPECT_EQ(command->kind, command_kind::go_to);
  EXPECT_EQ(command->by, "station 255/190");
  ASSERT_TRUE(command->place);
  EXPECT_NEAR(command->place->latitude, 50.0000001, 1e-12);
  EXPECT_NEAR(command->place->longitude, -36.4, 1e-12);
  EXPECT_DOUBLE_EQ(command->place->altitude_m, 30.5);
}

TEST(word_reading, altitudes_above_home_are_taken_as_they_are_whether_or_not_homes_is_known) {
  for (const std::uint8_t frame : {3, 6})
    for (const auto home : {std::optional<double>(), std::optional(100.0)}) {
      const auto command = read(with(&mavlink::command_int::frame, frame), home);
      ASSERT_TRUE(command);
      EXPECT_DOUBLE_EQ(command->place->altitude_m, 30.5);
    }
}

TEST(word_reading, altitudes_above_the_sea_are_counted_from_home) {
  for (const std::uint8_t frame : {0, 5}) {
    auto order = with(&mavlink::command_int::frame, frame);
    order.z = 480.5F;
    const auto command = read(order, 450.25);
    ASSERT_TRUE(command);
    EXPECT_DOUBLE_EQ(command->place->altitude_m, 30.25);
  }
}

TEST(word_reading, altitudes_above_the_sea_are_refused_for_now_while_homes_is_not_known) {
  for (const std::uint8_t frame : {0, 5}) {
    const auto command = read(with(&mavlink::command_int::frame, frame), std::nullopt);
    ASSERT_FALSE(command);
    EXPECT_EQ(command.error().result, mav_result::temporarily_rejected);
    EXPECT_EQ(command.error().text, "Go to: home's altitude is not known yet");
  }
}

TEST(word_reading, all_other_frames_are_not_supported) {
  for (int frame = 0; frame < 256; ++frame) {
    const bool is_taken = frame == 0 || frame == 3 || frame == 5 || frame == 6;
    EXPECT_EQ(result_of(with(&mavlink::command_int::frame, static_cast<std::uint8_t>(frame))),
              is_taken ? mav_result::accepted : mav_result::unsupported_mav_frame)
        << frame;
  }
}

TEST(word_reading, a_reposition_in_floats_is_to_come_in_integers) {
  EXPECT_EQ(result_of(mavlink::command_long{.command = mavlink::number(mav_cmd::do_reposition)}),
            mav_result::command_int_only);
}

TEST(word_reading, an_ArduPilot_knows_no_reposition_in_floats_as_on_a_direct_line) {
  const auto command = read_word(
      vehicle_role::read_order(station, mavlink::command_long{.command = mavlink::number(mav_cmd::do_reposition)}),
      {mavlink::mav_autopilot::ardupilotmega, 100.0, {}});
  ASSERT_FALSE(command);
  EXPECT_EQ(command.error().result, mav_result::unsupported);
}

// As QGroundControl pauses a PX4, changes its altitude and sends it to a place.
class word_reading_px4 : public testing::Test {
protected:
  [[nodiscard]] static mavlink::command_long in_floats(float latitude, float longitude, float altitude_m) {
    mavlink::command_long m;
    m.command = mavlink::number(mav_cmd::do_reposition);
    m.param1 = -1;
    m.param2 = 1;
    m.param4 = nan;
    m.param5 = latitude;
    m.param6 = longitude;
    m.param7 = altitude_m;
    return m;
  }
  template <class M>
  [[nodiscard]] tl::expected<operators::command, word_refusal> read_by_px4(const M& m) const {
    return read_word(vehicle_role::read_order(station, m), told);
  }
  told_by_vehicle told{mavlink::mav_autopilot::px4, 488.0, mission::position{47.4, 8.5, 25}};
};

TEST_F(word_reading_px4, nothing_at_all_is_a_pause) {
  const auto command = read_by_px4(in_floats(nan, nan, nan));
  ASSERT_TRUE(command);
  EXPECT_EQ(command->kind, command_kind::pause);
  auto integers = reposition();
  integers.x = integers.y = std::numeric_limits<std::int32_t>::max();
  integers.z = nan;
  EXPECT_EQ(read_by_px4(integers)->kind, command_kind::pause);
}

TEST_F(word_reading_px4, an_altitude_alone_is_a_way_up_or_down_where_it_is_and_counts_above_the_sea) {
  const auto command = read_by_px4(in_floats(nan, nan, 508));
  ASSERT_TRUE(command);
  EXPECT_EQ(command->kind, command_kind::go_to);
  ASSERT_TRUE(command->place);
  EXPECT_NEAR(command->place->latitude, 47.4, 1e-9);
  EXPECT_NEAR(command->place->longitude, 8.5, 1e-9);
  EXPECT_NEAR(command->place->altitude_m, 20, 1e-6);
}

// QGroundControl's Pause has a slider of the altitude: left alone, it sends the present one when its hold is answered.
TEST_F(word_reading_px4, the_altitude_at_which_it_is_is_a_pause) {
  EXPECT_EQ(read_by_px4(in_floats(nan, nan, 513))->kind, command_kind::pause);
  EXPECT_EQ(read_by_px4(in_floats(nan, nan, 513.9F))->kind, command_kind::pause);
  EXPECT_EQ(read_by_px4(in_floats(nan, nan, 514.5F))->kind, command_kind::go_to);
  EXPECT_EQ(read_by_px4(in_floats(nan, nan, 511.5F))->kind, command_kind::go_to);
  EXPECT_EQ(read_by_px4(in_floats(47.4F, 8.5F, 513))->kind, command_kind::go_to);
}

TEST_F(word_reading_px4, the_altitude_at_which_a_hold_was_asked_for_is_a_pause_while_it_still_climbs) {
  told.held_from_m = 20;
  EXPECT_EQ(read_by_px4(in_floats(nan, nan, 508))->kind, command_kind::pause);
  EXPECT_EQ(read_by_px4(in_floats(nan, nan, 511))->kind, command_kind::pause);
  EXPECT_EQ(read_by_px4(in_floats(nan, nan, 506.5F))->kind, command_kind::go_to);
  EXPECT_EQ(read_by_px4(in_floats(nan, nan, 514.5F))->kind, command_kind::go_to);
}

TEST_F(word_reading_px4, a_place_in_floats_counts_above_the_sea_too) {
  const auto command = read_by_px4(in_floats(47.5F, 8.25F, 518));
  ASSERT_TRUE(command);
  EXPECT_NEAR(command->place->latitude, 47.5, 1e-5);
  EXPECT_NEAR(command->place->altitude_m, 30, 1e-6);
}

TEST_F(word_reading_px4, a_place_without_an_altitude_keeps_the_one_that_it_has) {
  const auto command = read_by_px4(in_floats(47.5F, 8.25F, nan));
  ASSERT_TRUE(command);
  EXPECT_NEAR(command->place->altitude_m, 25, 1e-6);
}

TEST_F(word_reading_px4, where_it_is_has_to_be_known) {
  told.here.reset();
  const auto command = read_by_px4(in_floats(nan, nan, 508));
  ASSERT_FALSE(command);
  EXPECT_EQ(command.error().result, mav_result::temporarily_rejected);
}

TEST_F(word_reading_px4, half_a_place_is_none) {
  EXPECT_FALSE(read_by_px4(in_floats(nan, 8.25F, 508)));
  EXPECT_FALSE(read_by_px4(in_floats(47.5F, nan, 508)));
}

TEST(word_reading, a_speed_is_refused_unless_it_is_the_default) {
  for (const float none : {-1.0F, nan})
    EXPECT_EQ(result_of(with(&mavlink::command_int::param1, none)), mav_result::accepted) << none;
  for (const float speed : {0.0F, 5.0F, -2.0F, infinity, -infinity}) {
    const auto command = read(with(&mavlink::command_int::param1, speed));
    ASSERT_FALSE(command) << speed;
    EXPECT_EQ(command.error().result, mav_result::denied);
    EXPECT_EQ(command.error().text, "Go to: the speed can not be changed by it");
  }
}

TEST(word_reading, a_radius_and_a_yaw_are_ignored_when_0_or_nan_and_denied_else) {
  for (const auto which : {&mavlink::command_int::param3, &mavlink::command_int::param4}) {
    for (const float open : {0.0F, -0.0F, nan})
      EXPECT_EQ(result_of(with(which, open)), mav_result::accepted) << open;
    for (const float chosen : {1.0F, -80.0F, infinity, -infinity})
      EXPECT_EQ(result_of(with(which, chosen)), mav_result::denied) << chosen;
  }
}

TEST(word_reading, a_latitude_or_longitude_that_is_absent_is_denied) {
  EXPECT_EQ(result_of(with(&mavlink::command_int::x, absent)), mav_result::denied);
  EXPECT_EQ(result_of(with(&mavlink::command_int::y, absent)), mav_result::denied);
}

TEST(word_reading, a_place_that_is_not_on_earth_is_denied) {
  EXPECT_EQ(result_of(with(&mavlink::command_int::x, 900'000'000)), mav_result::accepted);
  EXPECT_EQ(result_of(with(&mavlink::command_int::x, 900'000'001)), mav_result::denied);
  EXPECT_EQ(result_of(with(&mavlink::command_int::x, -900'000'001)), mav_result::denied);
  EXPECT_EQ(result_of(with(&mavlink::command_int::y, -1'800'000'000)), mav_result::accepted);
  EXPECT_EQ(result_of(with(&mavlink::command_int::y, 1'800'000'001)), mav_result::denied);
  EXPECT_EQ(result_of(with(&mavlink::command_int::y, -1'800'000'001)), mav_result::denied);
}

TEST(word_reading, an_altitude_that_is_no_number_is_denied) {
  for (const float bad : {nan, infinity, -infinity})
    EXPECT_EQ(result_of(with(&mavlink::command_int::z, bad)), mav_result::denied) << bad;
}

TEST(word_reading, pause_and_continue_are_words_in_floats_and_in_integers) {
  EXPECT_EQ(read(pause_continue(0))->kind, command_kind::pause);
  EXPECT_EQ(read(pause_continue(1))->kind, command_kind::resume);
  const auto command = mavlink::number(mav_cmd::do_pause_continue);
  EXPECT_EQ(read(mavlink::command_int{.command = command, .param1 = 0})->kind, command_kind::pause);
  EXPECT_EQ(read(mavlink::command_int{.command = command, .param1 = 1})->kind, command_kind::resume);
  EXPECT_EQ(read(pause_continue(0))->by, "station 255/190");
  EXPECT_FALSE(read(pause_continue(0))->place);
}

TEST(word_reading, neither_pause_nor_continue_is_denied) {
  for (const float bad : {-1.0F, 2.0F, 0.5F, nan, infinity})
    EXPECT_EQ(result_of(pause_continue(bad)), mav_result::denied) << bad;
}

TEST(word_reading, each_refusal_fits_into_one_statustext) {
  const auto home_is_unknown = read(with(&mavlink::command_int::frame, std::uint8_t{0}), std::nullopt);
  const std::array refusals{
      read(mavlink::command_long{.command = mavlink::number(mav_cmd::do_reposition)}),
      read(with(&mavlink::command_int::frame, std::uint8_t{255})),
      read(with(&mavlink::command_int::param1, 5.0F)),
      read(with(&mavlink::command_int::param3, 5.0F)),
      read(with(&mavlink::command_int::x, absent)),
      read(with(&mavlink::command_int::z, nan)),
      read(pause_continue(2)),
      home_is_unknown,
  };
  for (const auto& each : refusals) {
    ASSERT_FALSE(each);
    EXPECT_FALSE(each.error().text.empty());
    EXPECT_LE(each.error().text.size(), 50U) << each.error().text;
  }
}

} // namespace command_reading_test
} // namespace godwit::ground_port
