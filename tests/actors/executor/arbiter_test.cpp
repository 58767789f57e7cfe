// In which order the parts of the core are asked. That each decides is seen by phase_coverage.cpp.
#include <algorithm>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "actors/executor/core.hpp"

namespace godwit::executor {
namespace arbiter_test {

std::size_t place_of(std::string_view name) {
  const auto all = core::arbiter();
  const auto found = std::ranges::find(all, name, &core::ruling::name);
  EXPECT_NE(found, all.end()) << name;
  return static_cast<std::size_t>(found - all.begin());
}

TEST(arbiter, each_has_a_name_of_its_own_and_a_reason_for_its_place) {
  std::set<std::string_view> names;
  for (const auto& each : core::arbiter()) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    EXPECT_FALSE(each.why.empty()) << each.name;
    EXPECT_NE(each.ask, nullptr) << each.name;
  }
}

TEST(arbiter, nothing_is_decided_before_a_new_incarnation_has_seen_the_vehicle) { EXPECT_EQ(place_of("look"), 0U); }

TEST(arbiter, who_has_the_vehicle_is_judged_before_anything_is_sent_to_it) {
  EXPECT_EQ(place_of("judge_holder"), place_of("look") + 1);
}

TEST(arbiter, people_and_what_stops_come_before_what_moves) {
  const std::vector<std::pair<std::string_view, std::string_view>> before{{"halt", "run_task"},
                                                                          {"halt", "resolve"},
                                                                          {"come_home", "halt"},
                                                                          {"resolve", "run_task"},
                                                                          {"run_task", "end_flight"},
                                                                          {"end_flight", "answer_assignment"},
                                                                          {"end_flight", "prepare"},
                                                                          {"stand_by", "prepare"},
                                                                          {"fly_unanswered", "deploy_arrived"},
                                                                          {"follow_started", "prepare"},
                                                                          {"take_back", "leave_to_person"}};
  for (const auto& [first, second] : before)
    EXPECT_LT(place_of(first), place_of(second)) << first << " before " << second;
}

TEST(arbiter, what_begins_a_flight_waits_while_somebody_else_has_the_vehicle) {
  for (const auto* const begins : {"bring_last_line", "begin_wanted", "prepare"})
    EXPECT_LT(place_of("leave_to_person"), place_of(begins)) << begins;
}

} // namespace arbiter_test
} // namespace godwit::executor
