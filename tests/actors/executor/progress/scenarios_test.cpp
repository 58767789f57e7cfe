// A mission A -> B, the vehicle between them, and the service replaces B by Z. Whether the assignment comes before or
// after B is reached can be told from the reports alone, although B and Z have the same index.
#include <gtest/gtest.h>

#include "tests/actors/executor/progress/progress_fixture.hpp"

namespace godwit::executor::progress {
namespace scenarios_test {

using namespace test;

const assignment_key key{"assignment", "key"};

struct assignment_in_flight : testing::TestWithParam<flavour> {
  void fly_towards_b() {
    d.fly({"A", "B"});
    d.reached(0);
    d.current(1);
    d.wait_s(3);
    EXPECT_EQ(d.said(), (texts{"started A#0 g1", "reached A#0 g1", "started B#1 g1"}));
  }
  // As each vehicle needs it: PX4 begins the new plan itself, the others are sent to its first item.
  void replace_b_by_z() {
    d.upload(map_of(d.vehicle, {"Z"}, 1), 2, key);
    if (d.vehicle.goes_on) {
      d.current(0);
      return;
    }
    d.current(0, mission_state::not_started);
    d.start_at(0);
    d.started();
    d.current(0);
  }
  [[nodiscard]] std::string newest() const { return " g" + std::to_string(d.s.last_generation); }

  progress_fixture d{GetParam()};
};

TEST_P(assignment_in_flight, before_b_is_reached_only_z_is_reported_reached) {
  fly_towards_b();
  replace_b_by_z();
  d.wait_s(3);
  d.reached(0);
  EXPECT_EQ(d.said(), (texts{"started Z#1" + newest(), "reached Z#1" + newest(), "complete" + newest()}));
  EXPECT_EQ(text_of(*d.answers.at(0).response.last_progress), "started B#1 g1");
}

TEST_P(assignment_in_flight, after_b_is_reached_both_are_reported_and_told_apart_by_id_revision_and_generation) {
  fly_towards_b();
  d.reached(1);
  EXPECT_EQ(d.said(), (texts{"reached B#1 g1", "complete g1"}));
  replace_b_by_z();
  d.wait_s(3);
  d.reached(0);
  EXPECT_EQ(d.said(), (texts{"started Z#1" + newest(), "reached Z#1" + newest(), "complete" + newest()}));
  EXPECT_EQ(text_of(*d.answers.at(0).response.last_progress), "complete g1");
  EXPECT_EQ(d.reports.at(3).revision, 1);
  EXPECT_EQ(d.reports.back().revision, 2);
}

TEST_P(assignment_in_flight, after_b_is_reached_and_with_more_of_the_mission_after_it) {
  d.fly({"A", "B", "C"});
  d.reached(0);
  d.current(1);
  d.wait_s(3);
  d.reached(1);
  d.current(2);
  d.said();
  d.upload(map_of(d.vehicle, {"Z"}, 2), 2, key);
  EXPECT_EQ(text_of(*d.answers.at(0).response.last_progress), "started C#2 g1");
  EXPECT_EQ(d.answers.at(0).response.generation, 2U);
  EXPECT_EQ(d.answers.at(0).response.outcome, mission::assignment_outcome::accepted);
  EXPECT_EQ(d.answers.at(0).response.idempotency_key, "key");
  EXPECT_EQ(d.answers.at(0).assignment_id, "assignment");
}

TEST_P(assignment_in_flight, what_comes_late_of_the_old_plan_changes_nothing) {
  fly_towards_b();
  const auto late = d.current_message(1);
  replace_b_by_z();
  d.said();
  d.say(late);
  d.reached(1);
  d.reached(0);
  EXPECT_EQ(d.said(), texts{});
  d.wait_s(3);
  d.current(0, mission_state::complete); // the REACHED of Z itself was lost
  d.wait_s(1);
  d.current(0, mission_state::complete);
  EXPECT_EQ(d.said(), (texts{"reached Z#1" + newest() + " inferred", "complete" + newest() + " inferred"}));
}

TEST_P(assignment_in_flight, a_crash_after_each_event_changes_nothing) {
  auto play = [](progress_fixture& each, bool crashes) {
    const auto next = [&] {
      if (crashes)
        each.crash();
    };
    each.upload({"A", "B"});
    next();
    each.current(0);
    next();
    each.wait_s(3);
    each.reached(0);
    next();
    each.current(1);
    next();
    each.intend(map_of(each.vehicle, {"Z"}, 1), 2, key);
    next();
    each.accept();
    next();
    each.current(0);
    next();
    each.wait_s(3);
    each.reached(0);
    next();
    return each.reports;
  };
  progress_fixture calm(GetParam());
  progress_fixture crashing(GetParam());
  EXPECT_EQ(play(calm, false), play(crashing, true));
  EXPECT_EQ(text_of(calm.reports.back()), "complete g2");
}

INSTANTIATE_TEST_SUITE_P(on, assignment_in_flight, testing::Values(px4, ardupilot, rover),
                         [](const auto& which) { return which.param.name; });

} // namespace scenarios_test
} // namespace godwit::executor::progress
