#include <gtest/gtest.h>

#include "io/http/message.hpp"

namespace godwit::io::http {

namespace message_test {

TEST(http_message, finds_the_first_header_of_a_name_in_any_case) {
  response answer;
  answer.headers = {{"Retry-After", "1"}, {"retry-after", "2"}};
  EXPECT_EQ(answer.find("RETRY-AFTER"), "1");
  EXPECT_EQ(answer.find("Retry"), "");
}

TEST(http_message, may_be_repeated_unless_it_is_a_post_without_a_key) {
  request asked;
  for (const auto each : {method::get, method::put, method::remove}) {
    asked.method = each;
    EXPECT_TRUE(may_repeat(asked)) << method_text(each);
  }
  asked.method = method::post;
  EXPECT_FALSE(may_repeat(asked));
  asked.idempotency_key = "key";
  EXPECT_TRUE(may_repeat(asked));
}

} // namespace message_test

namespace content_type_test {

TEST(http_content_type, is_compared_without_case_and_parameters) {
  EXPECT_TRUE(has_content_type("Application/JSON; charset=UTF-8; q=1", "application/json"));
  EXPECT_TRUE(has_content_type(" application/json ;profile=\"x\"", "application/json"));
  EXPECT_FALSE(has_content_type("text/html", "application/json"));
  EXPECT_FALSE(has_content_type("application/jsonx", "application/json"));
  EXPECT_FALSE(has_content_type("", "application/json"));
  EXPECT_FALSE(has_content_type("", ""));
}

TEST(http_content_type, of_another_character_set_is_another_one) {
  EXPECT_TRUE(has_content_type("application/json;charset=\"utf-8\"", "application/json"));
  EXPECT_FALSE(has_content_type("application/json; charset=iso-8859-1", "application/json"));
  EXPECT_FALSE(has_content_type("application/json; a=b; charset=utf-16", "application/json"));
}

TEST(http_content_type, is_json_with_a_suffix_too) {
  for (const auto* type : {"application/json", "application/geo+json", "application/problem+JSON; charset=utf-8"})
    EXPECT_TRUE(is_json(type)) << type;
  for (const auto* type : {"", "text/json", "+json", "application/json-seq", "application/x; a=b+json", "a/b/c+json"})
    EXPECT_FALSE(is_json(type)) << type;
}

TEST(http_content_type, has_a_type_and_a_subtype) {
  EXPECT_EQ(media_type("text/html; charset=utf-8"), "text/html");
  EXPECT_EQ(media_type("text"), "");
  EXPECT_EQ(media_type(";"), "");
}

} // namespace content_type_test

} // namespace godwit::io::http
