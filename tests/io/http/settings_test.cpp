#include "io/http/settings.hpp"

#include <gtest/gtest.h>

namespace godwit::io::http {
namespace settings_test {

settings for_url(const std::string& url) {
  settings made;
  made.base_url = url;
  return made;
}

errc refusal(const settings& wanted) {
  const auto read = checked(wanted);
  if (read)
    ADD_FAILURE() << wanted.base_url << " was accepted";
  return read ? errc{} : read.error().code;
}

TEST(http_settings, take_https_and_http_without_a_token) {
  EXPECT_TRUE(checked(for_url("https://missions.example/api")));
  EXPECT_TRUE(checked(for_url("http://missions.example/api")));
  EXPECT_EQ(refusal(for_url("missions.example")), errc::invalid_settings);
}

TEST(http_settings, refuse_a_token_in_clear_but_to_this_computer) {
  auto wanted = for_url("http://missions.example");
  wanted.token_file = "/etc/godwit/token";
  EXPECT_EQ(refusal(wanted), errc::token_in_clear);
  EXPECT_NE(checked(wanted).error().message().find("use https://"), std::string::npos);
  for (const auto* url : {"http://127.0.0.1:8080", "http://localhost", "http://[::1]", "https://missions.example"}) {
    wanted.base_url = url;
    EXPECT_TRUE(checked(wanted)) << url;
  }
}

TEST(http_settings, refuse_a_token_in_clear_through_a_proxy_even_to_this_computer) {
  auto wanted = for_url("http://127.0.0.1");
  wanted.token_file = "/etc/godwit/token";
  wanted.proxy = "http://proxy.example:3128";
  EXPECT_EQ(refusal(wanted), errc::token_in_clear);
  wanted.base_url = "https://missions.example";
  EXPECT_TRUE(checked(wanted));
}

TEST(http_settings, name_a_proxy_by_host_and_port_only) {
  auto wanted = for_url("https://missions.example");
  for (const auto* proxy :
       {"https://proxy.example", "http://proxy.example/path", "http://user:pw@proxy.example", "x"}) {
    wanted.proxy = proxy;
    EXPECT_EQ(refusal(wanted), errc::invalid_settings) << proxy;
  }
}

TEST(http_settings, have_a_certificate_and_its_key_together_and_only_with_tls) {
  auto wanted = for_url("https://missions.example");
  wanted.certificate_file = "a.pem";
  EXPECT_EQ(refusal(wanted), errc::invalid_settings);
  wanted.key_file = "a.key";
  EXPECT_TRUE(checked(wanted));
  wanted.base_url = "http://missions.example";
  EXPECT_EQ(refusal(wanted), errc::invalid_settings);
}

TEST(http_settings, have_bounds_that_let_something_through) {
  auto wanted = for_url("https://missions.example");
  wanted.max_under_way = 0;
  EXPECT_EQ(refusal(wanted), errc::invalid_settings);
  wanted = for_url("https://missions.example");
  wanted.total_timeout = std::chrono::milliseconds(0);
  EXPECT_EQ(refusal(wanted), errc::invalid_settings);
}

} // namespace settings_test
} // namespace godwit::io::http
