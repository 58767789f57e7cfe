#include "io/json_schema/explain.hpp"

#include <gtest/gtest.h>

namespace godwit::io::schemas {
namespace explain_test {

using nlohmann::json;

std::vector<problem> found(const json& document, const json& schema) { return explain(document, schema, 10); }

TEST(explain, a_range_is_read_out_as_people_say_it) {
  EXPECT_EQ(allowed_by({{"type", "integer"}, {"minimum", 1}, {"maximum", 8}}), "a whole number from 1 to 8");
  EXPECT_EQ(allowed_by({{"type", "number"}, {"minimum", 0}}), "a number from 0 on");
  EXPECT_EQ(allowed_by({{"type", "number"}, {"maximum", 5}}), "a number up to 5");
  EXPECT_EQ(allowed_by({{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", 5}}), "a number above 0 up to 5");
  EXPECT_EQ(allowed_by({{"type", "number"}, {"minimum", 0}, {"exclusiveMaximum", 360}}), "a number from 0 below 360");
}

TEST(explain, sizes_have_a_unit) {
  EXPECT_EQ(allowed_by({{"type", "string"}, {"minLength", 1}, {"maxLength", 8}}), "a text of 1 to 8 characters");
  EXPECT_EQ(allowed_by({{"type", "string"}, {"maxLength", 8}}), "a text of up to 8 characters");
  EXPECT_EQ(allowed_by({{"type", "array"}, {"minItems", 2}}), "a list of at least 2 entries");
}

TEST(explain, values_and_titles_stand_for_themselves) {
  EXPECT_EQ(allowed_by({{"enum", {"a", "b", 3}}}), R"("a", "b" or 3)");
  EXPECT_EQ(allowed_by({{"const", 1}}), "1");
  EXPECT_EQ(allowed_by({{"type", "string"}, {"pattern", "^x"}, {"title", "a word with x"}}), "a word with x");
  EXPECT_EQ(allowed_by({{"type", "object"}, {"properties", {{"port", json::object()}}}}), "an object with port");
  EXPECT_EQ(allowed_by(json::object()), "a value");
}

TEST(explain, each_problem_has_its_place) {
  const json schema{
      {"type", "object"},
      {"properties",
       {{"links",
         {{"type", "array"}, {"items", {{"type", "object"}, {"properties", {{"port", {{"type", "integer"}}}}}}}}}}}};
  const auto all = found({{"links", {{{"port", 1}}, {{"port", "x"}}}}}, schema);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].where, (place{"links", std::size_t{1}, "port"}));
  EXPECT_EQ(all[0].what, "is \"x\"");
  EXPECT_EQ(all[0].allowed, "a whole number");
}

TEST(explain, a_number_beyond_63_bits_is_out_of_range_and_not_below_zero) {
  EXPECT_EQ(found(18'446'744'073'709'551'615U, {{"type", "integer"}, {"minimum", -5}, {"maximum", 5}}).size(), 1U);
}

TEST(explain, a_long_text_is_refused_for_its_length_before_its_pattern_is_looked_at) {
  const json schema{{"type", "string"}, {"maxLength", 8}, {"pattern", "^(a|b)*$"}};
  EXPECT_EQ(found(std::string(1'000'000, 'a'), schema).size(), 1U);
  EXPECT_TRUE(found("abab", schema).empty());
}

TEST(explain, a_branch_is_looked_at_when_its_condition_holds) {
  const json schema{
      {"allOf", {{{"if", {{"properties", {{"kind", {{"const", "land"}}}}}}}, {"then", {{"required", {"at"}}}}}}}};
  EXPECT_EQ(found({{"kind", "land"}}, schema).size(), 1U);
  EXPECT_TRUE(found({{"kind", "wait"}}, schema).empty());
}

TEST(explain, it_stops_one_problem_beyond_the_bound) {
  json many = json::object();
  for (int i = 0; i < 100; ++i)
    many["k" + std::to_string(i)] = i;
  EXPECT_EQ(found(many, {{"properties", json::object()}, {"additionalProperties", false}}).size(), 11U);
}

} // namespace explain_test
} // namespace godwit::io::schemas
