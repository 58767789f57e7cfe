#include <gtest/gtest.h>

#include "io/http/outcome.hpp"

namespace godwit::io::http {

namespace outcome_test {

using namespace std::chrono_literals;

constexpr wall_time asked_at = std::chrono::sys_days(2026y / 11 / 21) + 14h;

response answer_with(std::vector<header> headers) { return {503, std::move(headers), "", 0, false}; }

TEST(http_outcome, says_what_may_be_tried_again) {
  for (const unsigned status : {200U, 201U, 204U, 299U})
    EXPECT_EQ(outcome_of(status), outcome::success) << status;
  for (const unsigned status : {408U, 429U, 500U, 502U, 503U, 504U, 599U})
    EXPECT_EQ(outcome_of(status), outcome::transient) << status;
  for (const unsigned status : {304U, 400U, 401U, 403U, 404U, 409U, 410U, 422U, 600U})
    EXPECT_EQ(outcome_of(status), outcome::permanent) << status;
}

TEST(http_outcome, takes_the_seconds_of_retry_after) {
  EXPECT_EQ(retry_after(answer_with({{"retry-after", "120"}}), asked_at), 120s);
  EXPECT_EQ(retry_after(answer_with({{"Retry-After", "0"}}), asked_at), 0s);
}

TEST(http_outcome, takes_the_date_of_retry_after_relative_to_the_date_of_the_answer) {
  const header later{"Retry-After", "Sun, 06 Nov 1994 08:49:37 GMT"};
  EXPECT_EQ(retry_after(answer_with({later, {"Date", "Sun, 06 Nov 1994 08:49:07 GMT"}}), asked_at), 30s);
  EXPECT_EQ(retry_after(answer_with({later, {"Date", "Sun, 06 Nov 1994 08:50:00 GMT"}}), asked_at), 0s);
  EXPECT_EQ(retry_after(answer_with({{"Retry-After", "Sat, 21 Nov 2026 14:00:10 GMT"}}), asked_at), 10s);
}

TEST(http_outcome, never_waits_longer_than_its_bound) {
  EXPECT_EQ(retry_after(answer_with({{"Retry-After", "9999999"}}), asked_at), max_retry_after);
  EXPECT_EQ(retry_after(answer_with({{"Retry-After", "99999999999999999999999999"}}), asked_at), max_retry_after);
  EXPECT_EQ(retry_after(answer_with({{"Retry-After", "Fri, 31 Dec 9999 23:59:59 GMT"}}), asked_at), max_retry_after);
}

TEST(http_outcome, does_not_guess_what_can_not_be_read) {
  EXPECT_EQ(retry_after(answer_with({}), asked_at), std::nullopt);
  for (const auto* text : {"", "-1", "1.5", "soon", "+3", " 3"})
    EXPECT_EQ(retry_after(answer_with({{"Retry-After", text}}), asked_at), std::nullopt) << text;
}

} // namespace outcome_test

namespace http_date_test {

using namespace std::chrono_literals;

constexpr wall_time now = std::chrono::sys_days(2026y / 11 / 21) + 14h;
constexpr wall_time example = std::chrono::sys_days(1994y / 11 / 6) + 8h + 49min + 37s;

TEST(http_date, is_read_in_all_three_forms_of_the_standard) {
  EXPECT_EQ(parse_http_date("Sun, 06 Nov 1994 08:49:37 GMT", now), example);
  EXPECT_EQ(parse_http_date("Sunday, 06-Nov-94 08:49:37 GMT", now), example);
  EXPECT_EQ(parse_http_date("Sun Nov  6 08:49:37 1994", now), example);
}

TEST(http_date, with_two_digits_is_at_most_50_years_ahead) {
  EXPECT_EQ(parse_http_date("Sunday, 06-Nov-76 08:49:37 GMT", now),
            std::chrono::sys_days(2076y / 11 / 6) + 8h + 49min + 37s);
  EXPECT_EQ(parse_http_date("Sunday, 06-Nov-77 08:49:37 GMT", now),
            std::chrono::sys_days(1977y / 11 / 6) + 8h + 49min + 37s);
}

TEST(http_date, must_exist) {
  for (const auto* text :
       {"Sun, 31 Feb 2026 08:49:37 GMT", "Sun, 00 Nov 1994 08:49:37 GMT", "Sun, 06 Nov 1994 24:00:00 GMT",
        "Sun, 06 Nov 1994 08:60:37 GMT", "Sun, 06 Nov 1994 08:49:61 GMT", "Sun, 29 Feb 2025 00:00:00 GMT"})
    EXPECT_FALSE(parse_http_date(text, now)) << text;
  EXPECT_TRUE(parse_http_date("Thu, 29 Feb 2024 00:00:00 GMT", now));
  EXPECT_TRUE(parse_http_date("Sat, 31 Dec 2016 23:59:60 GMT", now)); // a leap second
}

TEST(http_date, of_any_other_form_is_none) {
  for (const auto* text :
       {"", "120", "Sun, 06 Nov 1994 08:49:37", "Sun, 06 Nov 1994 08:49:37 UTC", "Sun, 06 Nov 1994 08:49:37 GMT ",
        "sun, 06 nov 1994 08:49:37 gmt", "Sun, 6 Nov 1994 08:49:37 GMT", "1994-11-06T08:49:37Z"})
    EXPECT_FALSE(parse_http_date(text, now)) << text;
}

} // namespace http_date_test

} // namespace godwit::io::http
