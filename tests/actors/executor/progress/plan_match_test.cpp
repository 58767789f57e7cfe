#include "actors/executor/progress/plan_match.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/progress/progress_fixture.hpp"

namespace godwit::executor::progress {
namespace plan_match_test {

using namespace test;

followed_plan plan_of(const flavour& vehicle, std::optional<std::uint32_t> id) {
  return {.map = map_of(vehicle, {"A", "B"}),
          .vehicle_plan_id = id,
          .id_before = 100U,
          .last_reached = {},
          .generation = {}};
}

TEST(plan_match, with_plan_ids_the_id_decides) {
  const auto plan = plan_of(px4, 101);
  EXPECT_EQ(match_of({.total = 2, .mission_id = 101}, plan), plan_match::ours);
  EXPECT_EQ(match_of({.total = 2, .mission_id = 100}, plan), plan_match::other);
  EXPECT_EQ(match_of({.total = 2, .mission_id = 7}, plan), plan_match::other);
}

TEST(plan_match, a_message_without_its_id_does_not_say_whose_it_is) {
  EXPECT_EQ(match_of({.total = 2}, plan_of(px4, 101)), plan_match::not_told);
}

TEST(plan_match, without_plan_ids_the_number_of_items_decides) {
  const auto plan = plan_of(ardupilot, {});
  EXPECT_EQ(match_of({.total = 2}, plan), plan_match::ours);
  EXPECT_EQ(match_of({.total = 3}, plan), plan_match::other);
  EXPECT_EQ(match_of({.total = 0}, plan), plan_match::ours); // does not tell it
}

TEST(plan_match, no_plan_at_all_is_another_one) {
  EXPECT_EQ(match_of({.total = 65535}, plan_of(px4, 101)), plan_match::other);
  EXPECT_EQ(match_of({.total = 0, .mission_state = 1}, plan_of(ardupilot, {})), plan_match::other);
}

TEST(plan_match, an_id_that_was_not_learned_is_any_but_the_one_before) {
  const auto plan = plan_of(px4, {});
  EXPECT_EQ(match_of({.total = 2, .mission_id = 100}, plan), plan_match::other);
  EXPECT_EQ(match_of({.total = 2, .mission_id = 55}, plan), plan_match::ours);
  EXPECT_EQ(match_of({.total = 9, .mission_id = 55}, plan), plan_match::other);
}

TEST(plan_match, during_an_upload_any_other_id_may_be_the_new_one) {
  pending_upload upload;
  upload.intent.id_before = 100;
  EXPECT_TRUE(may_be_uploaded({.mission_id = 7}, upload));
  EXPECT_FALSE(may_be_uploaded({.mission_id = 100}, upload));
  EXPECT_FALSE(may_be_uploaded({.mission_id = 0}, upload));
}

} // namespace plan_match_test
} // namespace godwit::executor::progress
