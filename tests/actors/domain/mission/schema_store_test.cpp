#include "actors/domain/mission/schema_store.hpp"

#include <functional>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/rules.hpp"

namespace godwit::mission {
namespace schema_store_test {

using nlohmann::json;

void for_each_schema(const json& schema, const std::function<void(const json&)>& visit) {
  visit(schema);
  for (const auto& [key, value] : schema.items())
    if (key == "properties") {
      for (const auto& each : value)
        for_each_schema(each, visit);
    } else if (key == "items" || key == "if" || key == "then") {
      for_each_schema(value, visit);
    } else if (key == "allOf") {
      for (const auto& each : value)
        for_each_schema(each, visit);
    }
}

TEST(schema_store, no_reference_is_left) {
  for (const auto& each : embedded_schemas())
    EXPECT_EQ(schema_named(each.name).dump().find("$ref"), std::string::npos) << each.name;
}

TEST(schema_store, every_keyword_is_one_that_can_be_explained) {
  const std::set<std::string> known{"$schema",
                                    "title",
                                    "description",
                                    "type",
                                    "additionalProperties",
                                    "required",
                                    "properties",
                                    "items",
                                    "minItems",
                                    "maxItems",
                                    "minLength",
                                    "maxLength",
                                    "pattern",
                                    "minimum",
                                    "maximum",
                                    "enum",
                                    "const",
                                    "allOf",
                                    "if",
                                    "then",
                                    "exclusiveMinimum",
                                    "exclusiveMaximum"};
  for (const auto& each : embedded_schemas())
    for_each_schema(schema_named(each.name), [&](const json& schema) {
      for (const auto& [key, value] : schema.items())
        EXPECT_TRUE(known.contains(key)) << each.name << ": " << key;
    });
}

TEST(schema_store, every_list_and_every_text_has_a_bound) {
  for (const auto& each : embedded_schemas())
    for_each_schema(schema_named(each.name), [&](const json& schema) {
      const auto type = schema.value("type", json());
      EXPECT_TRUE(type != "array" || schema.contains("maxItems")) << each.name << ": " << schema.dump();
      EXPECT_TRUE(type != "string" || schema.contains("maxLength")) << each.name << ": " << schema.dump();
    });
}

TEST(schema_store, every_object_but_the_open_problem_refuses_unknown_properties) {
  for (const auto& each : embedded_schemas())
    for_each_schema(schema_named(each.name), [&](const json& schema) {
      const bool is_part = !schema.contains("title"); // of an `if`, or the common part of all kinds of items
      const bool is_open = schema.value("title", "") == "what went wrong (RFC 9457)" || schema.contains("allOf");
      const bool is_closed = schema.value("additionalProperties", json()) == json(false);
      EXPECT_TRUE(!schema.contains("properties") || is_part || is_open || is_closed) << each.name << schema.dump();
    });
}

TEST(schema_store, the_bounds_in_the_program_are_those_of_the_schemas) {
  const auto& mission = schema_named("mission")["properties"];
  EXPECT_EQ(mission["items"]["maxItems"], max_items);
  EXPECT_EQ(mission["geofences"]["maxItems"], max_geofences);
  EXPECT_EQ(mission["geofences"]["items"]["properties"]["vertices"]["maxItems"], max_polygon_corners);
}

TEST(schema_store, the_kinds_of_items_are_those_of_the_program) {
  std::set<std::string> in_schema;
  for (const auto& each : schema_named("item")["properties"]["kind"]["enum"])
    in_schema.insert(each.get<std::string>());
  std::set<std::string> in_program;
  [&]<class... T>(std::type_identity<std::variant<T...>>) {
    (in_program.emplace(T::kind), ...);
  }(std::type_identity<item>{});
  EXPECT_EQ(in_schema, in_program);
}

} // namespace schema_store_test
} // namespace godwit::mission
