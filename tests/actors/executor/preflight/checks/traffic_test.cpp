#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace traffic_check_test {

using namespace test;

TEST(traffic_check, passes_whatever_is_heard_and_says_what_is_close) {
  auto seen = good_facts();
  seen.traffic.heard = {"SWR123, 800 m to the north", "HB-ABC, 900 m to the east", "HB-XYZ, 9 km to the west"};
  const auto far = check_traffic(seen, {});
  EXPECT_EQ(far.how, verdict::pass);
  EXPECT_EQ(far.sentence, "No other aircraft is close. The nearest: SWR123, 800 m to the north.");
  seen.traffic.close = {seen.traffic.heard[0], seen.traffic.heard[1]};
  const auto near = check_traffic(seen, {});
  EXPECT_EQ(near.how, verdict::pass) << "it is for a person to decide";
  EXPECT_TRUE(has(near.sentence, "is close")) << near.sentence;
  EXPECT_TRUE(has(near.sentence, "SWR123, 800 m to the north (and 1 more)")) << near.sentence;
}

TEST(traffic_check, is_skipped_while_none_is_heard) {
  auto seen = good_facts();
  seen.traffic = {};
  EXPECT_EQ(check_traffic(seen, {}).how, verdict::skipped);
}

} // namespace traffic_check_test
} // namespace godwit::executor::preflight
