#include "runtime/config/schema.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace godwit::runtime {

namespace schema_test {

using nlohmann::json;

// One key for each kind of rule.
const json schema = json::parse(R"({
  "$schema": "http://json-schema.org/draft-07/schema#",
  "type": "object",
  "additionalProperties": false,
  "required": ["name"],
  "properties": {
    "name": {"type": "string", "minLength": 1, "maxLength": 8},
    "code": {"type": "string", "pattern": "^[A-Z]+$"},
    "count": {"type": "integer", "minimum": 1, "maximum": 8, "default": 4},
    "ratio": {"type": "number", "minimum": 0},
    "on": {"type": "boolean", "default": true},
    "mode": {"enum": ["off", "once_seen", "required"], "default": "off"},
    "version": {"const": 1},
    "either": {"anyOf": [{"type": "integer"}, {"type": "boolean"}]},
    "links": {
      "type": "array", "maxItems": 2,
      "items": {"type": "object", "required": ["port"], "additionalProperties": false,
                "properties": {"port": {"type": "integer", "minimum": 1, "maximum": 65535}}}
    },
    "inner": {"type": "object", "properties": {"deep": {"type": "object", "properties": {"leaf": {"type": "integer", "default": 7}}}}}
  }
})");

std::vector<config_problem> problems_of(const std::string& document) {
  return violations(json::parse(document), io::schemas::compiled_schema(schema));
}

config_problem only_problem_of(const std::string& document) {
  const auto problems = problems_of(document);
  EXPECT_EQ(problems.size(), 1U) << document;
  return problems.empty() ? config_problem{} : problems.front();
}

void expect_problem(const std::string& document, const config_problem& expected) {
  const auto found = only_problem_of(document);
  EXPECT_EQ(found.path, expected.path) << document;
  EXPECT_EQ(found.what, expected.what) << document;
  EXPECT_EQ(found.allowed, expected.allowed) << document;
}

TEST(schema, a_valid_document_has_no_problem) {
  EXPECT_TRUE(problems_of(R"({"name":"x"})").empty());
  EXPECT_TRUE(problems_of(R"({"name":"x","code":"AB","count":8,"ratio":0.5,"on":false,"mode":"required","version":1,
                              "either":true,"links":[{"port":1}],"inner":{"deep":{"leaf":1}}})")
                  .empty());
}

TEST(schema, each_kind_of_rule_says_where_what_and_what_is_allowed) {
  expect_problem(R"({"name":""})", {"name", R"(is "")", "a text of 1 to 8 characters"});
  expect_problem(R"({"name":5})", {"name", "is 5", "a text of 1 to 8 characters"});
  expect_problem(R"({"name":"x","code":"a1"})", {"code", R"(is "a1")", "a text that matches ^[A-Z]+$"});
  expect_problem(R"({"name":"x","count":9})", {"count", "is 9", "a whole number from 1 to 8"});
  expect_problem(R"({"name":"x","count":0})", {"count", "is 0", "a whole number from 1 to 8"});
  expect_problem(R"({"name":"x","count":2.5})", {"count", "is 2.5", "a whole number from 1 to 8"});
  expect_problem(R"({"name":"x","count":"2"})", {"count", R"(is "2")", "a whole number from 1 to 8"});
  expect_problem(R"({"name":"x","count":null})", {"count", "is null", "a whole number from 1 to 8"});
  expect_problem(R"({"name":"x","ratio":-0.5})", {"ratio", "is -0.5", "a number from 0 on"});
  expect_problem(R"({"name":"x","on":1})", {"on", "is 1", "true or false"});
  expect_problem(R"({"name":"x","mode":"on"})", {"mode", R"(is "on")", R"("off", "once_seen" or "required")"});
  expect_problem(R"({"name":"x","version":2})", {"version", "is 2", "1"});
  expect_problem(R"({"name":"x","links":{}})", {"links", "is an object", "a list of up to 2 entries"});
  expect_problem(R"({"name":"x","links":[1]})", {"links[0]", "is 1", "an object with port"});
}

TEST(schema, numbers_beyond_64_bits_of_sign_are_out_of_range) {
  expect_problem(R"({"name":"x","count":18446744073709551615})",
                 {"count", "is 18446744073709551615", "a whole number from 1 to 8"});
  expect_problem(R"({"name":"x","count":-9223372036854775808})",
                 {"count", "is -9223372036854775808", "a whole number from 1 to 8"});
}

TEST(schema, a_missing_key_is_named_with_what_belongs_there) {
  expect_problem("{}", {"name", "is missing", "a text of 1 to 8 characters"});
  expect_problem(R"({"name":"x","links":[{"port":1},{}]})",
                 {"links[1].port", "is missing", "a whole number from 1 to 65535"});
}

TEST(schema, an_unknown_key_comes_with_a_suggestion) {
  const auto problem = only_problem_of(R"({"name":"x","cuont":1})");
  EXPECT_EQ(problem.path, "cuont");
  EXPECT_EQ(problem.what, "is not known; did you mean count?");
  EXPECT_NE(problem.allowed.find("count"), std::string::npos);
}

TEST(schema, an_unknown_key_without_a_neighbour_comes_with_the_known_keys) {
  expect_problem(R"({"name":"x","links":[{"port":1,"address":2}]})", {"links[0].address", "is not known", "port"});
}

TEST(schema, rules_without_a_sentence_of_ours_are_reported_all_the_same) {
  EXPECT_EQ(only_problem_of(R"({"name":"x","links":[{"port":1},{"port":1},{"port":1}]})").path, "links");
  EXPECT_EQ(only_problem_of(R"({"name":"x","either":"y"})").path, "either");
}

TEST(schema, a_document_of_the_wrong_kind_is_a_problem) {
  for (const std::string document : {"null", "1", "\"x\"", "[]", "[[1]]", "true"})
    EXPECT_EQ(only_problem_of(document).path, "") << document;
}

TEST(schema, all_problems_are_reported_at_once) {
  const auto problems =
      problems_of(R"({"count":9,"on":1,"mod":"off","mode":1,"links":[{"port":0},{"prot":1},7],"inner":{"deep":[]}})");
  std::vector<std::string> paths;
  std::transform(problems.begin(), problems.end(), std::back_inserter(paths),
                 [](const auto& problem) { return problem.path; });
  std::sort(paths.begin(), paths.end());
  EXPECT_EQ(paths, (std::vector<std::string>{"count", "inner.deep", "links", "links[0].port", "links[1].port",
                                             "links[1].prot", "links[2]", "mod", "mode", "name", "on"}));
}

TEST(schema, defaults_fill_what_is_absent_and_nothing_else) {
  auto document = json::parse(R"({"name":"x","on":false})");
  fill_defaults(document, schema);
  EXPECT_EQ(document, json::parse(R"({"name":"x","on":false,"count":4,"mode":"off","inner":{"deep":{"leaf":7}}})"));
}

} // namespace schema_test

} // namespace godwit::runtime
