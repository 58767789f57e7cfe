#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "actors/failsafe/state.hpp"
#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"
#include "tests/actors/failsafe/positions.hpp"

namespace state_test {

using namespace godwit::failsafe;
using namespace godwit::tests;

standing full() {
  return {.in_flight = true,
          .latches = {{rule::fence, latch_kind::acted}, {rule::battery_low, latch_kind::covered}},
          .reacts = reaction{rule::fence, action::hold, reaction_phase::unsure, 7},
          .last_number = 12,
          .overridden = {{rule::operator_link, "range test", 1'700'000'000'000'000'000}},
          .pilot = {flight_mode{mode_kind::hold, 5}, true, {{mode_kind::unknown, 17, 6}, {mode_kind::hold, {}, {}}}},
          .link = {true, 1'600'000'000'000'000'000, true}};
}

TEST(failsafe_state, it_comes_back_from_json_as_it_went) {
  state before{full(), {{fence_of(godwit::mission::fence_kind::exclusion, square(10), 1.5, 2.5)}, 7, {9, true, {6}}}};
  state after;
  ASSERT_TRUE(godwit::io::read_json(nlohmann::json::parse(godwit::io::to_json(before)), after));
  EXPECT_EQ(after.now, before.now);
  EXPECT_EQ(after.limits, before.limits);
}

TEST(failsafe_state, what_is_remembered_replaces_what_was_and_keeps_limits_that_are_not_new) {
  state kept;
  const guard_mission limits{{fence_of(godwit::mission::fence_kind::inclusion, square(10))}, 7, {9, false, {17}}};
  EXPECT_TRUE(durable_core::apply(kept, remembered{{}, limits}, 0).empty());
  EXPECT_TRUE(durable_core::apply(kept, remembered{full(), {}}, 0).empty());
  EXPECT_EQ(kept.now, full());
  EXPECT_EQ(kept.limits, limits);
  EXPECT_TRUE(durable_core::resume(kept, 0).empty()) << "nothing is sent because of a restart";
}

TEST(failsafe_state, a_record_of_an_earlier_version_with_its_command_is_read_and_sends_nothing) {
  state kept;
  const remembered written{full(), {}, command_vehicle{3, rule::fence, action::return_home, 0}};
  remembered read;
  ASSERT_TRUE(godwit::io::read_json(nlohmann::json::parse(godwit::io::to_json(written)), read));
  EXPECT_TRUE(durable_core::apply(kept, read, 0).empty());
  EXPECT_EQ(kept.now, full());
}

TEST(failsafe_state, a_record_of_an_earlier_version_without_the_end_of_the_plan_is_read_and_the_plan_leads_nowhere) {
  state kept;
  const auto written = R"({
    "now": {"in_flight": true,
            "pilot": {"ours": {"kind": "mission", "custom_mode": 3}, "taken_over": false,
                      "expected": [{"kind": "hold", "until_ns": 1700000005000000000},
                                   {"kind": "returning", "until_ns": null}]}},
    "limits": {"geofences": [], "land_start": 7}})";
  const auto read = godwit::io::read_json(nlohmann::json::parse(written), kept);
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_TRUE(kept.now.in_flight);
  EXPECT_EQ(kept.limits, (guard_mission{{}, 7, {}}));
}

} // namespace state_test
