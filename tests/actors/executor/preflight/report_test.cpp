#include "actors/executor/preflight/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace report_test {

using namespace test;

TEST(preflight_report, it_has_each_check_in_the_order_of_the_table_and_the_mission_that_it_is_about) {
  const auto made = run_checks(good_facts(), {});
  EXPECT_TRUE(std::ranges::equal(made.findings, checks, {}, &finding::check, &check::name));
  EXPECT_EQ(made.mission_id, small_mission().mission_id);
  EXPECT_EQ(made.revision, 4);
  EXPECT_EQ(made.id, 0U) << "nothing is to be acknowledged";
  EXPECT_EQ(made.overall, verdict::pass);
}

TEST(preflight_report, without_a_mission_it_is_about_none) {
  const auto made = run_checks({}, {});
  EXPECT_EQ(made.mission_id, "");
  EXPECT_EQ(made.revision, 0);
  EXPECT_EQ(made.overall, verdict::fail);
}

TEST(preflight_report, the_worst_counts) {
  auto seen = good_facts();
  seen.camera.state = camera_state::not_ready;
  EXPECT_EQ(run_checks(seen, {}).overall, verdict::degraded);
  seen.vehicle.is_home_known = false;
  EXPECT_EQ(run_checks(seen, {}).overall, verdict::fail);
}

TEST(preflight_report, what_is_skipped_is_no_worse_than_what_passes) {
  EXPECT_EQ(worst_of({{"a", verdict::skipped, ""}, {"b", verdict::pass, ""}}), verdict::pass);
}

TEST(preflight_report, of_nothing_is_no_pass) {
  EXPECT_EQ(worst_of({}), verdict::fail);
  EXPECT_EQ(report{}.overall, verdict::fail);
}

TEST(preflight_report, a_vehicle_that_is_not_heard_fails_it_though_what_depends_on_it_is_skipped) {
  auto seen = good_facts();
  seen.vehicle.link = vehicle_link::connection_phase::lost;
  const auto made = run_checks(seen, {});
  EXPECT_EQ(made.overall, verdict::fail);
  EXPECT_EQ(sentences_of(made, verdict::fail).size(), 1U);
}

TEST(preflight_report, sentences_are_picked_by_verdict_in_their_order) {
  const report made{
      0, "", 0, verdict::fail, {{"a", verdict::fail, "1"}, {"b", verdict::pass, "2"}, {"c", verdict::fail, "3"}}};
  EXPECT_EQ(sentences_of(made, verdict::fail), (std::vector<std::string>{"1", "3"}));
}

} // namespace report_test
} // namespace godwit::executor::preflight
