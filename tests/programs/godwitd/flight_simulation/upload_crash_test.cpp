// vehicle_link dies at each step of an assignment's upload: the assignment is flown all the same, and answered once.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/short_mission.hpp"
#include "tests/support/run_options.hpp"

namespace upload_crash_test {

using namespace godwit;
using namespace godwit::drill;
using namespace godwit::tests;
using side = flight_simulation::side;
using executor::phase;
using runtime::crash_point;
using sim::missions::row_kind;

constexpr std::array points{crash_point::before_handler, crash_point::after_handler, crash_point::after_commit,
                            crash_point::before_dispatch};

class upload_crash : public testing::TestWithParam<sim::personality> {
protected:
  // Frames of a plan's upload that have reached the vehicle.
  static int uploaded(const flight_simulation& flight) {
    return static_cast<int>(std::ranges::count_if(flight.orders(), [](const vehicle_order& each) {
      return each.message_id == io::mavlink::mission_count::message_id ||
             each.message_id == io::mavlink::mission_item_int::message_id;
    }));
  }
  static bool has_been_at(flight_simulation& flight, const std::string& item) {
    return std::ranges::any_of(flight.reports(), [&](const mission::progress_report& each) {
      return each.kind == mission::progress_kind::reached && each.item_id == item;
    });
  }
  static void assign(flight_simulation& flight) {
    sim::missions::assignment_request wanted;
    const double up_m = GetParam() == sim::personality::rover ? 0 : 20;
    wanted.replace_after_item_id = "w2";
    wanted.items = {place("n1", 20, 20, up_m), place("n2", -30, 20, up_m)};
    if (GetParam() != sim::personality::rover)
      wanted.items.emplace_back(mission::return_home{"home_again"});
    ASSERT_TRUE(flight.service().assign(flight.mission_id(), wanted, flight.now_ns()));
  }
  // False: the upload has no such step.
  static bool flies_with_crash_at(int step, crash_point point);
};

bool upload_crash::flies_with_crash_at(int step, crash_point point) {
  flight_simulation flight({.who = GetParam(), .seed = static_cast<std::uint64_t>(step)});
  EXPECT_TRUE(flight.run_until([&] { return has_been_at(flight, "w1"); }, 120)) << flight.story();
  const auto before = uploaded(flight);
  assign(flight);
  const bool has_step = flight.run_until([&] { return uploaded(flight) >= before + step; }, 10);
  if (has_step)
    flight.process()->crash_at("vehicle_link", point);
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
  EXPECT_EQ(flight.service().rows(flight.mission_id(), row_kind::response).size(), 1U) << flight.story();
  EXPECT_TRUE(has_been_at(flight, "n2")) << flight.story();
  return has_step;
}

TEST_P(upload_crash, at_any_step_of_an_assignments_upload_rejects_nothing_and_answers_once) {
  int steps = 0;
  for (int step = 1; step <= 20; ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    const auto first = static_cast<std::size_t>(step) % points.size();
    if (!flies_with_crash_at(step, points.at(first)) || HasFailure())
      break;
    ++steps;
    for (std::size_t i = 1; is_full_run() && i < points.size(); ++i)
      static_cast<void>(flies_with_crash_at(step, points.at((first + i) % points.size())));
  }
  EXPECT_GE(steps, 3);
}

// The process, before and after each commit from the assignment to its answer.
TEST_P(upload_crash, a_kill_at_any_commit_of_an_assignment_in_flight_answers_once) {
  constexpr std::uint64_t most_commits = 60;
  int kills = 0;
  for (std::uint64_t n = 1; n <= most_commits; ++n) {
    bool is_over = false;
    for (const auto where : {side::before, side::after}) {
      SCOPED_TRACE("commit " + std::to_string(n) + (where == side::before ? " before" : " after"));
      flight_simulation flight({.who = GetParam(), .seed = n});
      ASSERT_TRUE(flight.run_until([&] { return has_been_at(flight, "w1"); }, 120)) << flight.story();
      assign(flight);
      const auto responses = [&] { return flight.service().rows(flight.mission_id(), row_kind::response).size(); };
      flight.kill_process_at_commit(flight.commits() + n, where);
      const auto is_answered = [&] { return responses() > 0; };
      (void)flight.run_until([&] { return flight.processes() > 1 || is_answered(); }, 30);
      is_over = flight.processes() == 1; // answered before
      if (is_over)
        break;
      ++kills;
      EXPECT_TRUE(fly_with_help(flight)) << flight.story();
      EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
      EXPECT_EQ(responses(), 1U) << flight.story();
      EXPECT_TRUE(has_been_at(flight, "n2")) << flight.story();
      if (HasFailure())
        return;
    }
    if (is_over)
      break;
  }
  RecordProperty("kills", kills);
  EXPECT_GE(kills, 6);
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, upload_crash,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

} // namespace upload_crash_test
