#include "io/http/error.hpp"

#include <set>
#include <string_view>

#include <gtest/gtest.h>

namespace godwit::io::http {
namespace error_test {

TEST(http_error, is_a_sentence_that_begins_with_the_place) {
  EXPECT_EQ((error{errc::refused, "nobody listens there", "https://a:443/x"}.message()),
            "https://a:443/x: nobody listens there");
  EXPECT_EQ((error{errc::refused, "nobody listens there", {}}.message()), "nobody listens there");
}

TEST(http_error, has_a_name_of_its_own_for_each_code) {
  std::set<std::string_view> names;
  for (const auto& [code, name] : enum_names(errc{}))
    EXPECT_TRUE(names.insert(name).second) << name;
  EXPECT_EQ(names.size(), static_cast<std::size_t>(errc::cancelled) + 1); // the last one
}

TEST(http_error, is_worth_another_try_when_nobody_has_to_do_something_first) {
  for (const auto code : {errc::too_many, errc::cannot_resolve, errc::refused, errc::unreachable, errc::connect_timeout,
                          errc::read_timeout, errc::total_timeout, errc::connection_lost, errc::truncated})
    EXPECT_TRUE(is_transient(code)) << name_of(code);
  for (const auto code : {errc::token_file, errc::tls_failed, errc::tls_not_verified, errc::wrong_host,
                          errc::body_too_large, errc::redirect, errc::cancelled, errc::proxy_refused})
    EXPECT_FALSE(is_transient(code)) << name_of(code);
}

} // namespace error_test
} // namespace godwit::io::http
