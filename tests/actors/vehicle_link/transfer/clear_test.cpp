#include "actors/vehicle_link/transfer/clear.hpp"

#include <gtest/gtest.h>

#include "tests/support/transfer_world.hpp"

namespace godwit::tests {
namespace clear_test {

namespace mavlink = io::mavlink;
using mavlink::mav_autopilot;
using mavlink::mav_mission_result;
using mavlink::mav_mission_type;
using transfer::verdict;

transfer_world px4_world() { return {mission_server::px4_profile(), transfer::profile_for(mav_autopilot::px4), {}, 1}; }

transfer_world copter_world() {
  return {mission_server::ardupilot_copter_profile(), transfer::profile_for(mav_autopilot::ardupilotmega), {}, 1};
}

TEST(clear, the_plan_is_gone_and_the_vehicle_was_asked) {
  for (auto make : {+[] { return px4_world(); }, +[] { return copter_world(); }}) {
    auto world = make();
    ASSERT_EQ(world.upload(mission_of(10)).verdict, verdict::accepted);
    const auto outcome = world.clear();
    EXPECT_EQ(outcome.verdict, verdict::accepted);
    EXPECT_EQ(outcome.proof, transfer::proof::counted);
    EXPECT_TRUE(world.vehicle().plan(mav_mission_type::mission).items.empty());
  }
}

TEST(clear, an_upload_of_no_items_clears) {
  auto world = px4_world();
  ASSERT_EQ(world.upload(mission_of(10)).verdict, verdict::accepted);
  EXPECT_EQ(world.upload({}).verdict, verdict::accepted);
  EXPECT_TRUE(world.vehicle().plan(mav_mission_type::mission).items.empty());
}

TEST(clear, leaves_the_plans_of_other_types) {
  auto world = px4_world();
  ASSERT_EQ(world.upload(mission_of(10)).verdict, verdict::accepted);
  EXPECT_EQ(world.clear(mav_mission_type::fence).verdict, verdict::accepted);
  EXPECT_EQ(world.vehicle().plan(mav_mission_type::mission).items.size(), 10U);
}

TEST(clear, a_late_acknowledgement_of_something_else_is_not_believed) {
  auto world = px4_world();
  ASSERT_EQ(world.upload(mission_of(10)).verdict, verdict::accepted);
  int lost = 0;
  world.ours().drops_sent = [&](const transfer::outgoing& each) {
    return std::holds_alternative<mavlink::mission_clear_all>(each) && lost++ == 0;
  };
  auto& client = world.ours().client;
  world.begin(world.ours(), client.clear(mav_mission_type::mission, world.time().now_ns()));
  world.begin(world.ours(), client.on(mavlink::mission_ack{}, world.time().now_ns())); // of the upload, a second time
  ASSERT_TRUE(world.run_until_idle(world.ours()));
  EXPECT_EQ(world.ours().outcomes.back().verdict, verdict::accepted);
  EXPECT_EQ(world.ours().outcomes.back().effort.restarts, 1U);
  EXPECT_TRUE(world.vehicle().plan(mav_mission_type::mission).items.empty());
}

TEST(clear, a_vehicle_that_flies_its_mission_refuses) {
  auto world = copter_world();
  ASSERT_EQ(world.upload(mission_of(10)).verdict, verdict::accepted);
  world.vehicle().lock(true);
  const auto outcome = world.clear();
  EXPECT_EQ(outcome.verdict, verdict::refused);
  EXPECT_EQ(outcome.result, mavlink::number(mav_mission_result::error));
  EXPECT_EQ(outcome.holding, transfer::holding::unchanged);
  EXPECT_EQ(world.vehicle().plan(mav_mission_type::mission).items.size(), 10U);
}

TEST(clear, a_transfer_of_ours_that_px4_takes_for_open_is_closed_first) {
  auto world = px4_world();
  ASSERT_EQ(world.upload(mission_of(3)).verdict, verdict::accepted);
  world.ours().drops_sent = [lost = 0](const transfer::outgoing& each) mutable {
    return std::holds_alternative<mavlink::mission_ack>(each) && lost++ == 0;
  };
  ASSERT_EQ(world.download().verdict, verdict::accepted);
  const auto outcome = world.clear();
  EXPECT_EQ(outcome.verdict, verdict::accepted);
  EXPECT_LT(outcome.duration_ns, 2'000'000'000);
}

TEST(clear, a_silent_vehicle_leaves_it_unknown) {
  auto world = px4_world();
  world.ours().line.cut(true);
  const auto outcome = world.clear();
  EXPECT_EQ(outcome.verdict, verdict::timed_out);
  EXPECT_EQ(outcome.phase, transfer::phase::clearing);
  EXPECT_EQ(outcome.holding, transfer::holding::unknown);
}

} // namespace clear_test
} // namespace godwit::tests
