#include "actors/domain/mission/json_document.hpp"

#include <gtest/gtest.h>

namespace godwit::mission {
namespace json_document_test {

document_error error_of(std::string_view text, std::size_t max_bytes = 1 << 20) {
  const auto read = parse_document(text, max_bytes);
  return read ? document_error{} : read.error();
}

TEST(json_document, what_is_no_json_names_line_and_column) {
  const auto error = error_of("{\n  \"a\": 1,\n  b\n}");
  EXPECT_EQ(error.code, document_errc::syntax);
  EXPECT_NE(error.message().find("(line 3, column 3)"), std::string::npos) << error.message();
}

TEST(json_document, a_property_that_stands_twice_is_refused) {
  EXPECT_EQ(error_of(R"({"a": {"b": 1, "b": 2}})").message(),
            "the document has the property \"b\" twice in one object");
  EXPECT_EQ(error_of(R"({"a": 1, "\u0061": 2})").message(), "the document has the property \"a\" twice in one object");
}

TEST(json_document, nesting_is_bounded_however_deep_it_is) {
  const auto deep = std::string(1'000'000, '[');
  EXPECT_EQ(error_of(deep).message(), "the document is nested too deep; allowed: up to 32 levels");
  EXPECT_TRUE(parse_document(std::string(32, '[') + std::string(32, ']'), 1 << 20).has_value());
}

TEST(json_document, more_bytes_than_may_be_are_not_even_looked_at) {
  const auto error = error_of(std::string(5000, ' '), 4999);
  EXPECT_EQ(error.code, document_errc::too_large);
  EXPECT_EQ(error.sample.size(), max_document_sample);
}

TEST(json_document, long_texts_and_long_names_are_refused) {
  EXPECT_EQ(error_of('"' + std::string(max_document_text + 1, 'x') + '"').code, document_errc::wrong_form);
  EXPECT_EQ(error_of("{\"" + std::string(257, 'x') + "\": 1}").code, document_errc::wrong_form);
}

TEST(json_document, a_number_that_a_double_can_not_hold_is_refused) {
  const auto error = error_of("[1e999]");
  EXPECT_EQ(error.code, document_errc::syntax);
  EXPECT_EQ(error.message(), "the document has a number beyond 1.8e308 (line 1, column 6)");
  EXPECT_EQ(error_of("[NaN]").code, document_errc::syntax);
  EXPECT_EQ(error_of("[-Infinity]").code, document_errc::syntax);
}

TEST(json_document, a_whole_number_that_is_too_large_never_becomes_a_negative_one) {
  const auto read = parse_document("[18446744073709551615, 9223372036854775807, -9223372036854775808]", 1 << 20);
  ASSERT_TRUE(read.has_value());
  EXPECT_TRUE(read->at(0).is_number_float());
  EXPECT_GT(read->at(0).get<double>(), 1.8e19);
  EXPECT_TRUE(read->at(1).is_number_integer());
  EXPECT_TRUE(read->at(2).is_number_integer());
}

TEST(json_document, a_text_with_the_character_0_is_refused) {
  EXPECT_EQ(error_of(R"(["a\u0000"])").message(), "the document has a text with the character U+0000 in it");
}

TEST(json_document, many_small_values_are_refused_before_they_fill_the_memory) {
  std::string text = "[0";
  for (int i = 0; i < 1000; ++i)
    text += ",0";
  text += "]";
  EXPECT_EQ(error_of(text, 16'000).message(), "the document has more than 1000 values");
  EXPECT_TRUE(parse_document(text, 16'032).has_value());
}

TEST(json_document, a_sentence_repeats_nothing_of_what_could_not_be_read) {
  EXPECT_EQ(error_of("\"\xff\"").message(),
            "the document is not JSON: while parsing value - invalid string: ill-formed UTF-8 byte (line 1, column 2)");
  EXPECT_LT(error_of('"' + std::string(100'000, 'x')).message().size(), 200U);
  EXPECT_LT(error_of("[" + std::string(100'000, '1') + "]").message().size(), 200U);
}

TEST(json_document, wrong_utf8_and_bytes_after_the_document_are_refused) {
  EXPECT_EQ(error_of("\"\xff\"").code, document_errc::syntax);
  EXPECT_EQ(error_of("{} {}").code, document_errc::syntax);
  EXPECT_EQ(error_of("").code, document_errc::syntax);
  EXPECT_EQ(error_of(std::string_view("{}\0x", 4)).message(), "the document is not JSON: a byte 0 (line 1, column 3)");
}

} // namespace json_document_test
} // namespace godwit::mission
