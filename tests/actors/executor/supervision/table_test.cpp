#include "actors/executor/supervision/table.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "actors/executor/supervision/state.hpp"

namespace table_test {

using namespace godwit::executor::supervision;
using godwit::runtime::child_entry;
using godwit::runtime::process_end;
using godwit::runtime::restart_policy;

const std::vector<std::string> all{"vehicle_link",    "failsafe",       "mapobjects_store", "mission_client",
                                   "executor",        "ground_port",    "landing_watch",    "sightings",
                                   "control_handler", "operator_bridge"};
constexpr part parts[] = {part::ground, part::flight, part::after};

std::map<std::string, child_entry> by_name(part now, const circumstances& process = {}, bool scans = false) {
  std::map<std::string, child_entry> result;
  for (const auto& each : table_of(now, process, all, scans))
    result[each.name] = each;
  return result;
}

TEST(supervision_table, names_each_child_of_the_process_and_no_other) {
  const auto table = table_of(part::ground, {}, {"executor", "failsafe"}, false);
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(table[0].name, "executor");
  EXPECT_EQ(table[1].name, "failsafe");
}

TEST(supervision_table, what_flies_is_wanted_and_essential_in_each_part) {
  for (const auto now : parts)
    for (const auto* child : {"vehicle_link", "failsafe", "executor"}) {
      EXPECT_TRUE(by_name(now).at(child).wanted) << child;
      EXPECT_TRUE(by_name(now).at(child).policy.essential) << child;
    }
}

// As for what flies, and by the same table: what it runs with is there, and nobody asks for the rest.
TEST(supervision_table, a_run_on_the_ground_needs_itself_and_its_vehicle) {
  const std::vector<std::string> run{"vehicle_link", "mapobjects_store", "mission_client", "ground_run",
                                     "control_handler"};
  for (const auto& each : table_of(part::ground, {}, run, false)) {
    EXPECT_TRUE(each.wanted) << each.name;
    EXPECT_EQ(each.policy.essential, each.name == "ground_run" || each.name == "vehicle_link") << each.name;
  }
}

TEST(supervision_table, a_child_is_added_with_what_the_table_says_on_the_ground) {
  for (const auto& [which, text] : godwit::io::enum_table<child_name>) {
    const auto entry = table_of(part::ground, {}, {std::string(text)}, false).front();
    EXPECT_EQ(policy_of(which).essential, entry.policy.essential) << text;
    EXPECT_EQ(policy_of(which).restart.intensity, entry.policy.restart.intensity) << text;
    EXPECT_EQ(policy_of(which).end, entry.policy.end) << text;
  }
}

TEST(supervision_table, only_who_shows_something_is_dispensable) {
  const std::set<std::string> shows{"health", "telemetry_stream", "fleet_link", "view_handler", "mission_handler"};
  for (const auto& [which, text] : godwit::io::enum_table<child_name>)
    EXPECT_EQ(is_dispensable(text), shows.contains(std::string(text))) << text;
}

TEST(supervision_table, the_mission_client_is_essential_only_while_it_delivers_after_a_flight) {
  EXPECT_FALSE(by_name(part::ground).at("mission_client").policy.essential);
  EXPECT_FALSE(by_name(part::flight).at("mission_client").policy.essential);
  EXPECT_TRUE(by_name(part::after).at("mission_client").policy.essential);
}

TEST(supervision_table, no_other_child_is_worth_the_process) {
  for (const auto now : parts)
    for (const auto* child :
         {"mapobjects_store", "ground_port", "landing_watch", "sightings", "control_handler", "operator_bridge"}) {
      EXPECT_TRUE(by_name(now).at(child).wanted) << child;
      EXPECT_FALSE(by_name(now).at(child).policy.essential) << child;
    }
}

TEST(supervision_table, the_process_ends_in_order_on_the_ground_and_fast_in_flight) {
  for (const auto& child : all) {
    EXPECT_EQ(by_name(part::ground).at(child).policy.end, process_end::in_order);
    EXPECT_EQ(by_name(part::flight).at(child).policy.end, process_end::fast_once);
    EXPECT_EQ(by_name(part::after).at(child).policy.end, process_end::in_order);
  }
}

TEST(supervision_table, the_vehicle_link_is_restarted_for_ever_in_flight_once_the_process_may_not_end_because_of_it) {
  const circumstances again{.may_end_fast = false};
  for (const auto& child : all)
    EXPECT_EQ(by_name(part::flight, again).at(child).policy.restart.intensity == restart_policy::for_ever,
              child == "vehicle_link")
        << child;
  EXPECT_NE(by_name(part::flight).at("vehicle_link").policy.restart.intensity, restart_policy::for_ever);
  EXPECT_NE(by_name(part::ground, again).at("vehicle_link").policy.restart.intensity, restart_policy::for_ever);
}

TEST(supervision_table, a_reduced_process_runs_in_flight_only_what_flies_who_brings_commands_and_the_landing_watch) {
  const circumstances reduced{.may_end_fast = false, .is_reduced = true};
  for (const auto& child : all) {
    const std::set<std::string> kept{"vehicle_link", "failsafe",      "executor",
                                     "ground_port",  "landing_watch", "operator_bridge"};
    EXPECT_EQ(by_name(part::flight, reduced).at(child).wanted, kept.contains(child)) << child;
    EXPECT_TRUE(by_name(part::ground, reduced).at(child).wanted) << child;
    EXPECT_TRUE(by_name(part::after, reduced).at(child).wanted) << child;
  }
}

TEST(supervision_table, who_looks_for_things_is_wanted_only_in_a_flight_with_scanning_and_never_essential) {
  for (const auto* who : {"scan_controller", "movement_detector"}) {
    const auto entry = [who](part now, bool scans, bool is_reduced) {
      return table_of(now, {.is_reduced = is_reduced}, {who}, scans).front();
    };
    for (const auto now : parts)
      for (const bool scans : {false, true}) {
        EXPECT_EQ(entry(now, scans, false).wanted, now == part::flight && scans) << who;
        EXPECT_FALSE(entry(now, scans, true).wanted) << who;
        EXPECT_FALSE(entry(now, scans, false).policy.essential) << who;
      }
  }
}

TEST(supervision_table, the_floor_is_what_flies) {
  EXPECT_EQ(floor_children(), (std::vector<std::string>{"vehicle_link", "failsafe", "executor"}));
}

TEST(supervision_state, the_part_comes_from_in_flight_and_from_whether_this_mission_has_landed) {
  state s;
  EXPECT_EQ(part_of(s, false), part::ground);
  change_in_flight(s, true);
  EXPECT_EQ(part_of(s, true), part::flight);
  change_in_flight(s, false);
  EXPECT_EQ(part_of(s, false), part::after);
  change_in_flight(s, true);
  EXPECT_EQ(part_of(s, true), part::flight) << "it flies again";
}

TEST(supervision_state, each_landing_has_a_number_of_its_own) {
  state s;
  for (std::uint64_t n = 1; n <= 3; ++n) {
    change_in_flight(s, true);
    change_in_flight(s, false);
    EXPECT_EQ(s.landings, n);
  }
}

TEST(supervision_state, that_the_failsafe_is_gone_counts_for_one_flight) {
  state s;
  change_in_flight(s, true);
  apply(s, failsafe_missed{});
  EXPECT_TRUE(s.is_failsafe_missed);
  change_in_flight(s, false);
  EXPECT_FALSE(s.is_failsafe_missed);
}

} // namespace table_test
