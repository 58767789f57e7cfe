// A mission that is over is flown again at a person's start, as a mission of its own.
#include <algorithm>
#include <array>
#include <string>

#include <gtest/gtest.h>

#include "io/mavlink/plan_meaning.hpp"
#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/flight_world.hpp"
#include "tests/support/vehicle_modes.hpp"

namespace godwit::executor {
namespace new_run_test {

using mission::progress_kind;
using operators::command_kind;
using sim::personality;
using tests::flight_world;

class new_run : public testing::TestWithParam<personality> {
protected:
  [[nodiscard]] static flight_world::options settings() {
    flight_world::options result;
    result.who = GetParam();
    result.start = start_policy::on_command;
    result.has_service = false;
    return result;
  }
  // A start, and the whole flight.
  [[nodiscard]] static testing::AssertionResult fly(flight_world& world) {
    const bool is_flown = world.run_until_phase(phase::ready, 120) && world.say(command_kind::start).is_taken &&
                          world.run_until_phase(phase::done, 900);
    return is_flown ? testing::AssertionSuccess() : testing::AssertionFailure() << world.story();
  }
  [[nodiscard]] static auto completions(const flight_world& world, const std::string& mission_id) {
    return std::ranges::count_if(world.reports(), [&](const mission::progress_report& each) {
      return each.mission_id == mission_id && each.kind == progress_kind::complete;
    });
  }
};

TEST_P(new_run, of_a_mission_that_is_over_is_prepared_by_a_start_and_flown_by_the_next_one) {
  flight_world world(settings());
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(fly(world));
  const auto arms = world.arms();
  const auto answer = world.say(command_kind::start);
  ASSERT_TRUE(answer.is_taken) << answer.reason;
  ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
  world.run_for(30);
  EXPECT_EQ(world.arms(), arms) << "only the next start flies it";
  const auto again = world.durable().mission->mission_id;
  EXPECT_NE(again, mission.mission_id);
  EXPECT_EQ(world.durable().mission->items, mission.items);
  ASSERT_TRUE(fly(world));
  EXPECT_EQ(completions(world, mission.mission_id), 1);
  EXPECT_EQ(completions(world, again), 1) << world.story();
}

TEST_P(new_run, is_the_mission_as_it_came_and_not_as_it_was_changed_in_flight) {
  if (GetParam() == personality::plane)
    return; // called home it circles until its battery is low, and a failsafe has it
  flight_world world(settings());
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
  ASSERT_TRUE(world.say(command_kind::start).is_taken);
  const auto is_on_way = [&] { return tests::is_told(world, progress_kind::started, "w2"); };
  ASSERT_TRUE(world.run_until(is_on_way, 300)) << world.story();
  ASSERT_TRUE(world.say(command_kind::come_home).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::aborted, 300)) << world.story();
  const auto answer = world.say(command_kind::start);
  ASSERT_TRUE(answer.is_taken) << answer.reason << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
  EXPECT_EQ(world.durable().mission->items, mission.items);
  EXPECT_TRUE(fly(world));
}

TEST_P(new_run, goes_on_after_a_kill_and_a_mission_that_came_before_the_kill_has_to_be_handed_over_again) {
  flight_world world(settings());
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(fly(world));
  world.crash_all();
  world.run_for(3);
  EXPECT_FALSE(world.say(command_kind::start).is_taken) << world.story();
  world.load(mission); // as godwitd does it at each start, of a file
  ASSERT_TRUE(world.say(command_kind::start).is_taken) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
  const auto again = world.durable().mission->mission_id;
  ASSERT_TRUE(world.say(command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until([&] { return world.durable().status.in_flight; }, 60)) << world.story();
  world.crash_all();
  world.load(mission);
  ASSERT_TRUE(world.run_until_phase(phase::done, 900)) << world.story();
  EXPECT_EQ(completions(world, again), 1) << world.story();
}

TEST_P(new_run, of_the_mission_of_a_file_is_prepared_by_the_start_of_a_station_too) {
  flight_world world(settings());
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(fly(world));
  const auto& shown = world.shown_items();
  start_mission asked;
  asked.key = 1;
  asked.last = static_cast<std::uint16_t>(shown.size() - 1);
  asked.plan_id = io::mavlink::checksum_of(shown);
  asked.asked_by = {255, 190};
  asked.obey_until_ns = world.wall_ns() + 3'000'000'000;
  world.station_says(asked);
  ASSERT_FALSE(world.start_answers().empty());
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::not_ready);
  ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
  EXPECT_NE(world.durable().mission->mission_id, mission.mission_id);
}

TEST_P(new_run, is_the_services_to_give_where_there_is_one) {
  auto wanted = settings();
  wanted.has_service = true;
  flight_world world(wanted);
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
  ASSERT_TRUE(world.say(command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until([&] { return is_at_rest(world.durable().status.now); }, 900)) << world.story();
  const auto answer = world.say(command_kind::start);
  EXPECT_FALSE(answer.is_taken);
  EXPECT_NE(answer.reason.find("the missions service"), std::string::npos) << answer.reason;
}

std::string name_of(const testing::TestParamInfo<personality>& info) {
  constexpr std::array names{"rover", "px4", "copter", "plane"}; // by personality
  return names.at(static_cast<std::size_t>(info.param));
}

INSTANTIATE_TEST_SUITE_P(vehicles, new_run,
                         testing::Values(personality::rover, personality::px4, personality::ardupilot,
                                         personality::plane),
                         name_of);

} // namespace new_run_test
} // namespace godwit::executor
