// The flights in which one thing goes wrong in one part: that there are all of them, that each is flown by its name,
// and that they are judged.
#include "programs/godwit-drill/flights/disturbed_flight.hpp"
#include "tests/programs/godwit-drill/flights/every_vehicle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

namespace disturbed_cases_test {

using namespace godwit;
using namespace godwit::drill;

constexpr std::array<std::uint64_t, 4> disk_commits{9, 40, 8, 1};
constexpr std::array<double, 4> flown_s{12, 24, 24, 60};

void expect_cases(const std::vector<flight_case>& all, std::size_t count) {
  EXPECT_EQ(all.size(), count);
  std::set<std::string> names;
  for (const auto& each : all)
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
}

flight_outcome fly(const std::vector<flight_case>& all, const std::string& name, const flight_wishes& wishes = {}) {
  const auto found = std::ranges::find(all, name, &flight_case::name);
  EXPECT_NE(found, all.end()) << name;
  return found == all.end() ? flight_outcome{} : found->fly(wishes);
}

void expect_held(const flight_outcome& outcome) {
  EXPECT_TRUE(outcome.held()) << outcome.name << ": " << outcome.flaws.front() << '\n' << outcome.story;
  EXPECT_EQ(outcome.skipped, "") << outcome.name;
}

bool has_flaw(const flight_outcome& outcome, const std::string& words) {
  return std::ranges::any_of(outcome.flaws,
                             [&](const std::string& flaw) { return flaw.find(words) != std::string::npos; });
}

TEST(link_cases, are_three_cuts_of_three_links_a_restart_and_three_lies_in_each_part_and_bad_lines) {
  expect_cases(link_cases(every_vehicle), 4U * (7 * (3 * 3 + 1 + 3) + 3 * 5));
}

TEST(link_cases, a_flight_survives_the_cut_of_each_link) {
  const auto all = link_cases(every_vehicle);
  for (const auto* name : {"px4/flying/vehicle_cut_10s", "rover/starting/service_cut_60s",
                           "ardupilot/flying/station_cut_60s", "px4/throughout/loss_20_percent/1"})
    expect_held(fly(all, name));
  EXPECT_TRUE(has_flaw(fly(all, "px4/flying/vehicle_cut_10s", {.planted = planted_flaw::lose_report}), "stands where"));
}

TEST(link_cases, an_autopilot_that_starts_again_in_flight_is_left_to_people) {
  const auto outcome = fly(link_cases(every_vehicle), "px4/flying/autopilot_restart");
  expect_held(outcome);
  EXPECT_TRUE(outcome.recovery_ms);
}

TEST(disk_cases, are_seven_faults_at_each_fourth_commit) {
  expect_cases(disk_cases(every_vehicle, disk_commits), 7U * (3 + 10 + 2 + 1));
}

TEST(disk_cases, a_flight_survives_each_fault_of_the_disk) {
  const auto all = disk_cases(every_vehicle, disk_commits);
  for (const auto* fault : {"errors_10s", "takes_nothing_10s", "read_only", "sync_2s", "power_loss"})
    expect_held(fly(all, "px4/" + std::string(fault) + "/commit_37"));
}

TEST(disk_cases, a_flight_whose_journal_is_gone_or_an_older_one_doubles_nothing_at_the_service) {
  for (const auto& each : disk_cases(every_vehicle, disk_commits))
    if (each.name.find("replaced_and_killed/") != std::string::npos ||
        each.name.find("deleted_and_killed/") != std::string::npos) {
      const auto outcome = each.fly({});
      EXPECT_TRUE(outcome.held()) << each.name << ": " << outcome.flaws.front() << '\n' << outcome.story;
      EXPECT_EQ(outcome.doubled, 0U) << each.name;
    }
}

TEST(stored_disk_cases, are_five_faults_at_each_fourth_commit) {
  expect_cases(stored_disk_cases(every_vehicle, disk_commits), 5U * (3 + 10 + 2 + 1));
}

TEST(stored_disk_cases, a_flight_survives_each_fault_below_its_journal) {
  const auto all = stored_disk_cases(every_vehicle, disk_commits);
  for (const auto* fault :
       {"file_write_error_10s", "file_sync_error_10s", "file_full_10s", "file_torn_write", "file_lost_sync"})
    expect_held(fly(all, "px4/" + std::string(fault) + "/commit_37"));
}

// Its journal acknowledges what is not on the disk.
TEST(stored_disk_cases, a_disk_that_lies_about_its_syncs_is_found) {
  flight_simulation flight({.who = sim::personality::px4, .has_stored_journal = true});
  ASSERT_TRUE(flight.run_until_phase(executor::phase::ready, 60)) << flight.story();
  io::sqlite::fault_vfs::instance().set_lying(true);
  ASSERT_TRUE(flight.run_until_phase(executor::phase::flying, 60)) << flight.story();
  flight.run_for(5);
  flight.lose_power(20);
  flight.run_for(25);
  EXPECT_GT(flight.outside().journal.forgotten, 0U) << flight.story();
}

TEST(stored_disk_cases, are_the_same_flight_each_time) {
  const auto all = stored_disk_cases(every_vehicle, disk_commits);
  const auto once = fly(all, "rover/file_torn_write/commit_9", {.tells_story = true});
  const auto again = fly(all, "rover/file_torn_write/commit_9", {.tells_story = true});
  EXPECT_FALSE(once.story.empty());
  EXPECT_EQ(once.story, again.story);
}

TEST(clock_cases, are_six_in_each_part) { expect_cases(clock_cases(every_vehicle), 4U * 7 * 6); }

TEST(clock_cases, a_flight_survives_a_clock_that_is_set_and_a_process_without_a_processor) {
  const auto all = clock_cases(every_vehicle);
  for (const auto* name :
       {"px4/flying/day_ahead", "rover/flying/year_back_between_processes", "ardupilot/flying/suspended_10s"})
    expect_held(fly(all, name));
}

TEST(clock_cases, who_takes_the_vehicle_while_the_process_is_suspended_is_left_alone) {
  const auto all = clock_cases(every_vehicle);
  const auto outcome = fly(all, "px4/flying/taken_while_suspended");
  expect_held(outcome);
  EXPECT_EQ(outcome.takeovers, 1U);
  const auto bad = fly(all, "px4/flying/taken_while_suspended", {.planted = planted_flaw::order_to_person});
  EXPECT_TRUE(has_flaw(bad, "while a person had the vehicle"));
}

TEST(actor_loss_cases, are_each_pair_and_each_actor_given_up_or_hanging_in_each_part) {
  expect_cases(actor_loss_cases(every_vehicle), 4U * 7 * (15 + 6 + 6));
}

TEST(actor_loss_cases, a_flight_survives_two_crashes_at_once_an_actor_that_is_given_up_and_one_that_hangs) {
  const auto all = actor_loss_cases(every_vehicle);
  for (const auto* name : {"px4/flying/executor+ground_port/at_once", "rover/flying/mapobjects_store/given_up",
                           "ardupilot/flying/failsafe/hangs"})
    expect_held(fly(all, name));
}

TEST(kill_cases, are_five_hundred_moments_and_a_storm_in_each_part) {
  expect_cases(kill_cases(every_vehicle, flown_s), 500U + 4 * 7);
}

TEST(kill_cases, a_flight_survives_a_minute_of_kills) {
  const auto outcome = fly(kill_cases(every_vehicle, flown_s), "px4/flying/killed_each_200ms");
  expect_held(outcome);
  EXPECT_GT(outcome.kills, 50U);
}

TEST(takeover_cases, are_each_item_and_in_each_part_under_way_three_takeovers_and_each_pair_of_words) {
  expect_cases(takeover_cases(every_vehicle), (4U + 6 + 6 + 6) + 4 * 3 * (3 + 4 * 3 * 2));
}

TEST(takeover_cases, who_takes_the_vehicle_again_or_from_a_dead_process_is_left_alone) {
  const auto all = takeover_cases(every_vehicle);
  const auto twice = fly(all, "ardupilot/flying/twice");
  expect_held(twice);
  EXPECT_EQ(twice.takeovers, 2U);
  expect_held(fly(all, "px4/flying/while_dead"));
  expect_held(fly(all, "rover/flying/while_off_5s"));
}

TEST(takeover_cases, who_stops_the_vehicle_has_the_last_word) {
  const auto all = takeover_cases(every_vehicle);
  expect_held(fly(all, "px4/flying/resume_and_pause_at_once"));
  expect_held(fly(all, "px4/flying/start_and_come_home_later"));
}

} // namespace disturbed_cases_test
