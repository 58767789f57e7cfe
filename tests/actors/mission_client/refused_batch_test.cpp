// Batches that the service will not have: given back to the map, and taken again in halves until what is wrong stands
// alone.
#include <gtest/gtest.h>

#include "tests/actors/mission_client/client_world.hpp"

namespace refused_batch_test {

using namespace godwit;
using namespace godwit::mission_client;
using namespace godwit::mission_client::test;
using namespace std::chrono_literals;

TEST(mission_client_refused_batch, one_wrong_row_is_found_in_halves_and_the_others_are_delivered) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.store.owe(mission_a, 100);
  around.service.poison = {uuid(37, 'c')};
  p.say(push_map{mission_a});
  p.advance(60s);
  EXPECT_EQ(m.observations.size(), 99U);
  EXPECT_EQ(p.status().orphaned, 1U);
  EXPECT_EQ(p.status().pending, 0U);
  EXPECT_EQ(around.store.owed(), 1U) << "the wrong one, under its own key";
  EXPECT_LE(around.service.count("POST"), 25);
  EXPECT_EQ(around.service.other_bodies, 0);
  EXPECT_EQ(around.listener.resolved.size(), 1U);
}

TEST(mission_client_refused_batch, queued_again_it_goes_out_under_another_key) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.store.owe(mission_a, 3);
  around.service.poison = {uuid(2, 'c')};
  p.say(push_map{mission_a});
  p.advance(60s);
  ASSERT_EQ(p.status().orphaned, 1U);
  around.service.poison.clear(); // the service was mended
  EXPECT_EQ(p.retry().queued, 1U);
  p.advance(10s);
  EXPECT_EQ(m.observations.size(), 3U);
  EXPECT_EQ(around.store.owed(), 0U);
  EXPECT_EQ(p.status().orphaned, 0U);
}

TEST(mission_client_refused_batch, too_large_for_the_service_it_is_halved_until_it_fits) {
  outside around;
  auto& m = around.service.add(sample_mission(mission_a));
  process p(around);
  begin(p, mission_a);
  around.store.owe(mission_a, 40);
  around.service.faults.push_back(
      {.where = "/mapobjects", .what = fault::status_answer, .status = 413, .times = 2, .posts_only = true});
  p.say(push_map{mission_a});
  p.advance(30s);
  EXPECT_EQ(m.observations.size(), 40U);
  EXPECT_EQ(p.status().orphaned, 0U);
}

TEST(mission_client_refused_batch, a_kill_at_any_time_loses_no_row_and_doubles_none) {
  for (int pause_ms = 10; pause_ms <= 600; pause_ms += 10) {
    outside around;
    auto& m = around.service.add(sample_mission(mission_a));
    around.service.poison = {uuid(5, 'c')};
    {
      process p(around);
      begin(p, mission_a);
      around.store.owe(mission_a, 10);
      p.say(push_map{mission_a});
      p.advance(std::chrono::milliseconds(pause_ms));
    } // SIGKILL
    process again(around);
    begin(again, mission_a);
    again.say(push_map{mission_a});
    again.advance(60s);
    EXPECT_EQ(m.observations.size(), 9U) << pause_ms;
    EXPECT_EQ(around.store.owed(), 1U) << pause_ms;
    EXPECT_EQ(around.service.other_bodies, 0) << pause_ms;
  }
}

} // namespace refused_batch_test
