#include "io/http/exchange.hpp"

#include <gtest/gtest.h>

namespace godwit::io::http {
namespace redaction_test {

std::string without(std::string text, std::string_view token) {
  redact(text, token);
  return text;
}

TEST(http_redaction, a_token_is_taken_out_wherever_it_stands) {
  EXPECT_EQ(without("Bearer s3cr3t.token and s3cr3t.token", "s3cr3t.token"), "Bearer (token) and (token)");
  EXPECT_EQ(without("nothing of it", "s3cr3t.token"), "nothing of it");
}

TEST(http_redaction, a_slash_may_be_escaped_as_in_json) {
  EXPECT_EQ(without(R"-({"detail": "Bearer ab\/cd\/ef"})-", "ab/cd/ef"), R"-({"detail": "Bearer (token)"})-");
}

TEST(http_redaction, no_token_and_one_that_stands_in_any_text_leave_it_as_it_is) {
  EXPECT_EQ(without("abcabc", ""), "abcabc");
  EXPECT_EQ(without("abcabc", "abc"), "abcabc");
}

} // namespace redaction_test
} // namespace godwit::io::http
