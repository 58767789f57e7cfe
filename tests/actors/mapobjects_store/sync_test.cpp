#include "actors/mapobjects_store/sync.hpp"

#include <gtest/gtest.h>

namespace godwit::mapobjects_store {
namespace sync_test {

constexpr sync_state all_states[] = {sync_state::fresh_boot, sync_state::synced, sync_state::cached_fallback,
                                     sync_state::degraded, sync_state::failed};

TEST(sync, a_finished_pull_makes_every_state_synced) {
  for (const auto now : all_states)
    EXPECT_EQ(next_state(now, sync_event::pull_finished, true), sync_state::synced);
}

TEST(sync, a_failed_pull_degrades_what_has_a_copy_and_fails_what_has_none) {
  for (const auto now : all_states) {
    EXPECT_EQ(next_state(now, sync_event::pull_failed, true), sync_state::degraded);
    EXPECT_EQ(next_state(now, sync_event::pull_failed, false), sync_state::failed);
  }
}

TEST(sync, only_a_degraded_map_can_be_acknowledged) {
  for (const auto now : all_states)
    EXPECT_EQ(next_state(now, sync_event::fallback_acknowledged, true),
              now == sync_state::degraded ? sync_state::cached_fallback : now);
}

TEST(sync, another_mission_or_a_deleted_one_begins_anew) {
  for (const auto now : all_states) {
    EXPECT_EQ(next_state(now, sync_event::mission_chosen, true), sync_state::fresh_boot);
    EXPECT_EQ(next_state(now, sync_event::mission_deleted, true), sync_state::fresh_boot);
  }
}

TEST(sync, differences_are_findings_only_on_a_map_that_somebody_vouches_for) {
  for (const auto now : all_states)
    EXPECT_EQ(shows_findings(now), now == sync_state::synced || now == sync_state::cached_fallback);
}

} // namespace sync_test
} // namespace godwit::mapobjects_store
