#include <bit>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/ground_port/mission_server/plan_store.hpp"
#include "actors/ground_port/state.hpp"
#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::ground_port {

namespace state_test {

using io::mavlink::mav_mission_type;

plan_noted noted(mav_mission_type type, std::size_t items) {
  plan_noted result;
  result.ticket = 5;
  result.type = type;
  result.plan_id = 77;
  result.items.resize(items);
  result.ack = io::mavlink::mission_ack{.target_system = 255};
  return result;
}

TEST(ground_port_state, a_plan_that_is_on_the_disk_is_told_to_the_executor_before_it_is_acknowledged) {
  state s;
  const auto effects = durable_core::apply(s, noted(mav_mission_type::mission, 3), 9);
  ASSERT_EQ(effects.size(), 2U);
  EXPECT_EQ(std::get<executor::plan_taken>(effects[0]).items.size(), 3U);
  EXPECT_EQ(std::get<executor::plan_taken>(effects[0]).items[2].seq, 2);
  EXPECT_EQ(std::get<plan_resolved>(effects[1]).ack->target_system, 255);
  EXPECT_EQ(std::get<plan_resolved>(effects[1]).at_ns, 9);
  ASSERT_EQ(s.plans.size(), 1U);
  EXPECT_EQ(s.plans[0].plan_id, 77U);
}

TEST(ground_port_state, there_is_one_plan_of_each_type_and_a_cleared_one_is_gone) {
  state s;
  (void)durable_core::apply(s, noted(mav_mission_type::mission, 3), 1);
  (void)durable_core::apply(s, noted(mav_mission_type::fence, 2), 2);
  (void)durable_core::apply(s, noted(mav_mission_type::mission, 4), 3);
  EXPECT_EQ(s.plans.size(), 2U);
  const auto effects = durable_core::apply(s, noted(mav_mission_type::mission, 0), 4);
  EXPECT_TRUE(std::holds_alternative<executor::plan_cleared>(effects[0]));
  ASSERT_EQ(s.plans.size(), 1U);
  EXPECT_EQ(s.plans[0].type, mav_mission_type::fence);
}

TEST(ground_port_state, a_mission_of_the_executors_is_not_told_back_to_it) {
  state s;
  auto what = noted(mav_mission_type::mission, 3);
  what.from_executor = true;
  EXPECT_EQ(durable_core::apply(s, what, 1).size(), 1U);
}

TEST(ground_port_state, a_start_is_given_to_the_executor_once_and_settled_once) {
  state s;
  start_noted what;
  what.record.asked.key = 9;
  const auto asked = durable_core::apply(s, what, 1);
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(std::get<executor::start_mission>(asked[0]).key, 9U);
  what.record.is_resolved = true;
  const auto resolved = durable_core::apply(s, what, 2);
  ASSERT_EQ(resolved.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<start_resolved>(resolved[0]));
  EXPECT_TRUE(s.last_start->is_resolved);
}

TEST(ground_port_state, a_start_item_is_kept_until_a_start_has_used_it_or_the_mission_changes) {
  state s;
  (void)durable_core::apply(s, start_item_noted{1, 3, {}}, 1);
  EXPECT_EQ(s.start_item, 3);
  start_noted refused;
  refused.record.is_resolved = true;
  refused.record.result = io::mavlink::number(io::mavlink::mav_result::denied);
  (void)durable_core::apply(s, refused, 2);
  EXPECT_EQ(s.start_item, 3);
  auto accepted = refused;
  accepted.record.result = 0;
  (void)durable_core::apply(s, accepted, 3);
  EXPECT_EQ(s.start_item, std::nullopt);
  (void)durable_core::apply(s, start_item_noted{2, 3, {}}, 4);
  (void)durable_core::apply(s, noted(mav_mission_type::fence, 3), 5);
  EXPECT_EQ(s.start_item, 3);
  (void)durable_core::apply(s, noted(mav_mission_type::mission, 3), 6);
  EXPECT_EQ(s.start_item, std::nullopt);
}

TEST(ground_port_state, signing_time_never_goes_back) {
  state s;
  (void)durable_core::apply(s, signing_time_reserved{10}, 1);
  (void)durable_core::apply(s, signing_time_reserved{7}, 2);
  EXPECT_EQ(s.signing_ceiling, 10U);
}

} // namespace state_test

namespace kept_item_test {

using io::mavlink::mission_item_int;

std::vector<mission_item_int> through_json(const std::vector<mission_item_int>& items) {
  kept_plan plan;
  plan.items = keep(items);
  kept_plan read;
  EXPECT_TRUE(io::read_json(nlohmann::json::parse(io::to_json(plan)), read));
  return restore(read.items);
}

mission_item_int item(float value) {
  mission_item_int result;
  result.command = 16;
  result.frame = 3;
  result.autocontinue = 1;
  result.x = -500'000'001;
  result.param1 = result.param4 = result.z = value;
  return result;
}

TEST(kept_item, floats_that_json_does_not_know_come_back_with_every_bit) {
  for (const auto bits : {0x7FC00000U, 0xFFC00000U, 0x7FC00001U, 0x7F800000U, 0xFF800000U, 0x80000000U, 0x00000001U}) {
    const auto back = through_json({item(std::bit_cast<float>(bits))});
    ASSERT_EQ(back.size(), 1U);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(back[0].param1), bits);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(back[0].z), bits);
  }
}

RC_GTEST_PROP(kept_item_property, a_plan_has_the_same_id_after_it_was_kept, (const std::vector<std::uint32_t>& bits)) {
  std::vector<mission_item_int> items;
  for (const auto each : bits) {
    items.push_back(item(std::bit_cast<float>(each)));
    items.back().seq = static_cast<std::uint16_t>(items.size() - 1);
    items.back().y = static_cast<std::int32_t>(each);
  }
  RC_ASSERT(mission_server::checksum_of(through_json(items)) == mission_server::checksum_of(items));
}

} // namespace kept_item_test

} // namespace godwit::ground_port
