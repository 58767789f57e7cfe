#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace checks_test {

using namespace test;

TEST(preflight_checks, each_has_a_name_of_its_own) {
  std::set<std::string_view> names;
  for (const auto& each : checks)
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
  EXPECT_FALSE(names.contains(""));
}

TEST(preflight_checks, each_passes_when_all_is_well) {
  auto seen = good_facts();
  seen.is_operator_session_alive = true;
  for (const auto& each : checks)
    EXPECT_EQ(each.look(seen, {.is_operator_session_required = true}).how, verdict::pass) << each.name;
}

TEST(preflight_checks, none_passes_when_nothing_is_known) {
  for (const auto& each : checks)
    EXPECT_NE(each.look({}, {}).how, verdict::pass) << each.name;
}

TEST(preflight_checks, nothing_that_was_known_of_the_vehicle_passes_when_it_is_not_heard_any_more) {
  auto seen = good_facts();
  seen.vehicle.link = vehicle_link::connection_phase::lost;
  for (const auto& each : checks) {
    const auto name = each.name;
    const bool is_of_vehicle = name == "vehicle_kind" || name == "position" || name == "home" || name == "on_ground" ||
                               name == "battery" || name == "autopilot_checks" || name == "vehicle_ready" ||
                               name == "energy" || name == "places" || name == "planned_home" || name == "open_line";
    EXPECT_EQ(each.look(seen, {}).how == verdict::skipped, is_of_vehicle || name == "operator_session") << name;
  }
}

TEST(preflight_checks, each_says_something_whatever_it_finds) {
  for (const auto& each : checks) {
    EXPECT_FALSE(each.look(good_facts(), {}).sentence.empty()) << each.name;
    EXPECT_FALSE(each.look({}, {}).sentence.empty()) << each.name;
  }
}

} // namespace checks_test
} // namespace godwit::executor::preflight
