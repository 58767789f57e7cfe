// Who runs and what follows when somebody can not be kept up, on the real composition of the daemon.
#include <set>

#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"
#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/short_mission.hpp"

namespace supervision_test {

using namespace godwit;
using namespace godwit::drill;
using executor::phase;
using runtime::child_phase;

constexpr double part_lasts_s = 6; // and a little more

class supervised : public testing::Test {
protected:
  // A vehicle that flies as slowly as a real one, so that a child can be given up on the way.
  explicit supervised(executor::failsafe_gone_policy gone = executor::failsafe_gone_policy::come_home)
      : flight({.who = sim::personality::px4, .speed = 2, .is_shuffled = false}) {
    flight.outside().settings.flight.failsafe_gone = gone;
  }

  // Until the table of the flight holds.
  void take_off() {
    ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
    flight.run_for(part_lasts_s);
    ASSERT_TRUE(flight.status().in_flight) << flight.story();
  }
  void land() {
    ASSERT_TRUE(flight.run_until([&] { return !flight.status().in_flight; }, 600)) << flight.story();
    flight.run_for(part_lasts_s);
  }
  runtime::child_report look_at(const std::string& actor) { return flight.process()->look_at(actor); }
  bool was_ordered_home(std::int64_t since_ns) {
    return std::ranges::any_of(flight.orders(), [&](const vehicle_order& each) {
      return each.at_ns >= since_ns && each.command == io::mavlink::number(io::mavlink::mav_cmd::do_set_mode);
    });
  }
  void end_process_by(const std::string& actor) {
    ASSERT_TRUE(flight.give_up(actor)) << flight.story();
    flight.run_for(2);
    ASSERT_EQ(flight.processes(), 2) << flight.story();
  }
  // The first time the process ends; so the second time it is given up for good.
  void give_up_twice(const std::string& actor) {
    ASSERT_NO_FATAL_FAILURE(end_process_by(actor));
    ASSERT_TRUE(flight.give_up(actor)) << flight.story();
  }

