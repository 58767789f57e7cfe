#include "io/json_schema/compiled_schema.hpp"

#include <gtest/gtest.h>

namespace godwit::io::schemas {
namespace compiled_schema_test {

using nlohmann::json;

const compiled_schema either(json{
    {"type", "object"},
    {"properties",
     {{"count", {{"type", "integer"}}}, {"either", {{"anyOf", {{{"type", "integer"}}, {{"type", "boolean"}}}}}}}}});

TEST(compiled_schema, a_valid_document_has_no_problem) {
  EXPECT_TRUE(either.holds({{"count", 1}, {"either", true}}));
  EXPECT_TRUE(either.problems_of({{"count", 1}, {"either", true}}, 10).empty());
}

TEST(compiled_schema, a_keyword_without_a_sentence_is_told_in_the_words_of_the_validator) {
  const auto problems = either.problems_of({{"either", "x"}}, 10);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, place{"either"});
  EXPECT_EQ(problems[0].what.find("is not allowed: "), 0U);
}

TEST(compiled_schema, both_kinds_of_problems_are_told_at_once) {
  EXPECT_EQ(either.problems_of({{"count", 0.5}, {"either", "x"}}, 10).size(), 2U);
}

TEST(compiled_schema, a_document_that_somebody_else_refuses_has_a_problem) {
  EXPECT_EQ(either.explain_wrong({{"count", 1}}, 10).size(), 1U);
}

TEST(compiled_schema, it_may_be_moved) {
  compiled_schema from(json{{"type", "integer"}});
  const auto to = std::move(from);
  EXPECT_TRUE(to.holds(1));
  EXPECT_FALSE(to.holds("1"));
}

} // namespace compiled_schema_test
} // namespace godwit::io::schemas
