// A station's start of a part of its plan: the part is prepared on the ground, or brought to the vehicle in flight.
//
//   on the ground   the part is the next mission ──checks, upload──> ready ──> the start goes on, within start_waits_ns
//   in flight       one task: upload, guard, on to the first item of the part
//
// A start that waits is not on the disk: a crash ends it, and nothing is started by whoever comes after. Pure. Thread:
// one at a time.
#pragma once

#include <cstdint>
#include <string>

#include "actors/executor/flight/flight_context.hpp"
#include "actors/executor/flight/task_control.hpp"
#include "actors/executor/station_part.hpp"

namespace godwit::executor {

// Shorter than a station's patience with its start (start_dedup::answer_patience_ns), by what the start itself takes.
inline constexpr std::int64_t start_waits_ns = 12'000'000'000;

class part_choice {
public:
  part_choice(flight_context& flight, task_control& tasks) : flight_(flight), tasks_(tasks) {}

  // The start that is wanted waits until its part is ready.
  [[nodiscard]] bool waits(instant now) const;
  // One that has waited for too long is answered, whatever is under way.
  void give_up_late(effects& out, instant now);
  // On the ground. True: WHAT is answered, or wanted again; else it goes on, and asks for what the vehicle has, with
  // item 0 for where that begins.
  [[nodiscard]] bool begin(effects& out, start_flight& what, instant now);
  // Of a flight under way. True: it is answered, or a task does it.
  [[nodiscard]] bool begin_in_flight(effects& out, const start_mission& asked, instant now);
  // Without another plan on the vehicle.
  [[nodiscard]] bool is_had_as_it_is(const start_mission& asked) const;

private:
  [[nodiscard]] bool is_ready() const;
  [[nodiscard]] bool is_of_plan(const start_mission& asked) const;
  [[nodiscard]] std::string why_not_changed() const;
  void prepare(effects& out, const station_plan_taken& part, start_flight what, instant now);
  bool refuse(effects& out, const start_mission& asked, start_verdict verdict, const std::string& why);

  flight_context& flight_;
  task_control& tasks_;
};

} // namespace godwit::executor
