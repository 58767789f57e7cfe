#include "actors/domain/mission/utc_text.hpp"

#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace godwit::mission {
namespace utc_text_test {

TEST(utc_text, has_as_many_decimals_as_it_takes) {
  EXPECT_EQ(utc_text(0), "1970-01-01T00:00:00Z");
  EXPECT_EQ(utc_text(1'777'889'730'250'000'000), "2026-05-04T10:15:30.25Z");
  EXPECT_EQ(utc_text(-1), "1969-12-31T23:59:59.999999999Z");
}

TEST(utc_text, a_day_that_does_not_exist_is_no_time) {
  for (const auto* text :
       {"2025-02-29T00:00:00Z", "2026-13-01T00:00:00Z", "2026-00-10T00:00:00Z", "2026-01-01T24:00:00Z",
        "2026-01-01T23:60:00Z", "2026-01-01T23:59:60Z", "1677-01-01T00:00:00Z", "2262-01-01T00:00:00Z"})
    EXPECT_EQ(time_of_utc_text(text), std::nullopt) << text;
  EXPECT_TRUE(time_of_utc_text("2024-02-29T00:00:00Z").has_value());
}

TEST(utc_text, another_form_is_no_time) {
  for (const auto* text : {"", "Z", "2026-05-04", "2026-05-04T10:15:30", "2026-05-04 10:15:30Z",
                           "2026-05-04T10:15:30+00:00", "2026-05-04T10:15:30.Z", "2026-05-04T10:15:30.1234567890Z",
                           "2026-05-04T10:15:30,5Z", "2026-05-04T10:15:30.5xZ", "+026-05-04T10:15:30Z"})
    EXPECT_EQ(time_of_utc_text(text), std::nullopt) << text;
}

RC_GTEST_PROP(utc_text_property, a_time_reads_back_as_itself, ()) {
  const auto time_ns = *rc::gen::inRange<std::int64_t>(-9'000'000'000'000'000'000, 9'000'000'000'000'000'000);
  RC_ASSERT(time_of_utc_text(utc_text(time_ns)) == std::optional(time_ns));
}

} // namespace utc_text_test
} // namespace godwit::mission
