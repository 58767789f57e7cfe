#include "io/http/request_head.hpp"

#include <gtest/gtest.h>

namespace godwit::io::http {
namespace request_head_test {

destination to(const std::string& url, const std::string& proxy = {}) {
  settings wanted;
  wanted.base_url = url;
  wanted.proxy = proxy;
  return *checked(wanted);
}

request post_with(std::string body) {
  request asked;
  asked.method = method::post;
  asked.target = "/missions/7/progress?x=1";
  asked.body = std::move(body);
  asked.idempotency_key = "key-1";
  return asked;
}

bool is_taken(const request& asked) { return check_request(asked, to("https://missions.example")).has_value(); }

TEST(http_request_head, is_written_with_all_that_the_service_needs) {
  auto asked = post_with("{}");
  asked.headers = {{"X-Vehicle", "7"}};
  EXPECT_EQ(request_head(asked, to("https://missions.example/api"), "t0ken").revealed(),
            "POST /api/missions/7/progress?x=1 HTTP/1.1\r\nHost: missions.example\r\nAccept-Encoding: identity\r\n"
            "User-Agent: godwit\r\nAccept: application/json\r\nAuthorization: Bearer t0ken\r\n"
            "Idempotency-Key: key-1\r\nContent-Type: application/json\r\nContent-Length: 2\r\nX-Vehicle: 7\r\n\r\n");
}

TEST(http_request_head, of_a_get_has_neither_body_nor_token_that_were_not_given) {
  EXPECT_EQ(request_head({}, to("http://127.0.0.1:81"), {}).revealed(),
            "GET / HTTP/1.1\r\nHost: 127.0.0.1:81\r\nAccept-Encoding: identity\r\nUser-Agent: godwit\r\n"
            "Accept: application/json\r\n\r\n");
}

TEST(http_request_head, names_the_codings_that_a_request_accepts) {
  request asked;
  asked.accepts_compressed = true;
  EXPECT_NE(request_head(asked, to("http://a"), {}).revealed().find("Accept-Encoding: zstd, gzip\r\n"),
            std::string_view::npos);
}

TEST(http_request_head, of_an_empty_post_says_its_length) {
  EXPECT_NE(request_head(post_with(""), to("https://a"), {}).revealed().find("Content-Length: 0\r\n"),
            std::string_view::npos);
}

TEST(http_request_head, names_the_whole_url_to_a_proxy_of_plain_http) {
  EXPECT_TRUE(request_head({}, to("http://a.example/x", "http://proxy:3128"), {})
                  .revealed()
                  .starts_with("GET http://a.example:80/x/ HTTP/1.1\r\nHost: a.example\r\n"));
  EXPECT_TRUE(request_head({}, to("https://a.example/x", "http://proxy:3128"), {}).revealed().starts_with("GET /x/ "));
}

TEST(http_request_head, asks_a_proxy_for_a_way_without_the_token) {
  EXPECT_EQ(connect_head(to("https://a.example", "http://proxy:3128")),
            "CONNECT a.example:443 HTTP/1.1\r\nHost: a.example:443\r\nUser-Agent: godwit\r\n\r\n");
}

TEST(http_request_head, lets_no_data_write_headers_of_its_own) {
  request asked;
  for (const auto* target : {"", "missions", "/a b", "/a\r\nX: y", "/a#b", "/caf\xc3\xa9"}) {
    asked.target = target;
    EXPECT_FALSE(is_taken(asked)) << target;
  }
  asked = {};
  asked.idempotency_key = "a\r\nX: y";
  EXPECT_FALSE(is_taken(asked));
  asked = {};
  asked.accept = "a\nb";
  EXPECT_FALSE(is_taken(asked));
  for (const header& bad : {header{"X", "a\r\nb"}, header{"X Y", "a"}, header{"", "a"}, header{"X:", "a"}}) {
    asked = {};
    asked.headers = {bad};
    EXPECT_FALSE(is_taken(asked)) << bad.name;
  }
}

TEST(http_request_head, writes_some_headers_itself) {
  request asked;
  for (const auto* name : {"authorization", "Host", "content-length", "TRANSFER-ENCODING", "Connection"}) {
    asked.headers = {{name, "x"}};
    EXPECT_FALSE(is_taken(asked)) << name;
  }
}

TEST(http_request_head, has_bounds) {
  request asked;
  asked.target = "/" + std::string(max_target_bytes - 1, 'a');
  EXPECT_TRUE(is_taken(asked));
  asked.target += 'a';
  EXPECT_FALSE(is_taken(asked));
  asked = post_with(std::string(max_request_body_bytes, 'a'));
  EXPECT_TRUE(is_taken(asked));
  asked.body += 'a';
  EXPECT_FALSE(is_taken(asked));
  asked = {};
  asked.headers = {{"X", std::string(max_request_head_bytes, 'a')}};
  EXPECT_FALSE(is_taken(asked));
}

} // namespace request_head_test
} // namespace godwit::io::http
