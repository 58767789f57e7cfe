#include "io/http/message.hpp"

#include <gtest/gtest.h>

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
} // namespace godwit::io::http
