#include "actors/mission_client/changes.hpp"

#include <gtest/gtest.h>

#include "actors/domain/mission/write.hpp"
#include "actors/mission_client/retry_policy.hpp"

namespace changes_test {

using namespace godwit;
using namespace godwit::mission_client;

const std::string mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";

outbox_row row(std::uint32_t tries = 0) {
  outbox_row result;
  result.key = "k";
  result.to = destination::waypoint;
  result.mission_id = mission_id;
  result.tries = tries;
  return result;
}

change_verdict verdict_of(const event& what) { return std::get<change_failed>(what).verdict; }

TEST(mission_client_changes, the_mission_in_the_answer_is_the_new_one) {
  mission::document document;
  document.mission_id = mission_id;
  document.revision = 3;
  document.items.emplace_back(mission::return_home{"home"});
  document.return_point = mission::position{47.4, 8.5, 0};
  const service_answer answer{.status = 200, .body = mission::to_text(document)};
  EXPECT_EQ(std::get<change_done>(outcome_of_change(row(), answer, 0)).document.revision, 3);
  document.mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a43";
  const service_answer other{.status = 200, .body = mission::to_text(document)};
  EXPECT_EQ(verdict_of(outcome_of_change(row(), other, 0)), change_verdict::unknown);
}

TEST(mission_client_changes, a_failure_is_tried_again_while_tries_and_time_are_left) {
  const service_answer answer{.status = 503};
  EXPECT_TRUE(std::holds_alternative<rows_failed>(outcome_of_change(row(0), answer, 0)));
  EXPECT_TRUE(std::holds_alternative<rows_failed>(outcome_of_change(row(1), answer, 0)));
  EXPECT_EQ(verdict_of(outcome_of_change(row(2), answer, 0)), change_verdict::unknown);
  EXPECT_EQ(verdict_of(outcome_of_change(row(0), answer, change_window_ns - 1)), change_verdict::unknown);
}

TEST(mission_client_changes, a_first_try_that_was_kept_out_for_too_long_has_changed_nothing) {
  const service_answer answer{.status = 429, .retry_after_ns = 60 * second_ns};
  EXPECT_EQ(verdict_of(outcome_of_change(row(0), answer, 0)), change_verdict::refused);
  EXPECT_EQ(verdict_of(outcome_of_change(row(1), answer, 0)), change_verdict::unknown);
}

TEST(mission_client_changes, a_conflict_is_stale_and_what_is_wrong_is_refused) {
  EXPECT_EQ(verdict_of(outcome_of_change(row(), {.status = 409}, 0)), change_verdict::stale);
  EXPECT_EQ(verdict_of(outcome_of_change(row(), {.status = 422}, 0)), change_verdict::refused);
  EXPECT_EQ(verdict_of(outcome_of_change(row(), {.status = 401}, 0)), change_verdict::refused);
  EXPECT_EQ(verdict_of(outcome_of_change(row(), {.how = ending::bad_answer}, 0)), change_verdict::unknown);
  EXPECT_TRUE(std::holds_alternative<mission_gone>(outcome_of_change(row(), {.status = 410}, 0)));
}

} // namespace changes_test
