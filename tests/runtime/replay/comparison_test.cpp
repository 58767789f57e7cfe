#include "runtime/replay/comparison.hpp"

#include <gtest/gtest.h>

namespace comparison_test {

using namespace godwit::runtime;

TEST(comparison, messages_that_mean_the_same_do_not_differ) {
  EXPECT_TRUE(differences(R"({"a":1,"b":[true,null]})", R"({ "b" : [ true, null ], "a" : 1 })", 0).empty());
}

TEST(comparison, each_field_that_differs_is_named_with_both_values) {
  const auto found = differences(R"({"mode":"hold","items":[{"seq":1},{"seq":2}],"gone":1})",
                                 R"({"mode":"land","items":[{"seq":1},{"seq":3}],"new":2})", 0);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].field, "gone");
  EXPECT_EQ(found[0].produced, "");
  EXPECT_EQ(found[1].field, "items[1].seq");
  EXPECT_EQ(found[1].expected, "2");
  EXPECT_EQ(found[1].produced, "3");
  EXPECT_EQ(found[2].field, "mode");
  EXPECT_EQ(found[3].field, "new");
  EXPECT_EQ(found[3].expected, "");
}

TEST(comparison, times_alone_may_differ_by_the_tolerance) {
  constexpr std::int64_t tolerance_ns = 5'000'000;
  EXPECT_TRUE(differences(R"({"at_ns":1000000})", R"({"at_ns":5900000})", tolerance_ns).empty());
  EXPECT_FALSE(differences(R"({"at_ns":1000000})", R"({"at_ns":6100000})", tolerance_ns).empty());
  EXPECT_TRUE(differences(R"({"age_ms":10})", R"({"age_ms":16})", tolerance_ns).empty()); // both are rounded
  EXPECT_FALSE(differences(R"({"age_ms":10})", R"({"age_ms":17})", tolerance_ns).empty());
  EXPECT_FALSE(differences(R"({"seq":10})", R"({"seq":11})", tolerance_ns).empty());
  EXPECT_FALSE(differences(R"({"at_ns":1})", R"({"at_ns":2})", 0).empty());
  const std::string at = R"({"at":"2026-05-04T10:15:30.251Z"})";
  EXPECT_TRUE(differences(at, R"({"at":"2026-05-04T10:15:30.2549Z"})", tolerance_ns).empty());
  EXPECT_FALSE(differences(at, R"({"at":"2026-05-04T10:15:30.257Z"})", tolerance_ns).empty());
  EXPECT_FALSE(differences(at, R"({"at":"2026-05-04T10:15:31.251Z"})", tolerance_ns).empty());
}

TEST(comparison, what_is_no_json_is_compared_as_it_is) {
  EXPECT_TRUE(differences("{", "{", 0).empty());
  EXPECT_EQ(differences("{", "{}", 0).size(), 1U);
}

} // namespace comparison_test
