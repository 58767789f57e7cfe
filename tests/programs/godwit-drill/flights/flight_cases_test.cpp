// The enumerated flights: that there are all of them, that each is flown again by its name, and that they are judged.
#include "programs/godwit-drill/flights/flight_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "programs/godwit-drill/flights/flight_drill.hpp"
#include "programs/godwit-drill/flights/random_flight.hpp"
#include "tests/programs/godwit-drill/flights/every_vehicle.hpp"

namespace flight_cases_test {

using namespace godwit;
using namespace godwit::drill;

const flight_case& named(const std::vector<flight_case>& all, const std::string& name) {
  const auto found = std::ranges::find(all, name, &flight_case::name);
  EXPECT_NE(found, all.end()) << name;
  return *found;
}

void expect_unique_names(const std::vector<flight_case>& all) {
  std::set<std::string> names;
  for (const auto& each : all)
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
}

TEST(actor_cases, are_each_actor_at_each_point_in_each_part_of_a_flight_of_each_vehicle) {
  const auto all = actor_cases(every_vehicle);
  EXPECT_EQ(all.size(), 4U * 7 * 6 * 4);
  expect_unique_names(all);
}

TEST(actor_cases, a_crash_in_flight_is_recovered_from_and_loses_nothing) {
  const auto all = actor_cases(every_vehicle);
  const auto outcome = named(all, "px4/flying/executor/after_handler").fly({});
  EXPECT_TRUE(outcome.held()) << outcome.flaws.front() << '\n' << outcome.story;
  EXPECT_EQ(outcome.crashes, 1U);
  EXPECT_EQ(outcome.skipped, "");
  ASSERT_TRUE(outcome.recovery_ms);
  EXPECT_LT(*outcome.recovery_ms, 1'000);
}

TEST(actor_cases, find_a_report_that_is_lost) {
  const auto all = actor_cases(every_vehicle);
  const auto outcome =
      named(all, "rover/flying/mission_client/after_handler").fly({.planted = planted_flaw::lose_report});
  EXPECT_FALSE(outcome.held());
  EXPECT_GT(outcome.lost, 0U);
  EXPECT_FALSE(outcome.story.empty());
}

TEST(scan_cases, are_each_way_to_lose_the_scan_controller_in_a_survey_of_each_vehicle_that_flies_one) {
  const auto all = scan_cases(every_vehicle);
  EXPECT_EQ(all.size(), 3U * 7);
  expect_unique_names(all);
}

TEST(scan_cases, show_each_point_once_and_lose_no_decision_whoever_crashes) {
  const auto all = scan_cases(every_vehicle);
  for (const auto* name : {"px4/survey/scan_controller/after_commit", "rover/survey/scan_controller/ends+executor",
                           "ardupilot/survey/scan_controller/ends+process"}) {
    const auto outcome = named(all, name).fly({});
    EXPECT_TRUE(outcome.held()) << outcome.flaws.front() << '\n' << outcome.story;
    EXPECT_EQ(outcome.skipped, "") << name;
    EXPECT_GT(outcome.crashes + outcome.kills, 4U) << name;
  }
}

TEST(process_cases, are_both_sides_of_each_commit) {
  constexpr std::array<std::uint64_t, 4> commits{3, 5, 0, 2};
  const auto all = process_cases(every_vehicle, commits);
  EXPECT_EQ(all.size(), 2U * (3 + 5 + 0 + 2));
  expect_unique_names(all);
}

TEST(process_cases, a_kill_in_flight_is_recovered_from_and_loses_nothing) {
  constexpr std::array<std::uint64_t, 4> commits{0, 40, 0, 0};
  const auto all = process_cases(every_vehicle, commits);
  const auto outcome = named(all, "px4/commit_40/after").fly({});
  EXPECT_TRUE(outcome.held()) << outcome.flaws.front() << '\n' << outcome.story;
  EXPECT_EQ(outcome.kills, 1U);
  ASSERT_TRUE(outcome.recovery_ms);
  EXPECT_GE(*outcome.recovery_ms, 300) << "the next process begins no earlier";
  EXPECT_FALSE(named(all, "px4/commit_40/after").fly({.planted = planted_flaw::double_report}).held());
}

TEST(people_cases, are_each_mode_but_the_missions_in_each_part_of_a_flight) {
  const auto all = people_cases(every_vehicle);
  EXPECT_EQ(all.size(), 5U * (3 + 8 + 8 + 14));
  expect_unique_names(all);
}

TEST(people_cases, a_person_who_takes_the_vehicle_is_left_alone_and_an_order_after_them_is_found) {
  const auto all = people_cases(every_vehicle);
  const auto& taken = named(all, "ardupilot/flying/STABILIZE");
  const auto outcome = taken.fly({});
  EXPECT_TRUE(outcome.held()) << outcome.flaws.front() << '\n' << outcome.story;
  EXPECT_EQ(outcome.takeovers, 1U);
  const auto bad = taken.fly({.planted = planted_flaw::order_to_person});
  ASSERT_FALSE(bad.held());
  EXPECT_NE(bad.flaws.front().find("while a person had the vehicle"), std::string::npos) << bad.flaws.front();
}

// Nothing took time there, and the plan was read again and again.
TEST(random_flight, a_sign_of_another_plan_in_the_instant_of_a_proof_does_not_stop_the_world) {
  const auto outcome = fly_random(3007472, {}, {}, {});
  EXPECT_TRUE(outcome.held()) << outcome.flaws.front() << '\n' << outcome.story;
}

TEST(seed_range, is_one_seed_or_the_first_and_the_last) {
  ASSERT_TRUE(seed_range_from("7"));
  EXPECT_EQ(seed_range_from("7")->last, 7U);
  ASSERT_TRUE(seed_range_from("3..12"));
  EXPECT_EQ(seed_range_from("3..12")->first, 3U);
  EXPECT_EQ(seed_range_from("3..12")->last, 12U);
  for (const auto* wrong : {"", "..", "3..", "..4", "5..4", "a", "1..2..3", "-1", "1.5", "0..18446744073709551615"})
    EXPECT_FALSE(seed_range_from(wrong)) << wrong;
}

TEST(shard, is_a_number_of_so_many) {
  ASSERT_TRUE(shard_from("3/8"));
  EXPECT_EQ(shard_from("3/8")->number, 3U);
  EXPECT_EQ(shard_from("3/8")->of, 8U);
  for (const auto* wrong : {"", "/", "3", "0/8", "9/8", "1/0", "-1/8", "1/8/2", "a/b"})
    EXPECT_FALSE(shard_from(wrong)) << wrong;
}

TEST(shard, together_they_fly_each_seed_once) {
  for (const std::uint64_t of : {1U, 3U, 7U, 12U}) {
    std::uint64_t next = 5;
    for (std::uint64_t number = 1; number <= of; ++number) {
      const auto part = part_of({5, 14}, {number, of});
      if (number > 10) {
        EXPECT_FALSE(part) << number << '/' << of;
        continue;
      }
      ASSERT_TRUE(part) << number << '/' << of;
      EXPECT_EQ(part->first, next);
      EXPECT_LE(part->last - part->first, 10 / of);
      next = part->last + 1;
    }
    EXPECT_EQ(next, 15U) << of;
  }
}

} // namespace flight_cases_test