  flight_simulation flight;
};

TEST_F(supervised, in_flight_the_table_of_the_flight_holds_when_it_has_lasted) {
  take_off();
  EXPECT_FALSE(look_at("mission_client").essential);
  EXPECT_TRUE(look_at("failsafe").essential);
  land();
  EXPECT_TRUE(look_at("mission_client").essential) << "it delivers";
}

TEST_F(supervised, the_executor_killed_at_each_change_of_phase_leaves_the_flight_undisturbed) {
  std::set<phase> killed_in{flight.status().now};
  const auto waits = [&] {
    const auto& at = flight.status();
    return at.now == phase::paused || (at.now == phase::ready && !at.reason.empty());
  };
  const auto is_over = [&] {
    const auto now = flight.status().now;
    if (flight.process() != nullptr && !killed_in.contains(now) && flight.process()->kill("executor"))
      killed_in.insert(now);
    return executor::is_at_rest(now) || waits();
  };
  for (int i = 0; i < 20 && !executor::is_at_rest(flight.status().now); ++i) {
    (void)flight.run_until(is_over, 600);
    flight.run_for(20); // so that it is not given up for crashing too often
    if (waits())        // on the ground nothing goes on by itself
      flight.say(flight.status().now == phase::paused ? operators::command_kind::resume
                                                      : operators::command_kind::start);
    flight.run_for(1);
  }
  EXPECT_GE(killed_in.size(), 6) << flight.story();
  EXPECT_TRUE(fly_with_help(flight)) << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
  EXPECT_EQ(flight.processes(), 1) << "no actor was given up";
}

TEST_F(supervised, on_the_ground_an_essential_actor_that_is_given_up_ends_the_process) {
  flight.run_for(1);
  for (const auto* actor : {"vehicle_link", "failsafe", "executor"}) {
    const auto before = flight.processes();
    EXPECT_TRUE(flight.give_up(actor)) << flight.story();
    flight.run_for(1);
    EXPECT_EQ(flight.processes(), before + 1) << actor << flight.story();
  }
}

TEST_F(supervised, on_the_ground_another_actor_that_is_given_up_keeps_the_flight_from_starting) {
  flight.run_for(0.5);
  ASSERT_TRUE(flight.give_up("mapobjects_store")) << flight.story();
  EXPECT_EQ(flight.processes(), 1);
  EXPECT_FALSE(flight.run_until_phase(phase::flying, 60)) << flight.story();
  EXPECT_TRUE(flight.was_told("mapobjects_store is given up")) << flight.story();
}

TEST_F(supervised, in_flight_an_actor_that_is_not_essential_is_given_up_and_is_back_after_the_landing) {
  for (const auto* actor : {"mapobjects_store", "mission_client", "ground_port"}) {
    flight_simulation other({.who = sim::personality::px4, .speed = 2, .is_shuffled = false});
    ASSERT_TRUE(other.run_until_phase(phase::flying, 120)) << other.story();
    other.run_for(part_lasts_s);
    ASSERT_TRUE(other.give_up(actor)) << other.story();
    EXPECT_EQ(other.process()->look_at(actor).phase, child_phase::given_up) << actor;
    EXPECT_TRUE(other.status().in_flight) << actor << other.story();
    ASSERT_TRUE(other.run_until([&] { return !other.status().in_flight; }, 600)) << actor << other.story();
    other.run_for(part_lasts_s);
    EXPECT_EQ(other.process()->look_at(actor).phase, child_phase::running) << actor << other.story();
    EXPECT_TRUE(fly_with_help(other)) << actor << other.story();
    EXPECT_EQ(other.processes(), 1) << actor;
    EXPECT_EQ(flaw_of_reports(other), "") << actor << other.story();
  }
}

TEST_F(supervised, in_flight_an_essential_actor_that_is_given_up_ends_the_process_fast_and_the_flight_goes_on) {
  for (const auto* actor : {"vehicle_link", "failsafe", "executor"}) {
    flight_simulation other({.who = sim::personality::px4, .speed = 2, .is_shuffled = false});
    ASSERT_TRUE(other.run_until_phase(phase::flying, 120)) << other.story();
    other.run_for(part_lasts_s);
    EXPECT_TRUE(other.give_up(actor)) << actor << other.story();
    EXPECT_TRUE(fly_with_help(other)) << actor << other.story();
    EXPECT_EQ(other.processes(), 2) << actor << other.story();
    EXPECT_EQ(flaw_of_reports(other), "") << actor << other.story();
  }
}

TEST_F(supervised, without_a_failsafe_the_vehicle_is_returned_once_and_people_are_told) {
  take_off();
  const auto since_ns = flight.now_ns();
  ASSERT_NO_FATAL_FAILURE(give_up_twice("failsafe"));
  EXPECT_EQ(flight.processes(), 2) << "it stays up" << flight.story();
  EXPECT_TRUE(flight.run_until([&] { return flight.vehicle().describe().mode == "AUTO.RTL"; }, 5)) << flight.story();
  EXPECT_TRUE(was_ordered_home(since_ns)) << flight.story();
  EXPECT_TRUE(flight.was_told("the failsafe can not be kept up")) << flight.story();
  ASSERT_TRUE(flight.run_until_phase(phase::landing, 5)) << flight.story();
  ASSERT_TRUE(flight.process()->kill("executor"));
  const auto before = flight.now_ns();
  flight.run_for(3);
  EXPECT_EQ(moves_since(flight, before), 0) << "once" << flight.story();
  ASSERT_NO_FATAL_FAILURE(land());
  EXPECT_EQ(look_at("failsafe").phase, child_phase::running) << flight.story();
}

TEST_F(supervised, without_a_failsafe_a_pilot_keeps_the_vehicle) {
  take_off();
  flight.switch_mode(pilot_mode(sim::personality::px4));
  ASSERT_TRUE(flight.run_until_phase(phase::paused, 10)) << flight.story();
  const auto since_ns = flight.now_ns();
  ASSERT_NO_FATAL_FAILURE(give_up_twice("failsafe"));
  flight.run_for(5);
  EXPECT_EQ(moves_since(flight, since_ns), 0) << flight.story();
  EXPECT_TRUE(flight.was_told("the vehicle is not commanded to return")) << flight.story();
}

class supervised_to_go_on : public supervised {
protected:
  supervised_to_go_on() : supervised(executor::failsafe_gone_policy::go_on) {}
};

TEST_F(supervised_to_go_on, without_a_failsafe_the_mission_is_flown_and_no_new_plan_is) {
  take_off();
  ASSERT_NO_FATAL_FAILURE(give_up_twice("failsafe"));
  flight.run_for(3);
  EXPECT_TRUE(flight.was_told("the failsafe can not be kept up")) << flight.story();
  sim::missions::assignment_request wanted;
  wanted.replace_after_item_id = "w2";
  wanted.items = {place("n1", 20, 20, 20), mission::return_home{"home_again"}};
  ASSERT_TRUE(flight.service().assign(flight.mission_id(), wanted, flight.now_ns()));
  const auto since_ns = flight.now_ns();
  ASSERT_TRUE(flight.run_until([&] { return !flight.status().in_flight; }, 600)) << flight.story();
  EXPECT_EQ(moves_since(flight, since_ns), 0) << "nothing is uploaded and nobody returns it" << flight.story();
}

TEST_F(supervised, without_an_executor_the_link_and_the_failsafe_go_on) {
  take_off();
  ASSERT_NO_FATAL_FAILURE(give_up_twice("executor"));
  EXPECT_EQ(flight.processes(), 2) << flight.story();
  flight.run_for(30);
  EXPECT_EQ(flight.processes(), 2) << flight.story();
  EXPECT_EQ(look_at("executor").phase, child_phase::given_up);
  EXPECT_EQ(look_at("vehicle_link").phase, child_phase::running);
  EXPECT_EQ(look_at("failsafe").phase, child_phase::running);
}

// Nobody counts the landing then; the next process has an executor that reports what was flown.
TEST_F(supervised, after_a_landing_without_an_executor_the_process_ends_once_and_the_next_one_has_one) {
  take_off();
  ASSERT_NO_FATAL_FAILURE(give_up_twice("executor"));
  const auto since_ns = flight.now_ns();
  ASSERT_TRUE(flight.run_until([&] { return !flight.vehicle().describe().armed; }, 600)) << flight.story();
  ASSERT_EQ(flight.processes(), 2) << "not in the air" << flight.story();
  flight.run_for(9);
  EXPECT_EQ(flight.processes(), 2) << "somebody may arm it again" << flight.story();
  flight.run_for(6);
  ASSERT_EQ(flight.processes(), 3) << flight.story();
  EXPECT_EQ(moves_since(flight, since_ns), 0) << flight.story();
  EXPECT_TRUE(fly_with_help(flight)) << flight.story();
  EXPECT_EQ(look_at("executor").phase, child_phase::running);
  EXPECT_EQ(flight.processes(), 3) << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
}

TEST_F(supervised, an_executor_that_was_given_up_under_a_pilot_comes_back_when_the_pilot_has_disarmed) {
  take_off();
  ASSERT_NO_FATAL_FAILURE(give_up_twice("executor"));
  flight.switch_mode(landing_mode(sim::personality::px4));
  ASSERT_TRUE(flight.run_until([&] { return !flight.vehicle().describe().armed; }, 600)) << flight.story();
  flight.run_for(60);
  EXPECT_EQ(flight.processes(), 3) << flight.story();
  EXPECT_EQ(look_at("executor").phase, child_phase::running);
  EXPECT_TRUE(executor::needs_hand_back(flight.status().cause)) << "a person has it" << flight.story();
  EXPECT_FALSE(flight.vehicle().describe().armed) << flight.story();
}

// After a flight: who delivers and who would fly again is essential, and the others do without each other.
TEST_F(supervised, after_the_flight_each_child_that_is_given_up_ends_the_process_when_it_is_essential) {
  for (const auto* actor :
       {"vehicle_link", "failsafe", "executor", "mission_client", "ground_port", "mapobjects_store"}) {
    const std::string name = actor;
    flight_simulation other({.who = sim::personality::px4, .speed = 10, .is_shuffled = false});
    ASSERT_TRUE(other.run_until_phase(phase::flying, 120)) << other.story();
    other.run_for(part_lasts_s);
    ASSERT_TRUE(other.run_until([&] { return !other.status().in_flight; }, 600)) << other.story();
    other.run_for(part_lasts_s);
    const bool is_essential = name != "ground_port" && name != "mapobjects_store";
    EXPECT_EQ(other.process()->look_at(name).essential, is_essential) << name;
    ASSERT_TRUE(other.give_up(name)) << name << other.story();
    other.run_for(1);
    EXPECT_EQ(other.processes(), is_essential ? 2 : 1) << name << other.story();
    if (!is_essential) {
      EXPECT_EQ(other.process()->look_at(name).phase, child_phase::given_up) << name;
    }
    EXPECT_TRUE(fly_with_help(other)) << name << other.story();
    EXPECT_EQ(flaw_of_reports(other), "") << name << other.story();
  }
}

TEST_F(supervised, the_vehicle_link_is_restarted_for_ever_when_the_process_may_not_end_because_of_it) {
  take_off();
  ASSERT_NO_FATAL_FAILURE(end_process_by("vehicle_link"));
  ASSERT_FALSE(flight.give_up("vehicle_link", 25)) << flight.story();
  ASSERT_TRUE(flight.status().in_flight) << flight.story();
  EXPECT_GT(flight.process()->crashes("vehicle_link"), 2 * runtime::restart_policy{}.intensity - 2);
  EXPECT_EQ(flight.processes(), 2) << flight.story();
  flight.run_for(6);
  EXPECT_EQ(look_at("vehicle_link").phase, child_phase::running);
}

TEST_F(supervised, two_actors_given_up_at_once_in_flight_end_the_process_once) {
  take_off();
  (void)flight.run_until(
      [&] {
        if (flight.process() == nullptr || flight.processes() == 2)
          return true;
        (void)flight.process()->kill("failsafe");
        (void)flight.process()->kill("executor");
        return false;
      },
      20);
  EXPECT_TRUE(fly_with_help(flight)) << flight.story();
  EXPECT_EQ(flight.processes(), 2) << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
}

TEST_F(supervised, after_ten_abnormal_ends_in_flight_only_what_flies_runs_until_the_landing) {
  take_off();
  for (int n = 0; n < 11; ++n) {
    flight.kill_process();
    flight.run_for(0.6);
  }
  ASSERT_TRUE(flight.status().in_flight) << flight.story();
  for (const auto* actor : {"mission_client", "mapobjects_store"})
    EXPECT_EQ(look_at(actor).phase, child_phase::absent) << actor;
  for (const auto* actor : {"vehicle_link", "failsafe", "executor", "ground_port"})
    EXPECT_EQ(look_at(actor).phase, child_phase::running) << actor;
  ASSERT_NO_FATAL_FAILURE(land());
  for (const auto* actor : {"mission_client", "mapobjects_store"})
    EXPECT_EQ(look_at(actor).phase, child_phase::running) << actor << flight.story();
  EXPECT_TRUE(fly_with_help(flight)) << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
}

} // namespace supervision_test
