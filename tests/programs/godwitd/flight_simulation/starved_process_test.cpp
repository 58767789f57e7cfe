// The process gets no processor in a start: it is not gone on with by itself. And the timers of actors that were
// restarted keep their pace.
#include <gtest/gtest.h>

#include <map>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"

namespace starved_process_test {

using namespace godwit;
using namespace godwit::drill;
using executor::phase;

class starved_start : public testing::TestWithParam<sim::personality> {};

// Armed, and not started: whoever stands there sees a vehicle of which nothing comes any more.
TEST_P(starved_start, is_not_gone_on_with_before_a_person_says_so) {
  const sim::line_settings each_way{.delay = std::chrono::milliseconds(20)};
  flight_simulation flight({.who = GetParam(), .speed = 2, .stream_factor = 0.5, .line = {each_way, each_way}});
  ASSERT_TRUE(flight.run_until_phase(phase::starting, 120)) << flight.story();
  const auto began_ns = flight.now_ns();
  ASSERT_TRUE(flight.run_until([&] { return flight.vehicle().describe().armed; }, 10)) << flight.story();
  ASSERT_EQ(missions_started_since(flight, began_ns), 0) << flight.story();
  flight.suspend_process(10);
  flight.run_for(15);
  EXPECT_EQ(missions_started_since(flight, began_ns), 0) << flight.story();
  EXPECT_FALSE(flight.vehicle().describe().in_air);
  if (flight.vehicle().describe().armed) { // most disarm by themselves; who has it by now nobody can tell
    EXPECT_TRUE(flight.was_told_last("the vehicle stands armed")) << flight.story();
    flight.person().disarm();
    flight.run_for(3);
  }
  EXPECT_TRUE(fly_with_help(flight)) << flight.story();
  EXPECT_EQ(flight.status().now, phase::done) << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
}

// A hold of a person beside a vehicle that stands in this mode shows in nothing that is heard on godwit's line, and the
// socket of a process that was stopped keeps only so much of what is.
TEST_P(starved_start, is_not_gone_on_with_after_a_second_in_which_a_person_may_have_acted) {
  const sim::line_settings each_way{.delay = std::chrono::milliseconds(20)};
  flight_simulation flight({.who = GetParam(),
                            .speed = 2,
                            .stream_factor = 0.5,
                            .is_person_on_other_line = true,
                            .line = {each_way, each_way}});
  ASSERT_TRUE(flight.run_until_phase(phase::starting, 120)) << flight.story();
  const auto began_ns = flight.now_ns();
  ASSERT_TRUE(flight.run_until([&] { return flight.vehicle().describe().armed; }, 10)) << flight.story();
  ASSERT_EQ(missions_started_since(flight, began_ns), 0) << flight.story();
  flight.suspend_process(1.8);
  flight.run_for(1);
  flight.person().change_mode(GetParam(), hold_mode(GetParam()), mode_form::do_set_mode_armed);
  flight.run_for(12);
  EXPECT_EQ(missions_started_since(flight, began_ns), 0) << flight.story();
  EXPECT_FALSE(flight.vehicle().describe().in_air) << flight.story();
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, starved_start,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

// In five seconds, by type.
std::map<std::string, int> ticks_of(flight_simulation& flight, const std::map<std::string, int>& counted) {
  const auto before = counted;
  flight.run_for(5);
  auto result = counted;
  for (auto& [type, count] : result)
    if (const auto known = before.find(type); known != before.end())
      count -= known->second;
  return result;
}

TEST(restarted_actors, begin_no_second_chain_of_ticks) {
  flight_simulation flight({.who = sim::personality::px4, .speed = 1, .is_recorded = true});
  std::map<std::string, int> counted;
  flight.record().tell([&](const runtime::delivery& each) {
    const auto& type = flight.record().names().name(each.type);
    if (type.ends_with(".tick"))
      ++counted[type];
  });
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
  const auto once = ticks_of(flight, counted);
  for (const auto* actor : {"executor", "landing_watch"}) {
    ASSERT_TRUE(flight.process()->kill(actor)) << actor;
    flight.run_for(4); // its successor is there, and what was on its way has come
    ASSERT_TRUE(flight.process()->kill(actor)) << actor;
    flight.run_for(4);
  }
  const auto behind = ticks_of(flight, counted);
  for (const auto* type : {"executor.tick", "landing_watch.tick"})
    EXPECT_NEAR(behind.at(type), once.at(type), 1) << type;
}

} // namespace starved_process_test
