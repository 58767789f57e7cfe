#include "runtime/config/parse.hpp"

#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace godwit::runtime {

namespace parse_test {

config_error error_of(std::string_view text) {
  auto parsed = parse_config(text, "test.json");
  EXPECT_FALSE(parsed) << parsed->dump();
  return parsed ? config_error{} : parsed.error();
}

std::string nested(std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); }

TEST(parse, both_kinds_of_comments_are_allowed) {
  const auto parsed = parse_config("// one\n{\"a\": /* two */ 1} // three", "test.json");
  ASSERT_TRUE(parsed) << parsed.error().message();
  EXPECT_EQ(*parsed, (nlohmann::json{{"a", 1}}));
}

TEST(parse, every_kind_of_value_arrives_as_it_is) {
  const std::string text = R"({"a":[null,true,-1,18446744073709551615,1.5,"\u00e4",{"b":[[],{}]}],"c":"d"})";
  const auto parsed = parse_config(text, "test.json");
  ASSERT_TRUE(parsed) << parsed.error().message();
  EXPECT_EQ(*parsed, nlohmann::json::parse(text));
}

TEST(parse, a_syntax_error_names_file_line_column_and_what_was_expected) {
  const auto error = error_of("{\n  \"a\": 1,\n  \"b\" 2\n}");
  EXPECT_EQ(error.code, config_errc::syntax);
  EXPECT_EQ(error.line, 3U);
  EXPECT_EQ(error.column, 7U);
  EXPECT_EQ(error.message(),
            "test.json:3:7: is not JSON: while parsing object separator - unexpected number literal; expected ':'");
}

TEST(parse, the_end_of_the_text_is_a_place_too) {
  const auto error = error_of("{\"a\": ");
  EXPECT_EQ(error.line, 1U);
  EXPECT_GE(error.column, 6U);
  EXPECT_EQ(error_of("").line, 1U);
}

TEST(parse, what_is_no_json_is_a_syntax_error) {
  for (const std::string text : {"", " ", "{", "}", "{a:1}", "{\"a\":1,}", "[1,]", "nul", "\"a", "'a'", "01", "1e999",
                                 "NaN", "/* open", "{} {}", "\"\\ud800\"", "\"\xff\"", "{\"a\":\"\x01\"}"})
    EXPECT_EQ(error_of(text).code, config_errc::syntax) << text;
  EXPECT_EQ(error_of(std::string("{}\0", 3)).code, config_errc::syntax);
}

TEST(parse, a_key_that_stands_twice_is_named_with_its_path) {
  const auto error = error_of(R"({"trace": {"flush_ms": 1, "flush_ms": 2}})");
  EXPECT_EQ(error.code, config_errc::invalid);
  EXPECT_EQ(error.message(), "test.json: trace.flush_ms stands twice in the same object");
}

TEST(parse, nesting_has_a_bound) {
  EXPECT_TRUE(parse_config(nested(max_config_depth), "test.json"));
  EXPECT_EQ(error_of(nested(max_config_depth + 1)).problems.front().what, "is nested too deep");
  EXPECT_EQ(error_of(std::string(100000, '[')).problems.front().what, "is nested too deep");
}

TEST(parse, texts_have_a_bound) {
  EXPECT_TRUE(parse_config('"' + std::string(max_config_text, 'x') + '"', "test.json"));
  EXPECT_EQ(error_of("{\"a\":\"" + std::string(max_config_text + 1, 'x') + "\"}").message(),
            "test.json: a is a text of 4097 bytes; allowed: a text of up to 4096 bytes");
}

TEST(parse, the_whole_text_has_a_bound) {
  const auto error = error_of(std::string(max_config_bytes + 1, ' '));
  EXPECT_EQ(error.code, config_errc::too_large);
  EXPECT_EQ(error.message(), "test.json: has 262145 bytes; allowed: up to 262144 bytes");
}

TEST(parse, the_number_of_problems_has_a_bound) {
  std::string text = "[";
  for (std::size_t index = 0; index < 10 * max_config_problems; ++index)
    text += R"({"a":1,"a":1},)";
  EXPECT_EQ(error_of(text + "0]").problems.size(), max_config_problems);
}

TEST(parse, strange_keys_are_shown_as_texts) {
  EXPECT_EQ(error_of(R"({"a b": {"":1,"":1}})").problems.front().path, R"("a b"."")");
  const std::string endless(1000, 'k');
  EXPECT_LT(error_of("{\"" + endless + "\":1,\"" + endless + "\":1}").message().size(), 200U);
}

RC_GTEST_PROP(parse, any_text_gives_a_document_or_a_sentence, (const std::string& text)) {
  const auto parsed = parse_config(text, "test.json");
  // Outside RC_ASSERT, which evaluates both sides of ||.
  const bool answered = parsed.has_value() || !parsed.error().message().empty();
  RC_ASSERT(answered);
}

} // namespace parse_test

} // namespace godwit::runtime
