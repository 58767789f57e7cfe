#include "io/http/url.hpp"

#include <gtest/gtest.h>

namespace godwit::io::http {
namespace url_test {

TEST(http_url, is_read_with_its_scheme_host_port_and_path) {
  const auto read = parse_url("https://missions.example:8443/api/v1/");
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, (url{true, "missions.example", 8443, "/api/v1"}));
  EXPECT_EQ(read->authority(), "missions.example:8443");
  EXPECT_EQ(read->host_header(), "missions.example:8443");
  EXPECT_EQ(read->origin(), "https://missions.example:8443");
}

TEST(http_url, has_the_usual_port_where_none_is_named) {
  EXPECT_EQ(parse_url("https://a")->port, 443);
  EXPECT_EQ(parse_url("HTTP://a/")->port, 80);
  EXPECT_EQ(parse_url("https://a")->host_header(), "a");
  EXPECT_EQ(parse_url("http://a/")->path, "");
}

TEST(http_url, takes_an_ipv6_address_in_brackets) {
  const auto read = parse_url("http://[::1]:8080/x");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->host, "::1");
  EXPECT_EQ(read->authority(), "[::1]:8080");
  EXPECT_EQ(parse_url("https://[2001:db8::1]")->host_header(), "[2001:db8::1]");
}

TEST(http_url, refuses_what_is_none) {
  for (const auto* text : {"",
                           "missions.example",
                           "ftp://a",
                           "https://",
                           "https://:443",
                           "https://a:0",
                           "https://a:65536",
                           "https://a:x",
                           "https://a b",
                           "https://a/b c",
                           "https://a/?q=1",
                           "https://a#f",
                           "https://a?q",
                           "https://[::1",
                           "https://[a]",
                           "https://a\r\nX: y",
                           "http://a/\x7f",
                           "https://[::1]x",
                           "https://[fe80::1%lo]",
                           "https://[fe80::1%25lo]",
                           "://a"})
    EXPECT_FALSE(parse_url(text)) << text;
}

TEST(http_url, refuses_a_password_without_repeating_it) {
  const auto refused = parse_url("https://user:hunter2@a");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message().find("hunter2"), std::string::npos);
}

TEST(http_url, knows_which_hosts_are_this_computer) {
  for (const auto* host : {"127.0.0.1", "127.5.0.1", "::1", "localhost", "LocalHost"})
    EXPECT_TRUE(names_this_computer(host)) << host;
  for (const auto* host : {"localhost.example", "10.0.0.1", "127.0.0.1.example", "0.0.0.0", "::", "2001:db8::1"})
    EXPECT_FALSE(names_this_computer(host)) << host;
}

} // namespace url_test
} // namespace godwit::io::http
