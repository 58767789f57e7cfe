#include "programs/godwit-drill/flights/watched_flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "programs/godwit-drill/flights/flight_case.hpp"
#include "tests/programs/godwit-drill/flights/every_vehicle.hpp"

namespace known_findings_test {

using namespace godwit;
using namespace godwit::drill;

TEST(known_findings, are_of_cases_that_are_there) {
  constexpr std::array<std::uint64_t, 4> commits{40, 40, 40, 40};
  std::vector<std::string> names;
  for (const auto& cases :
       {actor_loss_cases(every_vehicle), disk_cases(every_vehicle, commits), link_cases(every_vehicle)})
    for (const auto& each : cases)
      names.push_back(each.name);
  for (const auto& known : known_findings())
    EXPECT_TRUE(std::ranges::any_of(names, [&](const std::string& name) {
      return name.find(known.in_name) != std::string::npos;
    })) << known.in_name;
}

constexpr std::array some{known_finding{"/replaced_and_killed/", "goes back to an earlier item"}};

TEST(known_findings, do_not_hide_what_else_goes_wrong_in_the_same_flight) {
  flight_outcome outcome;
  outcome.name = "px4/replaced_and_killed/commit_37";
  outcome.flaws = {"report 4 goes back to an earlier item", "it was started by itself after a flight that nobody knew"};
  set_known_aside(outcome, some);
  EXPECT_EQ(outcome.flaws, (std::vector<std::string>{"it was started by itself after a flight that nobody knew"}));
  EXPECT_EQ(outcome.known, (std::vector<std::string>{"report 4 goes back to an earlier item"}));
}

TEST(known_findings, hide_nothing_of_another_flight) {
  flight_outcome outcome;
  outcome.name = "px4/power_loss/commit_37";
  outcome.flaws = {"report 4 goes back to an earlier item"};
  set_known_aside(outcome, some);
  EXPECT_EQ(outcome.flaws.size(), 1U);
}

} // namespace known_findings_test
