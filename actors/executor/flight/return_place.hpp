// Where a return leads: to the home that the vehicle had at the first take-off of the mission.
//
//   first take-off     the vehicle's home is kept; until the flight has ended it is wherever the vehicle says
//   each later one     it is set again: ArduPilot by an item of the plan, others by a command before they are armed
//     in flight        HOME_POSITION says so within 3 s, or the vehicle holds and people are told where returns lead
//   end of the mission home that was set by a command is freed: arming moves it again
//
// Autopilots set home where they are armed, so behind a landing on the way a return would lead to the customer. Pure.
// Thread: one at a time. Source: MAV_CMD_DO_SET_HOME; ArduPilot's locks home until it starts again when it is a
// command, and not when it is an item.
#pragma once

#include <cstdint>

#include "actors/executor/flight/flight_context.hpp"
#include "actors/executor/flight/task_control.hpp"

namespace godwit::executor {

// Requests for HOME_POSITION have numbers of their own, and nobody waits for their answers.
inline constexpr std::uint64_t first_home_request = 1ULL << 36U;

class return_place {
public:
  static constexpr std::int64_t told_within_ns = 3'000'000'000;
  static constexpr std::int64_t asked_each_ns = 500'000'000;

  return_place(flight_context& flight, task_control& tasks) : flight_(flight), tasks_(tasks) {}

  // The vehicle has told its home.
  [[nodiscard]] effects on_home();
  // True: the rest waits.
  [[nodiscard]] bool advance(effects& out, instant now);

private:
  [[nodiscard]] bool keep(effects& out) const;
  void look(effects& out, instant now);
  [[nodiscard]] bool free_home(effects& out);
  void tell(effects& out);

  flight_context& flight_;
  task_control& tasks_;
  std::int64_t since_ns_ = 0; // in flight, as far as this incarnation knows; 0: it is not
  std::int64_t asked_ns_ = 0;
  std::uint64_t last_request_ = first_home_request;
  bool is_told_ = false; // that it leads elsewhere
};

} // namespace godwit::executor
