#include "io/http/head_rules.hpp"

#include <gtest/gtest.h>

namespace godwit::io::http {
namespace head_rules_test {

response head(unsigned status, std::vector<header> headers = {}) { return {status, std::move(headers), {}, 0, false}; }

TEST(http_head_rules, refuse_every_redirect_and_no_304) {
  for (const unsigned status : {300U, 301U, 302U, 303U, 305U, 307U, 308U, 399U})
    EXPECT_EQ(judge_head(head(status), {}).error().code, errc::redirect) << status;
  for (const unsigned status : {200U, 204U, 304U, 400U, 503U})
    EXPECT_TRUE(judge_head(head(status), "")) << status;
}

TEST(http_head_rules, refuse_every_second_coding_too) {
  EXPECT_EQ(judge_head(head(200, {{"Content-Encoding", "identity"}, {"content-encoding", "br"}}), {}).error().code,
            errc::encoded);
  EXPECT_TRUE(judge_head(head(200, {{"Transfer-Encoding", "Chunked"}}), {}));
}

TEST(http_head_rules, quote_what_is_foreign_without_control_characters_queries_and_length) {
  EXPECT_EQ(quotable("https://a/b?token=c"), "https://a/b");
  EXPECT_EQ(quotable("a\x1b[31m\nb\xff"), "a?[31m?b?");
  EXPECT_EQ(quotable(std::string(1000, 'a')), std::string(200, 'a') + "...");
}

} // namespace head_rules_test
} // namespace godwit::io::http
