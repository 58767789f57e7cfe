#include "tests/support/eyes/naive_detector.hpp"

#include <gtest/gtest.h>

#include "tests/support/eyes/score.hpp"
#include "tests/support/eyes/suite.hpp"

namespace godwit::eyes::test {
namespace naive_detector_test {

score score_with(const naive_settings& settings) {
  sim::camera::suite_options options;
  score_rules rules;
  rules.overlap = 0.25;
  const sim::camera::suite_case flight(sim::camera::tuning_seed(2), sim::camera::tier::a, options);
  naive_detector naive(settings);
  score result;
  for (int frame = 30; frame < 40; ++frame) {
    const auto taken = flight.frame(frame);
    const auto boxes =
        naive.look({taken.seen.grey.data(), taken.seen.width, taken.seen.height, 1280, frame * 33'000'000LL});
    if (frame > 30)
      result += score_of(taken.real, boxes, rules);
  }
  return result;
}

TEST(naive_detector, finds_some_and_more_when_it_is_tuned) {
  const score tuned = score_with(tuned_naive);
  EXPECT_GT(tuned.f1(), 0.4);
  EXPECT_GT(tuned.f1(), score_with({}).f1());
}

} // namespace naive_detector_test
} // namespace godwit::eyes::test
