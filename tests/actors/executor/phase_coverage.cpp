// Which rows of the phase table the flights of this run have taken, from which phase and how often, and that each of
// the arbiter has decided. Listed with TEST_COVERAGE=1, and then a row that was never taken is a failure: ctest runs
// all flights but the random ones so.
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include <gtest/gtest.h>

#include "io/fields/field_table.hpp"
#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace {

class phase_coverage final : public testing::Environment {
public:
  void TearDown() override {
    if (std::getenv("TEST_COVERAGE") == nullptr)
      return;
    for (std::size_t row = 0; row < phase_table().size(); ++row)
      list(phase_table()[row], tests::flight_world::all_transitions()[row]);
    for (std::size_t i = 0; i < core::arbiter().size(); ++i)
      EXPECT_TRUE(tests::flight_world::all_decisions()[i] > 0 || is_random(core::arbiter()[i].name))
          << core::arbiter()[i].name << " never decides";
  }

private:
  // Somebody else starts our plan in the moment after it came: random flights meet it.
  static bool is_random(std::string_view ruling) { return ruling == "follow_started"; }

  // The plan ends between two heartbeats, while something else is said: no flight by hand meets that moment, and random
  // ones seldom. phase_rows_test.cpp takes them.
  static bool is_moment(const transition& each) {
    if ((each.on == trigger::called_home && each.next == phase::paused) ||
        (each.on == trigger::held && has(each.from, phase::done)))
      return true; // somebody else flies a plan of his own, and an operator stops it or calls it home
    if (each.on == trigger::not_obeyed && (each.holds != nullptr || !has(each.from, phase::pausing)))
      return true; // the same, or the plan ends while the vehicle does not hold
    if (each.on == trigger::handed_back && each.guard.find("infeasible") != std::string_view::npos)
      return true; // a person has taken a PX4 before it has judged the plan that was brought in flight
    const bool is_at_end = each.guard.find("plan finished") != std::string_view::npos;
    return is_at_end && (each.on == trigger::resumed || each.on == trigger::found_in_flight ||
                         (each.on == trigger::handed_back && each.next == phase::landing));
  }

  static void list(const transition& each, const phase_machine::counts& taken) {
    std::cout << io::name_of(each.on) << (each.guard.empty() ? "" : " [") << each.guard
              << (each.guard.empty() ? ":" : "]:");
    for (std::size_t from = 0; from < taken.size(); ++from)
      if (taken[from] > 0)
        std::cout << " " << io::name_of(static_cast<phase>(from)) << " " << taken[from];
    std::cout << "\n";
    EXPECT_TRUE(is_moment(each) || std::ranges::any_of(taken, [](std::uint32_t n) { return n > 0; }))
        << io::name_of(each.on) << " is never taken";
  }
};

const auto* const coverage = testing::AddGlobalTestEnvironment(new phase_coverage);

} // namespace
} // namespace godwit::executor
