#include "actors/mapobjects_store/map_health.hpp"

#include <gtest/gtest.h>

namespace godwit::mapobjects_store {
namespace map_health_test {

map_status with(sync_state sync) {
  map_status known;
  known.sync = sync;
  return known;
}

TEST(map_health, a_disk_that_refuses_is_bad_whatever_the_map_is_like) {
  map_writer_status writer;
  writer.failing = true;
  writer.reason = "the disk is full";
  EXPECT_EQ(health_of(writer, with(sync_state::synced)),
            (godwit::runtime::condition{godwit::runtime::health_colour::red, "the disk is full"}));
}

TEST(map_health, a_map_that_can_not_be_opened_is_bad_and_one_that_is_not_open_yet_impaired) {
  EXPECT_EQ(health_of(tl::unexpected(map_error{map_errc::corrupt, "damaged", {}}), std::nullopt).how,
            godwit::runtime::health_colour::red);
  EXPECT_EQ(health_of(tl::unexpected(map_error{map_errc::full, "not yet", {}}), std::nullopt).how,
            godwit::runtime::health_colour::yellow);
}

TEST(map_health, an_old_map_is_impaired_and_none_at_all_is_the_business_of_preflight) {
  for (const auto sync : {sync_state::degraded, sync_state::failed, sync_state::cached_fallback})
    EXPECT_EQ(health_of(map_writer_status{}, with(sync)).how, godwit::runtime::health_colour::yellow);
  for (const auto sync : {sync_state::synced, sync_state::fresh_boot})
    EXPECT_EQ(health_of(map_writer_status{}, with(sync)).how, godwit::runtime::health_colour::green);
}

TEST(map_health, what_is_owed_is_said_and_orphans_impair) {
  auto known = with(sync_state::synced);
  known.pending = 3;
  known.taken = 2;
  EXPECT_EQ(health_of(map_writer_status{}, known),
            (godwit::runtime::condition{godwit::runtime::health_colour::green, "map: synced; 5 rows to deliver"}));
  known.orphaned = 1;
  EXPECT_EQ(health_of(map_writer_status{}, known).how, godwit::runtime::health_colour::yellow);
}

} // namespace map_health_test
} // namespace godwit::mapobjects_store
