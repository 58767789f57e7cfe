#include "actors/vehicle_link/transfer/download.hpp"

#include <gtest/gtest.h>

#include "tests/support/time_units.hpp"
#include "tests/support/transfer_world.hpp"

namespace godwit::tests {
namespace download_test {

namespace mavlink = io::mavlink;
using mavlink::mav_autopilot;
using mavlink::mav_mission_type;
using transfer::verdict;

using godwit::tests::ms;

transfer_world px4_world(const line_settings& line = {}) {
  return {mission_server::px4_profile(), transfer::profile_for(mav_autopilot::px4), line, 1};
}

transfer_world copter_world(const line_settings& line = {}) {
  return {mission_server::ardupilot_copter_profile(), transfer::profile_for(mav_autopilot::ardupilotmega), line, 1};
}

TEST(download, brings_what_the_vehicle_holds_and_closes_the_transfer) {
  for (auto make : {+[] { return px4_world(); }, +[] { return copter_world(); }}) {
    auto world = make();
    ASSERT_EQ(world.upload(mission_of(30)).verdict, verdict::accepted);
    const auto outcome = world.download();
    EXPECT_EQ(outcome.verdict, verdict::accepted);
    EXPECT_EQ(outcome.items.size(), 30U);
    EXPECT_TRUE(transfer_world::is_same(outcome.items, world.vehicle().plan(mav_mission_type::mission).items));
    EXPECT_EQ(world.ours().progress.back(), (transfer::progress{30, 30}));
    world.run_for(100 * ms);
    EXPECT_TRUE(world.vehicle().is_idle());
  }
}

TEST(download, an_empty_plan_is_closed_as_well) {
  auto world = px4_world();
  const auto outcome = world.download(mav_mission_type::rally);
  EXPECT_EQ(outcome.verdict, verdict::accepted);
  EXPECT_TRUE(outcome.items.empty());
  EXPECT_EQ(outcome.items_on_vehicle, 0);
  world.run_for(100 * ms);
  EXPECT_TRUE(world.vehicle().is_idle()) << "PX4 would be busy for 5 s";
}

TEST(download, tells_the_plan_id) {
  auto world = px4_world();
  ASSERT_EQ(world.upload(mission_of(3)).verdict, verdict::accepted);
  EXPECT_EQ(world.download().plan_id, world.vehicle().plan(mav_mission_type::mission).id);
}

TEST(download, asks_ahead_where_any_item_is_served) {
  auto copter = copter_world();
  ASSERT_EQ(copter.upload(mission_of(100)).verdict, verdict::accepted);
  EXPECT_LT(copter.download().duration_ns, 500 * ms);
  auto px4 = px4_world();
  ASSERT_EQ(px4.upload(mission_of(100)).verdict, verdict::accepted);
  EXPECT_GT(px4.download().duration_ns, 3'000 * ms) << "a round trip for each";
}

TEST(download, a_lost_item_is_asked_for_again_by_itself) {
  auto world = copter_world();
  ASSERT_EQ(world.upload(mission_of(50)).verdict, verdict::accepted);
  world.ours().drops_received = [dropped = false](const mission_server::outgoing& each) mutable {
    const auto* item = std::get_if<mavlink::mission_item_int>(&each);
    if (item == nullptr || item->seq != 7 || dropped)
      return false;
    return dropped = true;
  };
  const auto outcome = world.download();
  EXPECT_EQ(outcome.verdict, verdict::accepted);
  EXPECT_EQ(outcome.effort.requests_sent, 52U) << "the list, 50 items, and one of them again";
}

TEST(download, an_unknown_type_is_refused_in_words) {
  auto world = copter_world();
  const auto outcome = world.download(static_cast<mav_mission_type>(7));
  EXPECT_EQ(outcome.verdict, verdict::refused);
  EXPECT_EQ(outcome.result, mavlink::number(mavlink::mav_mission_result::unsupported));
  EXPECT_NE(outcome.reason, "");
}

TEST(download, a_vehicle_that_is_silent_is_given_its_patience) {
  auto world = px4_world();
  world.ours().line.cut(true);
  const auto outcome = world.download();
  EXPECT_EQ(outcome.verdict, verdict::timed_out);
  EXPECT_EQ(outcome.phase, transfer::phase::listing);
  EXPECT_LE(outcome.duration_ns, 7'000 * ms);
}

TEST(download, waits_for_the_upload_of_another_station) {
  auto world = copter_world();
  auto& other = world.add_station(other_station_id, {});
  const auto theirs = mission_of(100, 3);
  world.begin(other, other.client.upload(mav_mission_type::mission, theirs, world.time().now_ns()));
  world.run_for(50 * ms);
  const auto outcome = world.download();
  EXPECT_EQ(outcome.verdict, verdict::accepted);
  EXPECT_EQ(outcome.items.size(), theirs.size());
}

TEST(download, cancel_ends_it_on_both_sides) {
  auto world = px4_world();
  ASSERT_EQ(world.upload(mission_of(100)).verdict, verdict::accepted);
  world.begin(world.ours(), world.ours().client.download(mav_mission_type::mission, world.time().now_ns()));
  world.run_for(200 * ms);
  world.begin(world.ours(), world.ours().client.cancel(world.time().now_ns()));
  EXPECT_EQ(world.ours().outcomes.back().verdict, verdict::cancelled);
  EXPECT_EQ(world.ours().outcomes.back().holding, transfer::holding::unchanged);
  world.run_for(100 * ms);
  EXPECT_TRUE(world.vehicle().is_idle());
}

} // namespace download_test
} // namespace godwit::tests
