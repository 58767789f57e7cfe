#include "actors/executor/preflight/result.hpp"

#include <gtest/gtest.h>

namespace godwit::executor::preflight {
namespace result_test {

TEST(preflight_result, what_nobody_filled_in_is_a_failure) { EXPECT_EQ(result{}.how, verdict::fail); }

TEST(preflight_result, verdicts_are_ordered_from_the_best_to_the_worst) {
  EXPECT_LT(verdict::skipped, verdict::pass);
  EXPECT_LT(verdict::pass, verdict::degraded);
  EXPECT_LT(verdict::degraded, verdict::fail);
}

TEST(preflight_result, a_sentence_has_a_bound) {
  for (const auto& each : {pass(std::string(9'999, 'x')), degraded(std::string(9'999, 'x')),
                           fail(std::string(9'999, 'x')), skipped(std::string(9'999, 'x'))})
    EXPECT_EQ(each.sentence.size(), max_sentence);
}

TEST(preflight_result, a_cut_leaves_no_half_character) {
  EXPECT_EQ(cut_text("abc", 3), "abc");
  EXPECT_EQ(cut_text("abc", 2), "ab");
  EXPECT_EQ(cut_text("a\u00e9", 2), "a");
  EXPECT_EQ(cut_text("a\u00e9", 3), "a\u00e9");
  EXPECT_EQ(cut_text("\U0001F426", 3), "");
}

TEST(preflight_result, a_summary_is_the_first_sentence_and_a_count) {
  EXPECT_EQ(summary_of({"One."}), "One.");
  EXPECT_EQ(summary_of({"One.", "Two.", "Three."}), "One. (and 2 more)");
}

} // namespace result_test
} // namespace godwit::executor::preflight
