#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace frame_meaning_test {

using namespace godwit::io::mavlink;

TEST(frame_meaning, each_frame_of_mavlink_has_coordinates_and_withdrawn_ones_have_none) {
  int known = 0;
  for (int frame = 0; frame < 256; ++frame)
    known += coordinates_of(static_cast<std::uint8_t>(frame)).has_value() ? 1 : 0;
  EXPECT_EQ(known, 15);
  EXPECT_EQ(coordinates_of(13), std::nullopt);
  EXPECT_EQ(coordinates_of(number(mav_frame::mission)), coordinate_kind::none);
  EXPECT_EQ(coordinates_of(number(mav_frame::global_terrain_alt)), coordinate_kind::global);
  EXPECT_EQ(coordinates_of(number(mav_frame::body_frd)), coordinate_kind::local);
}

TEST(frame_meaning, exactly_the_global_frames_have_an_altitude) {
  for (int frame = 0; frame < 256; ++frame) {
    const auto number = static_cast<std::uint8_t>(frame);
    EXPECT_EQ(altitude_in(number).has_value(), coordinates_of(number) == coordinate_kind::global) << frame;
  }
  EXPECT_EQ(altitude_in(number(mav_frame::global_int)), altitude_kind::above_sea);
  EXPECT_EQ(altitude_in(number(mav_frame::global_relative_alt_int)), altitude_kind::above_home);
  EXPECT_EQ(altitude_in(number(mav_frame::global_terrain_alt_int)), altitude_kind::above_terrain);
}

TEST(frame_meaning, degrees_have_seven_decimals_and_metres_four) {
  EXPECT_EQ(units_of(coordinate_kind::global), 10'000'000);
  EXPECT_EQ(units_of(coordinate_kind::local), 10'000);
  EXPECT_EQ(units_of(coordinate_kind::none), 1);
}

} // namespace frame_meaning_test
