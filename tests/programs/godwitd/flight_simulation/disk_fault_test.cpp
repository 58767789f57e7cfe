// The journal's disk fails in flight: for a while, for good, or because there is no room. The flight goes on, a stop
// goes out, nothing crashes, and what was told to the service is neither lost nor doubled.
#include <gtest/gtest.h>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"

namespace disk_fault_test {

using namespace godwit;
using namespace godwit::drill;
using executor::phase;
using mission::progress_kind;

constexpr std::array faulted_actors{"executor",    "failsafe",       "vehicle_link",
                                    "ground_port", "mission_client", "mapobjects_store"};

enum class fault { fails, full };

struct disk_case {
  sim::personality who;
  fault what;
};

class disk_fault : public testing::TestWithParam<disk_case> {
protected:
  flight_simulation flight{{.who = GetParam().who}};

  void fly_past(const std::string& item) {
    const auto has_been_there = [&] {
      for (const auto& each : flight.reports())
        if (each.kind == progress_kind::reached && each.item_id == item)
          return true;
      return false;
    };
    ASSERT_TRUE(flight.run_until(has_been_there, 120)) << flight.story();
  }
  void set_fault(bool is_there) {
    if (GetParam().what == fault::fails)
      flight.process()->fail_journal(is_there);
    else
      flight.process()->fill_journal(is_there);
  }
  void expect_no_crash() {
    EXPECT_EQ(flight.processes(), 1) << flight.story();
    for (const auto* each : faulted_actors)
      EXPECT_EQ(flight.process()->crashes(each), 0U) << each << "\n" << flight.story();
  }
};

TEST_P(disk_fault, of_ten_seconds_in_flight_loses_and_doubles_nothing) {
  fly_past("w1");
  set_fault(true);
  flight.run_for(10);
  expect_no_crash();
  set_fault(false);
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
  expect_no_crash();
}

TEST_P(disk_fault, does_not_keep_the_vehicle_from_being_held) {
  fly_past("w1");
  set_fault(true);
  flight.run_for(1);
  const auto since_ns = flight.now_ns();
  flight.say(operators::command_kind::pause);
  EXPECT_TRUE(flight.run_until_phase(phase::paused, 10)) << flight.story();
  EXPECT_EQ(flight.status().cause, executor::pause_cause::asked) << flight.story();
  EXPECT_GE(moves_since(flight, since_ns), 1) << flight.story();
  expect_no_crash();
  flight.run_for(0.1);
  const auto held_ns = flight.now_ns();
  flight.say(operators::command_kind::resume);
  flight.run_for(10);
  EXPECT_EQ(moves_since(flight, held_ns), 0) << "to go on waits for the disk\n" << flight.story();
  set_fault(false);
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
}

TEST_P(disk_fault, leaves_a_pause_the_last_word_after_a_resume_that_waited) {
  fly_past("w1");
  flight.say(operators::command_kind::pause);
  EXPECT_TRUE(flight.run_until_phase(phase::paused, 10)) << flight.story();
  flight.run_for(1);
  set_fault(true);
  const auto held_ns = flight.now_ns();
  flight.say(operators::command_kind::resume);
  flight.run_for(0.5);
  flight.say(operators::command_kind::pause);
  flight.run_for(1);
  set_fault(false);
  flight.run_for(10);
  EXPECT_EQ(flight.status().cause, executor::pause_cause::asked) << flight.story();
  EXPECT_LE(moves_since(flight, held_ns), 1) << "nothing but the hold\n" << flight.story();
  flight.say(operators::command_kind::resume);
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
  expect_no_crash();
}

TEST_P(disk_fault, for_good_ends_nothing_and_the_plan_is_flown_to_its_end) {
  fly_past("w1");
  set_fault(true);
  EXPECT_TRUE(flight.run_until_phase(phase::post_flight, 120)) << flight.story();
  flight.run_for(60);
  expect_no_crash();
  if (GetParam().what == fault::full) {
    EXPECT_EQ(flight.process()->health("failsafe"), runtime::health_colour::red);
  }
}

// Who resumed has gone home meanwhile: nobody expects the vehicle to move.
TEST_P(disk_fault, after_which_it_writes_again_after_a_while_sends_nothing_that_is_late) {
  fly_past("w1");
  flight.say(operators::command_kind::pause);
  ASSERT_TRUE(flight.run_until_phase(phase::paused, 10)) << flight.story();
  set_fault(true);
  flight.say(operators::command_kind::resume);
  flight.run_for(60);
  flight.switch_mode(pilot_mode(GetParam().who));
  flight.run_for(5);
  const auto since_ns = flight.now_ns();
  set_fault(false);
  flight.run_for(20);
  EXPECT_EQ(moves_since(flight, since_ns), 0) << flight.story();
  expect_no_crash();
}

INSTANTIATE_TEST_SUITE_P(
    every_vehicle, disk_fault,
    testing::Values(disk_case{sim::personality::rover, fault::fails}, disk_case{sim::personality::rover, fault::full},
                    disk_case{sim::personality::px4, fault::fails}, disk_case{sim::personality::px4, fault::full},
                    disk_case{sim::personality::ardupilot, fault::fails},
                    disk_case{sim::personality::ardupilot, fault::full},
                    disk_case{sim::personality::plane, fault::fails}, disk_case{sim::personality::plane, fault::full}),
    [](const auto& each) {
      return std::string(io::name_of(each.param.who)) + (each.param.what == fault::full ? "_full" : "_fails");
    });

} // namespace disk_fault_test
