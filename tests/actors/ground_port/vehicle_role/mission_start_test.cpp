#include "actors/ground_port/vehicle_role/mission_start.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace godwit::ground_port::vehicle_role {
namespace mission_start_test {

using io::mavlink::mav_result;

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

start_situation ready(int items = 5) {
  start_situation result;
  result.item_count = items;
  result.is_armed = true;
  return result;
}

TEST(mission_start, a_parameter_that_is_not_finite_is_denied) {
  for (const float bad : {nan_value, infinite, -infinite}) {
    EXPECT_EQ(decide_start({bad, 0}, ready()).result, mav_result::denied);
    EXPECT_EQ(decide_start({0, bad}, ready()).result, mav_result::denied);
  }
}

TEST(mission_start, a_negative_parameter_is_denied) {
  EXPECT_EQ(decide_start({-1, 0}, ready()).result, mav_result::denied);
  EXPECT_EQ(decide_start({0, -1}, ready()).result, mav_result::denied);
}

TEST(mission_start, a_parameter_that_is_not_integral_is_denied) {
  EXPECT_EQ(decide_start({1.5F, 0}, ready()).result, mav_result::denied);
  EXPECT_EQ(decide_start({0, 1.5F}, ready()).result, mav_result::denied);
}

TEST(mission_start, no_mission_fails) {
  EXPECT_EQ(decide_start({}, ready(0)).result, mav_result::failed);
  EXPECT_EQ(decide_start({}, ready(0)).text, "Mission start: no mission");
}

TEST(mission_start, first_item_beyond_the_mission_fails) {
  EXPECT_EQ(decide_start({5, 0}, ready()).result, mav_result::failed);
  EXPECT_EQ(decide_start({5, 2}, ready()).result, mav_result::failed); // before last < first is looked at
}

TEST(mission_start, a_huge_first_item_fails_and_a_huge_last_item_is_denied) {
  for (const float huge : {1e20F, std::numeric_limits<float>::max(), 2147483648.0F}) {
    EXPECT_EQ(decide_start({huge, 0}, ready()).result, mav_result::failed);
    EXPECT_EQ(decide_start({0, huge}, ready()).result, mav_result::denied);
  }
}

TEST(mission_start, last_item_before_the_first_is_denied) {
  EXPECT_EQ(decide_start({3, 2}, ready()).result, mav_result::denied);
}

TEST(mission_start, last_item_beyond_the_mission_is_denied) {
  EXPECT_EQ(decide_start({0, 5}, ready()).result, mav_result::denied);
  EXPECT_EQ(decide_start({0, 4}, ready()).result, mav_result::accepted);
}

TEST(mission_start, a_running_transfer_rejects_it_for_now) {
  auto now = ready();
  now.is_transferring = true;
  EXPECT_EQ(decide_start({}, now).result, mav_result::temporarily_rejected);
}

TEST(mission_start, a_vehicle_that_is_not_ready_rejects_it_for_now_and_says_why) {
  auto now = ready();
  now.not_ready = "no position";
  const auto decided = decide_start({}, now);
  EXPECT_EQ(decided.result, mav_result::temporarily_rejected);
  EXPECT_EQ(decided.text, "Mission start: no position");
}

TEST(mission_start, disarmed_is_denied_unless_starting_arms) {
  auto now = ready();
  now.is_armed = false;
  EXPECT_EQ(decide_start({}, now).result, mav_result::denied);
  now.arms_on_start = true;
  EXPECT_EQ(decide_start({}, now).result, mav_result::accepted);
}

TEST(mission_start, the_first_reason_in_the_order_decides) {
  auto now = ready(0);
  now.is_transferring = true;
  now.not_ready = "no position";
  now.is_armed = false;
  EXPECT_EQ(decide_start({nan_value, 0}, now).result, mav_result::denied);
  EXPECT_EQ(decide_start({0, 9}, now).result, mav_result::failed);
  now.item_count = 3;
  EXPECT_EQ(decide_start({0, 9}, now).result, mav_result::denied);
  EXPECT_EQ(decide_start({}, now).text, "Mission start: a transfer is running");
  now.is_transferring = false;
  EXPECT_EQ(decide_start({}, now).result, mav_result::temporarily_rejected);
  now.not_ready.clear();
  EXPECT_EQ(decide_start({}, now).result, mav_result::denied);
}

TEST(mission_start, otherwise_it_is_accepted_between_these_items) {
  const auto decided = decide_start({1, 3}, ready());
  EXPECT_EQ(decided.result, mav_result::accepted);
  EXPECT_EQ(decided.first, 1);
  EXPECT_EQ(decided.last, 3);
  EXPECT_EQ(decided.text, "Mission started");
}

TEST(mission_start, last_item_0_means_to_the_end) {
  EXPECT_EQ(decide_start({0, 0}, ready()).last, 4);
  EXPECT_EQ(decide_start({2, 0}, ready()).last, 4);
  EXPECT_EQ(decide_start({-0.0F, -0.0F}, ready()).last, 4);
}

TEST(mission_start, first_0_and_last_0_start_a_mission_of_one_item) {
  const auto decided = decide_start({0, 0}, ready(1));
  EXPECT_EQ(decided.result, mav_result::accepted);
  EXPECT_EQ(decided.first, 0);
  EXPECT_EQ(decided.last, 0);
}

TEST(mission_start, each_sentence_fits_one_statustext) {
  auto busy = ready();
  busy.is_transferring = true;
  auto disarmed = ready();
  disarmed.is_armed = false;
  for (const auto& each : {decide_start({nan_value, 0}, ready()), decide_start({}, ready(0)),
                           decide_start({5, 0}, ready()), decide_start({0, 5}, ready()), decide_start({3, 2}, ready()),
                           decide_start({}, busy), decide_start({}, disarmed)}) {
    EXPECT_FALSE(each.text.empty());
    EXPECT_LE(each.text.size(), 50U) << each.text;
  }
}

} // namespace mission_start_test
} // namespace godwit::ground_port::vehicle_role
