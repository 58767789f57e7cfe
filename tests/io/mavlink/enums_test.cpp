#include <gtest/gtest.h>

#include "io/fields/json_text.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::io::mavlink {
namespace enums_test {

TEST(enums, have_the_published_numbers) {
  EXPECT_EQ(number(mav_cmd::mission_start), 300);
  EXPECT_EQ(number(mav_cmd::nav_fence_circle_exclusion), 5004);
  EXPECT_EQ(number(mav_mission_result::invalid_sequence), 13);
  EXPECT_EQ(number(mav_mission_result::operation_cancelled), 15);
  EXPECT_EQ(number(mav_result::not_in_control), 10);
  EXPECT_EQ(number(mav_mode_flag::safety_armed), 128);
  EXPECT_EQ(number(mav_severity::info), 6);
  EXPECT_EQ(number(mission_state::complete), 5);
  EXPECT_EQ(number(mav_state::flight_termination), 8);
}

TEST(enums, are_rendered_as_text_and_unknown_numbers_as_themselves) {
  std::string text;
  append_json_value(text, mav_result::temporarily_rejected);
  append_json_value(text, mav_mission_type::all);
  append_json_value(text, static_cast<mav_cmd>(42));
  EXPECT_EQ(text, R"("temporarily_rejected""all"42)");
}

} // namespace enums_test
} // namespace godwit::io::mavlink
