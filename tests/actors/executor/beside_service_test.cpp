// Missions that people bring to a daemon which a service gives one mission after the other.
#include <gtest/gtest.h>

#include "messages/executor/known_missions.hpp"
#include "tests/actors/executor/station_plans.hpp"

namespace godwit::executor {
namespace beside_service_test {

using mission_client::pull_state;

class beside_service : public testing::TestWithParam<sim::personality> {
protected:
  [[nodiscard]] static flight_world::options one_after_the_other() {
    return {.who = GetParam(), .start = start_policy::on_command, .asks_next = true};
  }
  [[nodiscard]] static mission::document of_service() { return tests::short_mission(GetParam()); }
};

TEST_P(beside_service, a_stations_plan_is_flown_while_none_of_the_service_is_under_way) {
  auto options = one_after_the_other();
  options.map = pull_state::failed; // of the service's, and not needed
  flight_world world(options);
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(world, items));
  const auto own = world.durable().mission->mission_id;
  EXPECT_TRUE(is_of_people(world.durable(), own));
  EXPECT_EQ(world.missions().list.front().origin, mission_origin::station);
  ASSERT_TRUE(fly_to_end(world, items));
  EXPECT_EQ(world.pushes(), 0) << "the service does not know it";
  EXPECT_EQ(world.pulls(), 0);
  EXPECT_FALSE(world.reports().empty());
}

TEST_P(beside_service, the_services_next_mission_follows_a_stations) {
  flight_world world(one_after_the_other());
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(world, items));
  ASSERT_TRUE(fly_to_end(world, items));
  world.load(of_service());
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  EXPECT_FALSE(is_of_people(world.durable(), world.durable().mission->mission_id));
  ASSERT_TRUE(world.say(operators::command_kind::start).is_taken);
  EXPECT_TRUE(world.run_until_phase(phase::post_flight)) << world.story();
  EXPECT_EQ(world.pushes(), 1) << "and is delivered";
}

TEST_P(beside_service, a_stations_plan_is_refused_while_one_of_the_service_is_under_way) {
  flight_world world(one_after_the_other());
  world.load(of_service());
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.station_says(taken(station_items(GetParam())));
  EXPECT_TRUE(was_said(world, "missions come from the missions service here")) << world.story();
  EXPECT_EQ(world.durable().mission->mission_id, of_service().mission_id);
  EXPECT_FALSE(world.durable().arrived);
}

TEST_P(beside_service, the_services_mission_that_comes_in_a_stations_flight_waits_for_its_end) {
  flight_world world(one_after_the_other());
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(world, items));
  world.station_says(start_of(world, items));
  ASSERT_TRUE(world.run_until_phase(phase::flying)) << world.story();
  const auto own = world.durable().mission->mission_id;
  world.load(of_service());
  world.run_for(0.5);
  EXPECT_EQ(world.durable().mission->mission_id, own) << world.story();
  EXPECT_TRUE(world.durable().status.in_flight);
  ASSERT_TRUE(world.run_until([&] { return world.durable().mission->mission_id == of_service().mission_id; }, 600))
      << world.story();
  world.run_for(120);
  EXPECT_FALSE(world.durable().status.in_flight) << "a person starts it\n" << world.story();
  EXPECT_EQ(world.durable().status.now, phase::ready) << world.story();
}

TEST_P(beside_service, after_a_crash_in_a_stations_flight_the_service_is_not_asked_for_it) {
  flight_world world(one_after_the_other());
  const auto items = station_items(GetParam());
  ASSERT_TRUE(bring(world, items));
  ASSERT_TRUE(fly_two_items(world, items));
  const auto begins = world.begins();
  world.crash_all();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.begins(), begins) << world.story();
  EXPECT_EQ(world.pushes(), 0);
}

// A person who looks at a plan in a station must not launch it.
TEST_P(beside_service, nothing_that_people_bring_is_taken_where_flights_start_by_themselves) {
  auto options = one_after_the_other();
  options.start = start_policy::automatic;
  flight_world world(options);
  world.station_says(taken(station_items(GetParam())));
  world.run_for(60);
  EXPECT_TRUE(was_said(world, "flight.start is automatic")) << world.story();
  EXPECT_FALSE(world.durable().mission);
  EXPECT_EQ(world.arms(), 0);
}

INSTANTIATE_TEST_SUITE_P(each, beside_service,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::rover));

} // namespace beside_service_test
} // namespace godwit::executor
