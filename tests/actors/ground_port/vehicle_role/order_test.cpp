#include "actors/ground_port/vehicle_role/order.hpp"

#include <gtest/gtest.h>

namespace godwit::ground_port::vehicle_role {
namespace order_test {

TEST(order, a_command_in_floats_is_read) {
  const auto read = read_order({255, 190}, mavlink::command_long{.target_system = 1,
                                                                 .target_component = 191,
                                                                 .command = 300,
                                                                 .confirmation = 2,
                                                                 .param1 = 1,
                                                                 .param2 = 3,
                                                                 .param5 = 50.5F,
                                                                 .param6 = 36.25F,
                                                                 .param7 = 80});
  EXPECT_EQ(read.from, (mavlink::sender{255, 190}));
  EXPECT_EQ(read.command, 300);
  EXPECT_EQ(read.target_component, 191);
  EXPECT_FALSE(read.is_in_integers);
  EXPECT_EQ(read.confirmation, 2);
  EXPECT_EQ(read.param1, 1.0F);
  EXPECT_EQ(read.param2, 3.0F);
  EXPECT_EQ(read.x, 50.5);
  EXPECT_EQ(read.y, 36.25);
  EXPECT_EQ(read.z, 80.0F);
}

TEST(order, integers_of_a_global_frame_are_read_as_degrees) {
  for (const std::uint8_t frame : {0, 3, 5, 6, 10, 11}) {
    const auto read = read_order({255, 190}, mavlink::command_int{.frame = frame, .x = 500'000'001, .y = -364'000'000});
    EXPECT_TRUE(read.is_in_integers);
    EXPECT_NEAR(read.x, 50.0000001, 1e-12);
    EXPECT_NEAR(read.y, -36.4, 1e-12);
  }
}

TEST(order, integers_of_a_local_frame_are_read_as_metres_and_without_a_frame_as_numbers) {
  EXPECT_DOUBLE_EQ(read_order({}, mavlink::command_int{.frame = 1, .x = 15'000}).x, 1.5);
  EXPECT_DOUBLE_EQ(read_order({}, mavlink::command_int{.frame = 2, .x = 7}).x, 7);
}

TEST(order, the_answer_names_the_command_and_its_sender) {
  const auto answer = answer_to({.from = {255, 190}, .command = 300}, mavlink::mav_result::in_progress, 40, 7);
  EXPECT_EQ(answer.command, 300);
  EXPECT_EQ(answer.result, mavlink::number(mavlink::mav_result::in_progress));
  EXPECT_EQ(answer.progress, 40);
  EXPECT_EQ(answer.result_param2, 7);
  EXPECT_EQ(answer.target_system, 255);
  EXPECT_EQ(answer.target_component, 190);
}

} // namespace order_test
} // namespace godwit::ground_port::vehicle_role
