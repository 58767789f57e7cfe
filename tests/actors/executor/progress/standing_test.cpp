#include "actors/executor/progress/standing.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/progress/desk.hpp"

namespace godwit::executor::progress {
namespace {

using namespace test;

followed_plan plan_of(const flavour& vehicle, std::optional<std::uint32_t> id) {
  return {.map = map_of(vehicle, {"A", "B"}),
          .vehicle_plan_id = id,
          .id_before = 100U,
          .last_reached = {},
          .generation = {}};
}

TEST(standing, with_plan_ids_the_id_decides) {
  const auto plan = plan_of(px4, 101);
  EXPECT_EQ(standing_of({.total = 2, .mission_id = 101}, plan), standing::ours);
  EXPECT_EQ(standing_of({.total = 2, .mission_id = 100}, plan), standing::other);
  EXPECT_EQ(standing_of({.total = 2, .mission_id = 7}, plan), standing::other);
}

TEST(standing, a_message_without_its_id_does_not_say_whose_it_is) {
  EXPECT_EQ(standing_of({.total = 2}, plan_of(px4, 101)), standing::not_told);
}

TEST(standing, without_plan_ids_the_number_of_items_decides) {
  const auto plan = plan_of(ardupilot, {});
  EXPECT_EQ(standing_of({.total = 2}, plan), standing::ours);
  EXPECT_EQ(standing_of({.total = 3}, plan), standing::other);
  EXPECT_EQ(standing_of({.total = 0}, plan), standing::ours); // does not tell it
}

TEST(standing, no_plan_at_all_is_another_one) {
  EXPECT_EQ(standing_of({.total = 65535}, plan_of(px4, 101)), standing::other);
  EXPECT_EQ(standing_of({.total = 0, .mission_state = 1}, plan_of(ardupilot, {})), standing::other);
}

TEST(standing, an_id_that_was_not_learned_is_any_but_the_one_before) {
  const auto plan = plan_of(px4, {});
  EXPECT_EQ(standing_of({.total = 2, .mission_id = 100}, plan), standing::other);
  EXPECT_EQ(standing_of({.total = 2, .mission_id = 55}, plan), standing::ours);
  EXPECT_EQ(standing_of({.total = 9, .mission_id = 55}, plan), standing::other);
}

TEST(standing, during_an_upload_any_other_id_may_be_the_new_one) {
  pending_upload upload;
  upload.intent.id_before = 100;
  EXPECT_TRUE(may_be_uploaded({.mission_id = 7}, upload));
  EXPECT_FALSE(may_be_uploaded({.mission_id = 100}, upload));
  EXPECT_FALSE(may_be_uploaded({.mission_id = 0}, upload));
}

} // namespace
} // namespace godwit::executor::progress
