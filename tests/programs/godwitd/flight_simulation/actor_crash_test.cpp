// A throw at each crash point of each actor's shell, in each part of a flight: the flight goes on, and the service gets
// each report once.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "tests/support/run_options.hpp"

namespace actor_crash_test {

using namespace godwit;
using namespace godwit::drill;
using namespace godwit::tests;
using executor::phase;
using runtime::crash_point;

constexpr std::array actors{"vehicle_link", "failsafe",    "mapobjects_store", "mission_client",
                            "executor",     "ground_port", "operator_bridge"};
constexpr std::array points{crash_point::before_handler, crash_point::after_handler, crash_point::after_commit,
                            crash_point::before_dispatch};
// As each of these begins, the next throw is planned. Five within a minute, and an actor would be given up.
constexpr std::array parts{phase::preflight, phase::uploading, phase::starting, phase::flying, phase::post_flight};

struct crash_case {
  sim::personality who;
  const char* actor;
};

std::vector<crash_case> all_cases() {
  std::vector<crash_case> result;
  for (const auto who : {sim::personality::rover, sim::personality::px4, sim::personality::ardupilot})
    for (const auto* actor : actors)
      result.push_back({who, actor});
  return result;
}

class actor_crash : public testing::TestWithParam<crash_case> {};

void fly_with_throws(std::uint64_t seed, crash_point point) {
  const auto [who, actor] = actor_crash::GetParam();
  flight_simulation flight({.who = who, .seed = seed});
  std::size_t part = 0;
  const auto plan_next = [&] {
    if (part < parts.size() && flight.status().now == parts[part] && flight.process() != nullptr) {
      flight.process()->crash_at(actor, point);
      ++part;
    }
    return executor::is_at_rest(flight.status().now) || flight.status().now == phase::paused;
  };
  (void)flight.run_until(plan_next, 120);
  EXPECT_TRUE(fly_with_help(flight)) << flight.story();
  EXPECT_EQ(flaw_of_end(flight), "") << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
}

TEST_P(actor_crash, in_any_part_of_a_flight_loses_and_doubles_nothing) {
  const std::uint64_t seeds = is_full_run() ? 20 : 1;
  for (const auto point : points)
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      SCOPED_TRACE("point " + std::to_string(static_cast<int>(point)) + ", seed " + std::to_string(seed));
      fly_with_throws(seed, point);
      if (HasFailure())
        return;
    }
}

INSTANTIATE_TEST_SUITE_P(every_actor, actor_crash, testing::ValuesIn(all_cases()), [](const auto& each) {
  return std::string(io::name_of(each.param.who)) + "_" + each.param.actor;
});

} // namespace actor_crash_test
