// Any sequence of what can be told to a run, on any plan, leaves it in order.
#include "programs/godwit-sim/vehicle/flight/mission_run.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/programs/godwit-sim/vehicle/flight/flight_fixture.hpp"

namespace godwit::sim::test {
namespace mission_run_property_test {

item any_item() {
  const auto kind = *rc::gen::inRange(0, 5);
  auto made = kind < 2    ? waypoint(1, 0)
              : kind == 2 ? command(201)
              : kind == 3 ? command(condition_delay, 1)
                          : jump_to(*rc::gen::inRange(-1, 9), *rc::gen::inRange(-1, 4));
  made.autocontinue = *rc::gen::inRange<std::uint8_t>(0, 4) == 0 ? 0 : 1;
  return made;
}

plan any_plan() {
  plan items(*rc::gen::inRange<std::size_t>(0, 8));
  for (auto& each : items)
    each = any_item();
  return items;
}

void check(const mission_run& run, int first_flown) {
  RC_ASSERT(run.current() >= first_flown);
  RC_ASSERT(run.current() < run.count() || run.is_empty());
  RC_ASSERT(run.state() == run_state::idle || !run.is_empty());
  RC_ASSERT((run.item() != nullptr) == (run.state() == run_state::running && !run.is_held()));
  RC_ASSERT(!run.is_held() || run.state() == run_state::running);
  if (run.item() != nullptr) {
    RC_ASSERT(run.item() == &run.items()[static_cast<std::size_t>(run.current())]);
    RC_ASSERT(run.commands_end() > run.current());
    RC_ASSERT(run.commands_end() <= run.count());
  }
}

void start(mission_run& run) {
  if (run.is_empty())
    return;
  const int first = *rc::gen::inRange(0, run.count());
  run.start(first, *rc::gen::arbitrary<bool>() ? -1 : *rc::gen::inRange(first, run.count()));
}

void set_current(mission_run& run, int first_flown) {
  const int sequence = *rc::gen::inRange(-2, 10);
  const auto changes = run.changes();
  const bool is_one = sequence >= first_flown && sequence < run.count();
  RC_ASSERT(run.set_current(sequence) == is_one);
  RC_ASSERT((is_one ? run.current() == sequence : run.changes() == changes));
}

void advance(mission_run& run) {
  const auto before = run.changes();
  const bool had_item = run.item() != nullptr;
  *rc::gen::arbitrary<bool>() ? run.advance() : run.skip();
  RC_ASSERT((had_item ? run.changes() != before || run.is_held() : run.changes() == before));
}

RC_GTEST_PROP(sim_mission_run, whatever_it_is_told_it_stays_in_range, ()) {
  mission_run run;
  int first_flown = 0;
  const int calls = *rc::gen::inRange(0, 40);
  for (int i = 0; i < calls; ++i) {
    switch (*rc::gen::inRange(0, 8)) {
    case 0:
      first_flown = *rc::gen::inRange(0, 2);
      run.load(any_plan(), first_flown);
      break;
    case 1:
      first_flown = *rc::gen::inRange(0, 2);
      run.replace(any_plan(), first_flown, *rc::gen::inRange(-2, 10));
      break;
    case 2:
      start(run);
      break;
    case 3:
      run.stop();
      break;
    case 4:
      set_current(run, first_flown);
      break;
    default:
      advance(run);
    }
    check(run, first_flown);
  }
}

// Items that take no time must not keep a run busy for ever.
RC_GTEST_PROP(sim_mission_run, when_nothing_is_flown_every_run_ends, ()) {
  mission_run run;
  run.load(any_plan());
  start(run);
  int items = 0;
  while (run.item() != nullptr) {
    run.skip();
    RC_ASSERT(++items <= run.count() * (mission_run::max_jumps_in_a_row + 1));
  }
}

} // namespace mission_run_property_test
} // namespace godwit::sim::test
