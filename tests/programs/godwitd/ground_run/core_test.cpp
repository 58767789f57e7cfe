#include "programs/godwitd/ground_run/core.hpp"

#include <gtest/gtest.h>

namespace ground_run_core_test {

using namespace godwit;
using namespace godwit::ground_run;
using mission_client::pull_state;

const std::string id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";

template <class Step>
const Step* find(const steps& all) {
  for (const auto& each : all)
    if (const auto* found = std::get_if<Step>(&each))
      return found;
  return nullptr;
}

mission_client::mission_loaded loaded(const std::string& mission_id = id) {
  mission_client::mission_loaded result;
  result.document.mission_id = mission_id;
  return result;
}

mission_client::map_pulled pulled(pull_state state = pull_state::synced) { return {id, state, 3, 1, "no network"}; }

mapobjects_store::owed_list owed(std::uint64_t pending, const std::string& mission_id = id) {
  mapobjects_store::owed_list result;
  result.missions.push_back({mission_id, mapobjects_store::destination::observations, pending, 0, 0});
  return result;
}

mission_client::service_status status(pull_state pull, std::int32_t revision = 2) {
  mission_client::service_status result;
  result.mission_id = id;
  result.revision = revision;
  result.pull = pull;
  return result;
}

core seeing(settings wanted) {
  core result(std::move(wanted));
  (void)result.on_start();
  (void)result.on_loaded(loaded());
  (void)result.on_pulled(pulled(), 1.0);
  return result;
}

const settings once{id, true, true, true};
const settings forever{id, true, true, false};

TEST(ground_run_core, a_run_is_load_pull_see_push_and_the_end) {
  core run(once);
  EXPECT_NE(find<begin_fetch>(run.on_start()), nullptr);
  EXPECT_NE(find<announce>(run.on_loaded(loaded())), nullptr);
  EXPECT_NE(find<see>(run.on_pulled(pulled(), 1.0)), nullptr);
  EXPECT_NE(find<push>(run.on_sightings_over({7, 0, 0})), nullptr);
  EXPECT_NE(find<count_owed>(run.on_resolved({id, 0, 0})), nullptr);
  const auto last = run.on_owed(owed(0));
  ASSERT_NE(find<finish>(last), nullptr);
  EXPECT_TRUE(find<finish>(last)->well);
}

TEST(ground_run_core, after_a_restart_it_goes_on_from_what_mission_client_knows) {
  core run(once);
  (void)run.on_start();
  EXPECT_EQ(find<see>(run.on_status(status(pull_state::not_started, 0))), nullptr);
  EXPECT_EQ(find<see>(run.on_status(status(pull_state::in_flight))), nullptr);
  EXPECT_EQ(run.now(), phase::pulling);
  EXPECT_NE(find<see>(run.on_status(status(pull_state::synced))), nullptr);
  EXPECT_TRUE(run.on_status(status(pull_state::synced)).empty());
}

TEST(ground_run_core, the_word_of_an_earlier_run_does_not_end_this_one) {
  core run(once);
  (void)run.on_start();
  EXPECT_TRUE(run.on_resolved({id, 0, 0}).empty());
  run = seeing(once);
  EXPECT_TRUE(run.on_resolved({id, 0, 0}).empty());
  (void)run.on_sightings_over({1, 0, 0});
  EXPECT_TRUE(run.on_resolved({"another", 0, 0}).empty());
  EXPECT_EQ(run.now(), phase::pushing);
}

TEST(ground_run_core, while_the_store_owes_anything_for_the_mission_it_is_pushed_again) {
  auto run = seeing(once);
  (void)run.on_sightings_over({1, 0, 0});
  (void)run.on_resolved({id, 0, 0});
  const auto again = run.on_owed(owed(1));
  EXPECT_NE(find<push>(again), nullptr);
  EXPECT_EQ(find<finish>(again), nullptr);
  (void)run.on_resolved({id, 0, 0});
  EXPECT_NE(find<finish>(run.on_owed(owed(5, "another"))), nullptr);
}

TEST(ground_run_core, what_is_orphaned_or_expired_is_no_good_end) {
  auto run = seeing(once);
  (void)run.on_sightings_over({1, 0, 0});
  (void)run.on_resolved({id, 1, 2});
  const auto last = run.on_owed(owed(0));
  ASSERT_NE(find<finish>(last), nullptr);
  EXPECT_FALSE(find<finish>(last)->well);
  EXPECT_NE(find<finish>(last)->why.find("outbox-retry"), std::string::npos);
}

TEST(ground_run_core, what_a_push_does_not_move_is_not_pushed_for_ever) {
  auto run = seeing(once);
  (void)run.on_sightings_over({1, 0, 0});
  (void)run.on_resolved({id, 0, 0});
  EXPECT_NE(find<push>(run.on_owed(owed(3))), nullptr);
  (void)run.on_resolved({id, 0, 0});
  const auto last = run.on_owed(owed(3));
  EXPECT_EQ(find<push>(last), nullptr);
  ASSERT_NE(find<finish>(last), nullptr);
  EXPECT_FALSE(find<finish>(last)->well);
}

TEST(ground_run_core, what_the_map_keeps_as_orphaned_is_no_good_end_either) {
  auto run = seeing(once);
  (void)run.on_sightings_over({1, 0, 0});
  (void)run.on_resolved({id, 0, 0});
  auto left = owed(0);
  left.missions.front().orphaned = 3;
  const auto last = run.on_owed(left);
  ASSERT_NE(find<finish>(last), nullptr);
  EXPECT_FALSE(find<finish>(last)->well);
}

TEST(ground_run_core, a_sighting_that_was_not_taken_is_no_good_end) {
  for (const sighting_counts& counts : {sighting_counts{5, 1, 0}, sighting_counts{5, 0, 1}}) {
    auto run = seeing(once);
    (void)run.on_sightings_over(counts);
    (void)run.on_resolved({id, 0, 0});
    EXPECT_FALSE(find<finish>(run.on_owed(owed(0)))->well);
  }
}

TEST(ground_run_core, without_once_it_stays_when_all_is_delivered) {
  auto run = seeing(forever);
  (void)run.on_sightings_over({1, 0, 0});
  (void)run.on_resolved({id, 0, 0});
  EXPECT_EQ(find<finish>(run.on_owed(owed(0))), nullptr);
  EXPECT_EQ(run.now(), phase::over);
}

mission_client::service_status failing(const std::string& why, bool may_deliver = true) {
  auto result = status(pull_state::synced);
  result.delivery_error = why;
  result.may_deliver = may_deliver;
  return result;
}

TEST(ground_run_core, while_it_pushes_each_error_of_a_delivery_is_said_once) {
  auto run = seeing(forever);
  EXPECT_TRUE(run.on_status(failing("503")).empty()); // nothing is pushed yet
  (void)run.on_sightings_over({1, 0, 0});
  EXPECT_TRUE(run.on_status(failing("")).empty());
  const auto first = run.on_status(failing("503"));
  ASSERT_NE(find<announce>(first), nullptr);
  EXPECT_TRUE(find<announce>(first)->is_warning);
  EXPECT_NE(find<announce>(first)->sentence.find("503"), std::string::npos);
  EXPECT_NE(find<announce>(run.on_status(failing("no network"))), nullptr);
  EXPECT_TRUE(run.on_status(failing("503")).empty());
}

TEST(ground_run_core, of_the_errors_that_were_said_the_newest_are_remembered) {
  auto run = seeing(forever);
  (void)run.on_sightings_over({1, 0, 0});
  for (std::size_t i = 0; i <= max_told_errors; ++i)
    EXPECT_FALSE(run.on_status(failing("error " + std::to_string(i))).empty());
  EXPECT_TRUE(run.on_status(failing("error " + std::to_string(max_told_errors))).empty());
  EXPECT_FALSE(run.on_status(failing("error 0")).empty());
}

TEST(ground_run_core, a_delivery_that_is_not_allowed_ends_a_run_that_is_to_end_and_is_said_by_one_that_stays) {
  auto run = seeing(once);
  (void)run.on_sightings_over({1, 0, 0});
  const auto last = run.on_status(failing("401", false));
  ASSERT_NE(find<finish>(last), nullptr);
  EXPECT_FALSE(find<finish>(last)->well);
  EXPECT_NE(find<finish>(last)->why.find("401"), std::string::npos);
  EXPECT_NE(find<finish>(last)->why.find("token"), std::string::npos);
  run = seeing(forever);
  (void)run.on_sightings_over({1, 0, 0});
  const auto news = run.on_status(failing("401", false));
  EXPECT_EQ(find<finish>(news), nullptr);
  EXPECT_NE(find<announce>(news), nullptr);
  EXPECT_EQ(run.now(), phase::pushing);
}

TEST(ground_run_core, a_refused_mission_ends_a_run_that_is_to_end) {
  core run(once);
  (void)run.on_start();
  const auto last = run.on_refused({id, mission_client::refusal::not_allowed, "401", ""});
  ASSERT_NE(find<finish>(last), nullptr);
  EXPECT_FALSE(find<finish>(last)->well);
  EXPECT_NE(find<finish>(last)->why.find("token"), std::string::npos);
}

TEST(ground_run_core, a_daemon_that_stays_asks_an_unreachable_service_again_and_no_other) {
  core run(forever);
  (void)run.on_start();
  EXPECT_NE(find<begin_later>(run.on_refused({id, mission_client::refusal::unreachable, "no network", ""})), nullptr);
  EXPECT_NE(find<begin_fetch>(run.on_retry()), nullptr);
  EXPECT_EQ(find<begin_later>(run.on_refused({id, mission_client::refusal::invalid, "no items", ""})), nullptr);
}

TEST(ground_run_core, a_map_that_could_not_be_pulled_is_said_and_sightings_are_taken_all_the_same) {
  for (const auto state : {pull_state::failed, pull_state::cached_fallback}) {
    core run(once);
    (void)run.on_start();
    (void)run.on_loaded(loaded());
    const auto next = run.on_pulled(pulled(state), 1.0);
    ASSERT_NE(find<announce>(next), nullptr);
    EXPECT_TRUE(find<announce>(next)->is_warning);
    EXPECT_NE(find<see>(next), nullptr);
  }
}

TEST(ground_run_core, without_sightings_a_run_that_is_to_end_delivers_what_was_left) {
  core run({id, true, false, true});
  (void)run.on_start();
  (void)run.on_loaded(loaded());
  EXPECT_NE(find<push>(run.on_pulled(pulled(), 1.0)), nullptr);
}

TEST(ground_run_core, without_a_service_sightings_go_onto_the_map_and_nowhere_else) {
  core run({id, false, true, true});
  EXPECT_NE(find<choose>(run.on_start()), nullptr);
  EXPECT_NE(find<see>(run.on_chosen()), nullptr);
  const auto last = run.on_sightings_over({3, 0, 0});
  EXPECT_EQ(find<push>(last), nullptr);
  ASSERT_NE(find<finish>(last), nullptr);
  EXPECT_TRUE(find<finish>(last)->well);
}

TEST(ground_run_core, a_map_that_is_broken_ends_the_run) {
  auto run = seeing(forever);
  const auto last = run.on_map_broken("the disk");
  ASSERT_NE(find<finish>(last), nullptr);
  EXPECT_FALSE(find<finish>(last)->well);
  EXPECT_TRUE(run.on_map_broken("the disk").empty());
}

} // namespace ground_run_core_test
