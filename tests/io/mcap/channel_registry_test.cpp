#include "io/mcap/channel_registry.hpp"

#include <gtest/gtest.h>

namespace godwit::io::mcap {
namespace channel_registry_test {

TEST(mcap_channel_registry, the_same_definition_gets_the_same_id) {
  channel_registry registry;
  const auto schema = registry.add_schema("s", "jsonschema", bytes_of("{}"));
  ASSERT_TRUE(schema);
  EXPECT_EQ(registry.add_schema("s", "jsonschema", bytes_of("{}")), schema);
  const auto channel = registry.add_channel(*schema, "/t", "json");
  ASSERT_TRUE(channel);
  EXPECT_EQ(registry.add_channel(*schema, "/t", "json"), channel);
  EXPECT_NE(registry.add_channel(*schema, "/u", "json"), channel);
  EXPECT_EQ(registry.schema_of(*channel), *schema);
}

TEST(mcap_channel_registry, one_name_can_not_mean_two_things) {
  channel_registry registry;
  const auto schema = registry.add_schema("s", "jsonschema", bytes_of("{}"));
  EXPECT_EQ(registry.add_schema("s", "jsonschema", bytes_of("[]")).error().code, errc::invalid_argument);
  ASSERT_TRUE(registry.add_channel(*schema, "/t", "json"));
  EXPECT_EQ(registry.add_channel(*schema, "/t", "cbor").error().code, errc::invalid_argument);
  EXPECT_EQ(registry.add_channel(schema_id{9}, "/u", "json").error().code, errc::invalid_argument);
  EXPECT_TRUE(registry.add_channel(schema_id{0}, "/v", "json")) << "0 means: no schema";
}

TEST(mcap_channel_registry, ids_and_sizes_are_bounded) {
  channel_registry registry;
  const std::string large(channel_registry::max_definition_bytes + 1, 'x');
  EXPECT_EQ(registry.add_schema("s", "jsonschema", bytes_of(large)).error().code, errc::too_large);
  EXPECT_EQ(registry.add_channel(schema_id{0}, large, "json").error().code, errc::too_large);
  for (int i = 0; i < UINT16_MAX; ++i) {
    ASSERT_TRUE(registry.add_channel(schema_id{0}, std::to_string(i), "json"));
  }
  EXPECT_EQ(registry.add_channel(schema_id{0}, "one more", "json").error().code, errc::too_many);
  EXPECT_TRUE(registry.add_channel(schema_id{0}, "0", "json")) << "a known one is still found";
}

} // namespace channel_registry_test
} // namespace godwit::io::mcap
