#include "programs/godwit-eyes/detection/appearance.hpp"

#include <gtest/gtest.h>

namespace godwit::eyes {
namespace appearance_test {

using io::eyes::object_class;

const cv::Rect2d box(-5, -10, 10, 20);

TEST(appearance, the_class_is_that_of_the_higher_scores_and_needs_half_of_the_answers) {
  appearance looks;
  EXPECT_EQ(looks.what(), object_class::unknown);
  looks.add_recognised(object_class::animal, 0.5, box);
  looks.add_recognised(object_class::person, 0.9, box);
  EXPECT_EQ(looks.what(), object_class::person);
  for (int n = 0; n < 3; ++n)
    looks.add_unrecognised(false);
  EXPECT_EQ(looks.what(), object_class::unknown);
}

TEST(appearance, it_is_recognised_when_two_answers_say_so) {
  appearance looks;
  looks.add_recognised(object_class::person, 0.9, box);
  EXPECT_FALSE(looks.is_recognised());
  looks.add_recognised(object_class::person, 0.9, box);
  EXPECT_TRUE(looks.is_recognised());
  looks.add_unrecognised(false);
  looks.add_unrecognised(false);
  EXPECT_FALSE(looks.is_recognised());
}

TEST(appearance, it_is_unlike_where_an_answer_counts_against_it_and_none_recognised_it) {
  appearance looks;
  looks.add_unrecognised(false);
  EXPECT_FALSE(looks.is_unlike());
  looks.add_unrecognised(true);
  EXPECT_TRUE(looks.is_unlike());
  EXPECT_FALSE(looks.is_surely_unlike());
  looks.add_unrecognised(true);
  EXPECT_TRUE(looks.is_surely_unlike());
  looks.add_recognised(object_class::boat, 0.5, box);
  EXPECT_FALSE(looks.is_unlike());
  EXPECT_FALSE(looks.is_surely_unlike());
}

TEST(appearance, its_extent_is_smoothed_and_lasts_two_seconds) {
  appearance looks;
  EXPECT_FALSE(looks.extent());
  looks.add_recognised(object_class::person, 0.9, box);
  EXPECT_EQ(looks.extent(), box);
  looks.add_recognised(object_class::person, 0.9, {-7, -12, 14, 24});
  EXPECT_EQ(looks.extent(), cv::Rect2d(-6, -11, 12, 22));
  looks.add_recognised(object_class::vehicle, 0.9, {40, 40, 80, 30});
  EXPECT_EQ(looks.extent(), cv::Rect2d(-6, -11, 12, 22)) << "a car beside it is something else";
  looks.pass(2.1);
  EXPECT_FALSE(looks.extent());
  looks.add_recognised(object_class::person, 0.9, box);
  EXPECT_EQ(looks.extent(), box) << "not mixed with what is old";
}

} // namespace appearance_test
} // namespace godwit::eyes
