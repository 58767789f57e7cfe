#include "programs/godwitd/control/request_line.hpp"

#include <gtest/gtest.h>

namespace {

using namespace godwit::control;

TEST(control_request_line, says_what_to_do) {
  EXPECT_EQ(read_request(R"({"do": "status"})")->what, request_kind::status);
  const auto retry = read_request(R"({"do": "outbox_retry", "key": "abc"})");
  ASSERT_TRUE(retry);
  EXPECT_EQ(retry->what, request_kind::outbox_retry);
  EXPECT_EQ(retry->key, "abc");
}

TEST(control_request_line, what_means_nothing_is_refused_with_the_form) {
  for (const auto* line : {"", "status", "[]", "{}", R"({"do": 7})", R"({"do": "land"})", "{\"do\": \"status\""})
    EXPECT_FALSE(read_request(line)) << line;
}

TEST(control_request_line, asking_it_to_fly_is_an_error_that_says_so) {
  const auto start = read_request(R"({"do": "start"})");
  ASSERT_FALSE(start);
  EXPECT_NE(start.error().find("does not fly"), std::string::npos);
}

TEST(control_request_line, a_refusal_is_one_line_of_json) {
  EXPECT_EQ(refusal_line("no\nway"), R"({"error":"no\nway","ok":false})");
}

} // namespace
