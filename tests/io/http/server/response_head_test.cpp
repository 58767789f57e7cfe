#include "io/http/server/response_head.hpp"

#include <gtest/gtest.h>

namespace godwit::io::http {
namespace response_head_test {

server_response with_header(std::string name, std::string value) {
  return {.body = "hello", .headers = {{std::move(name), std::move(value)}}};
}

TEST(http_response_head, says_status_type_length_and_further_headers) {
  EXPECT_EQ(response_head(with_header("Retry-After", "1"), 5, false),
            "HTTP/1.1 200 OK\r\nContent-Type: application/json\r\nContent-Length: 5\r\nRetry-After: 1\r\n\r\n");
}

TEST(http_response_head, the_last_answer_says_so) {
  EXPECT_TRUE(response_head({}, 0, true).ends_with("\r\nConnection: close\r\n\r\n"));
  EXPECT_EQ(response_head({}, 0, false).find("Connection"), std::string::npos);
}

TEST(http_response_head, an_answer_without_a_body_has_neither_type_nor_length) {
  for (const auto& [status, line] : {std::pair{204U, "HTTP/1.1 204 No Content"}, {304U, "HTTP/1.1 304 Not Modified"}})
    EXPECT_EQ(response_head({.status = status, .body = {}, .headers = {}}, 0, false), std::string(line) + "\r\n\r\n");
}

TEST(http_response_head, a_body_of_unknown_length_has_none) {
  EXPECT_EQ(response_head({}, std::nullopt, true).find("Content-Length"), std::string::npos);
}

TEST(http_response_head, data_can_not_write_headers_of_its_own) {
  const auto head = response_head(with_header("X-Name", "a\r\nSet-Cookie: b\n\x7f\tc\xc3\xa4"), 5, false);
  EXPECT_NE(head.find("X-Name: a??Set-Cookie: b??\tc\xc3\xa4\r\n"), std::string::npos) << head;
  const auto name = response_head(with_header("X\r\nSet-Cookie", "b"), 5, false);
  EXPECT_NE(name.find("X??Set-Cookie: b\r\n"), std::string::npos) << name;
}

TEST(http_response_head, a_status_that_is_not_known_has_no_phrase) {
  EXPECT_EQ(reason_phrase(418), "");
  EXPECT_TRUE(response_head({.status = 418, .body = {}, .headers = {}}, 0, false).starts_with("HTTP/1.1 418 \r\n"));
}

TEST(http_response_head, a_problem_is_a_document_with_its_status_and_a_sentence) {
  const auto problem = problem_response(413, "Up to 100 bytes.");
  EXPECT_EQ(problem.status, 413U);
  EXPECT_EQ(problem.content_type, problem_type);
  EXPECT_EQ(problem.body,
            R"({"type":"about:blank","title":"Content Too Large","status":413,"detail":"Up to 100 bytes."})");
}

} // namespace response_head_test
} // namespace godwit::io::http
