#include "actors/ground_port/kept_item.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <bit>
#include <limits>

#include "actors/ground_port/mission_server/plan_store.hpp"
#include "actors/ground_port/state.hpp"
#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"

namespace godwit::ground_port {
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
