#include <gtest/gtest.h>

#include "actors/failsafe/sentences.hpp"

namespace sentences_test {

using namespace godwit::failsafe;

TEST(sentences, each_rule_says_its_cause) {
  const battery_verdict level{.known = true, .percent = 14};
  const fence_verdict beyond{fence_finding::breached, breach{2}, {}};
  EXPECT_EQ(cause_of(rule::battery_critical, level, {}), "the battery is at 14 %");
  EXPECT_EQ(cause_of(rule::battery_low, level, {}), "the battery is at 14 %");
  EXPECT_EQ(cause_of(rule::fence, level, beyond), "a fence is breached: it is in geofence 3, which excludes it");
  EXPECT_EQ(cause_of(rule::operator_link, level, {}), "the operator's ground station is lost");
}

TEST(sentences, each_action_says_what_the_vehicle_does) {
  EXPECT_EQ(deed_of(action::return_home), "the vehicle returns");
  EXPECT_EQ(deed_of(action::land), "the vehicle lands");
  EXPECT_EQ(deed_of(action::hold), "the vehicle holds");
  EXPECT_EQ(deed_of(action::do_land_start), "the vehicle goes on at the landing of its mission");
}

} // namespace sentences_test
