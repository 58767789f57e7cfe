// The phases of a flight: which trigger leads from which phase to which, and under which guard.
//
// Phases stand in sets (the namespace of the table): on the ground, on the way, in the flight with its pauses, over. A
// row begins in the sets or phases from which its trigger can come. A trigger that the table has no row for in the
// phase in which the flight stands is a defect, and throws: the actor starts again and looks at the vehicle. What takes
// the vehicle away from godwit has a row in each phase, and nothing else has. The first row that fits counts. The table
// is the same for all classes of vehicles; how each starts and ends is in vehicle_steps.hpp and flight_end.hpp. Thread:
// constants; the machine one at a time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "actors/executor/flight/flight_context.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::executor {

enum class trigger {
  // on the ground
  link_lost,
  link_found,
  mission_changed, // another mission, revision or assignment; or none any more
  prepare_again,   // resume on the ground
  checks_begun,
  checks_passed,
  rest_refused, // what is left of a mission that was begun can not be flown from where the vehicle stands
  plan_brought,
  plan_brought_held, // in flight, and it was held before
  start_waits,       // a person has to start, or to disarm what stands armed
  start_begun,
  start_refused, // for now: it is tried again
  start_failed,
  start_stopped, // by a command, before the vehicle moved
  started,
  found_started, // our plan is flown, and this incarnation has not started it
  // in flight
  plan_done,
  told_to_hold,
  held,
  resumed,
  called_home,
  called_home_by_plan, // it holds first
  not_obeyed,
  task_failed,
  // who has the vehicle
  person_took_over,
  person_acts_on_ground, // through a station, and nothing of ours flies: what was prepared stays so
  failsafe_acts,
  autopilot_failsafe_acts,
  handed_back,
  foreign_plan_found,
  infeasible_plan_found, // ours
  autopilot_restarted,
  // after a restart of the executor
  restarted_on_ground,
  replan_left_open,
  found_held,
  found_on_its_way,
  found_in_flight,
  // the end
  flight_ended,
  mission_ended,
  delivered
};

GODWIT_ENUM_NAMES(trigger, link_lost, link_found, mission_changed, prepare_again, checks_begun, checks_passed,
                  rest_refused, plan_brought, plan_brought_held, start_waits, start_begun, start_refused, start_failed,
                  start_stopped, started, found_started, plan_done, told_to_hold, held, resumed, called_home,
                  called_home_by_plan, not_obeyed, task_failed, person_took_over, person_acts_on_ground, failsafe_acts,
                  autopilot_failsafe_acts, handed_back, foreign_plan_found, infeasible_plan_found, autopilot_restarted,
                  restarted_on_ground, replan_left_open, found_held, found_on_its_way, found_in_flight, flight_ended,
                  mission_ended, delivered);

inline constexpr std::size_t phase_count = static_cast<std::size_t>(phase::aborted) + 1;

// A set of phases, as bits.
using phase_set = std::uint32_t;

// What becomes of the durable `in_flight`.
enum class flight_bit { as_before, yes, no, if_moving, if_in_air };

// What becomes of the cause: that of the row; as it was; as it was if it needs a hand-back, else none.
enum class cause_rule { of_row, kept, kept_if_person };

struct transition {
  trigger on = trigger::link_lost;
  phase_set from = 0;
  std::string_view guard; // the name of `holds`; empty: none
  bool (*holds)(const flight_context&) = nullptr;
  std::optional<phase> next; // none: the phase stays
  pause_cause cause = pause_cause::none;
  flight_bit in_flight = flight_bit::as_before;
  cause_rule rule = cause_rule::of_row;
  std::string_view reason; // sentence for people, where the caller has none
};

[[nodiscard]] std::span<const transition> phase_table();
[[nodiscard]] constexpr bool has(phase_set all, phase one) { return (all >> static_cast<unsigned>(one) & 1U) != 0; }

// The only writer of the phase.
class phase_machine {
public:
  explicit phase_machine(const flight_context& flight);

  // Notes where the flight stands from now on, when that is another status. REASON: sentence for people; empty: that
  // of the row. Throws std::logic_error where the table has no row.
  void go(effects& out, trigger what, const std::string& reason = {});

  // So often each row was taken, in the order of the table; and by which phase.
  using counts = std::array<std::uint32_t, phase_count>;
  [[nodiscard]] const std::vector<counts>& taken() const { return taken_; }

private:
  const flight_context& flight_;
  std::vector<counts> taken_;
};

} // namespace godwit::executor
