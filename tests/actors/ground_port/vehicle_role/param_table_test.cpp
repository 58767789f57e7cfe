#include "actors/ground_port/vehicle_role/param_table.hpp"
#include "tests/support/time_units.hpp"

#include <bit>
#include <cmath>

#include <gtest/gtest.h>

namespace godwit::ground_port::vehicle_role {
namespace param_table_test {

using godwit::tests::ms;

std::vector<param> three() {
  return {{"WP_RADIUS", 2.5F, param_type_real32, true},
          {"SYSID_THISMAV", 1, param_type_int32, false},
          {"SIXTEEN_LETTERS_", -7, param_type_int32, true}};
}

std::array<char, 16> id(std::string_view name) {
  std::array<char, 16> result{};
  std::copy(name.begin(), name.end(), result.begin());
  return result;
}

io::mavlink::param_set setting(std::string_view name, float value, std::uint8_t type) {
  return {.param_id = id(name), .param_value = value, .param_type = type};
}

TEST(param_table, a_list_gives_every_parameter_once_at_a_bounded_rate) {
  param_table table(three());
  EXPECT_FALSE(table.due(0));
  table.on(io::mavlink::param_request_list{}, 5 * ms);
  std::vector<int> indices;
  for (auto now = 5 * ms; now < 20 * ms; now += ms / 2)
    while (const auto value = table.due(now)) {
      EXPECT_EQ(value->param_count, 3);
      EXPECT_EQ(now, (5 + value->param_index) * ms);
      indices.push_back(value->param_index);
    }
  EXPECT_EQ(indices, (std::vector{0, 1, 2}));
  EXPECT_EQ(table.next_due_ns(), std::numeric_limits<std::int64_t>::max());
}

TEST(param_table, a_caller_that_comes_late_gets_several_values_but_not_all_that_it_missed) {
  param_table table(std::vector<param>(200, param{"X", 1}));
  table.on(io::mavlink::param_request_list{}, 0);
  int given = 0;
  while (table.due(1'000 * ms))
    ++given;
  EXPECT_EQ(given, 1 + param_table::max_behind_ns / param_table::value_interval_ns + 1);
}

TEST(param_table, a_second_list_request_begins_the_list_again) {
  param_table table(three());
  table.on(io::mavlink::param_request_list{}, 0);
  EXPECT_EQ(table.due(0)->param_index, 0);
  EXPECT_EQ(table.due(ms)->param_index, 1);
  table.on(io::mavlink::param_request_list{}, ms);
  EXPECT_EQ(table.due(ms)->param_index, 0);
}

TEST(param_table, an_empty_table_lists_nothing) {
  param_table table({});
  table.on(io::mavlink::param_request_list{}, 0);
  EXPECT_FALSE(table.due(ms));
}

TEST(param_table, a_parameter_is_read_by_name_and_by_index) {
  const param_table table(three());
  const auto by_name = table.on(io::mavlink::param_request_read{.param_id = id("WP_RADIUS"), .param_index = -1});
  ASSERT_TRUE(by_name);
  EXPECT_EQ(by_name->param_value, 2.5F);
  EXPECT_EQ(by_name->param_index, 0);
  const auto by_index = table.on(io::mavlink::param_request_read{.param_index = 2});
  ASSERT_TRUE(by_index);
  EXPECT_EQ(by_index->param_id, id("SIXTEEN_LETTERS_"));
}

TEST(param_table, an_unknown_name_or_index_is_not_answered) {
  param_table table(three());
  EXPECT_FALSE(table.on(io::mavlink::param_request_read{.param_id = id("NO"), .param_index = -1}));
  EXPECT_FALSE(table.on(io::mavlink::param_request_read{.param_index = 3}));
  EXPECT_FALSE(table.on(setting("NO", 1, param_type_real32)));
}

TEST(param_table, a_value_that_can_be_set_is_set_and_one_that_can_not_stays) {
  param_table table(three());
  EXPECT_EQ(table.on(setting("WP_RADIUS", 4, param_type_real32))->param_value, 4.0F);
  EXPECT_EQ(table.value_of("WP_RADIUS"), 4.0F);
  EXPECT_EQ(table.on(setting("SYSID_THISMAV", 9, param_type_int32))->param_value, 1.0F);
  EXPECT_EQ(table.value_of("SYSID_THISMAV"), 1.0F);
  EXPECT_EQ(table.value_of("NO"), 0.0F);
}

TEST(param_table, what_is_no_number_or_no_integer_of_32_bits_is_not_taken) {
  param_table table(three());
  EXPECT_EQ(table.on(setting("WP_RADIUS", NAN, param_type_real32))->param_value, 2.5F);
  EXPECT_EQ(table.on(setting("WP_RADIUS", INFINITY, param_type_real32))->param_value, 2.5F);
  EXPECT_EQ(table.on(setting("SIXTEEN_LETTERS_", 1e20F, param_type_int32))->param_value, -7.0F);
}

TEST(param_table, integers_travel_converted_or_with_their_bits) {
  param_table values(three());
  EXPECT_EQ(values.on(setting("SIXTEEN_LETTERS_", 12, param_type_int32))->param_value, 12.0F);
  param_table bits(three(), param_encoding::as_bits);
  const auto read = bits.on(io::mavlink::param_request_read{.param_index = 2});
  EXPECT_EQ(std::bit_cast<std::int32_t>(read->param_value), -7);
  const auto answer = bits.on(setting("SIXTEEN_LETTERS_", std::bit_cast<float>(std::int32_t{12}), param_type_int32));
  EXPECT_EQ(std::bit_cast<std::int32_t>(answer->param_value), 12);
  EXPECT_EQ(bits.value_of("SIXTEEN_LETTERS_"), 12.0F);
}

TEST(param_table, with_bits_a_value_of_another_type_is_not_taken) {
  param_table bits(three(), param_encoding::as_bits);
  EXPECT_EQ(bits.on(setting("WP_RADIUS", 1, param_type_int32))->param_value, 2.5F);
}

} // namespace param_table_test
} // namespace godwit::ground_port::vehicle_role
