// Where a return leads: to the home that the vehicle had at the first take-off of the mission.
//
//   first take-off     the home that the vehicle tells after its arming is kept
//     moved before     the vehicle stood at its home when the plan was brought, and that lies elsewhere now: the one of
//                      before is kept
//   each later one     it is set again: ArduPilot by an item of the plan, others by a command before they are armed
//     in flight        HOME_POSITION says so within 3 s, or the vehicle holds and people are told where returns lead
//   moved in flight    by somebody: health is red, people are told, and returns lead to the kept one, by a plan
//   end of the mission home that was set by a command is freed: arming moves it again
//
// HOME_POSITION is asked for in flight where it does not come by itself. A plan that ends with the autopilot's return
// is brought anew, with a way to the kept home in its place; who returns already is called home by a plan.
//
// Autopilots set home where they are armed, so after a landing on the way a return would lead to the customer. Pure.
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
  static constexpr std::int64_t watched_each_ns =
      2'000'000'000; // it comes so often, by itself or because it is asked for
  static constexpr std::int64_t missed_after_ns = 5'000'000'000; // two in a row may be lost

  return_place(flight_context& flight, task_control& tasks) : flight_(flight), tasks_(tasks) {}

  // The vehicle has told its home.
  [[nodiscard]] effects on_home();
  // True: the rest waits.
  [[nodiscard]] bool advance(effects& out, instant now);

private:
  [[nodiscard]] bool keep(effects& out) const;
  void look(effects& out, instant now);
  void ask(effects& out, instant now, std::int64_t each_ns);
  void tell_moved(effects& out);
  void lead_back(effects& out);
  [[nodiscard]] bool returns_by_itself() const; // flies there now
  [[nodiscard]] bool free_home(effects& out);
  void tell(effects& out);

  flight_context& flight_;
  task_control& tasks_;
  std::int64_t since_ns_ = 0; // in flight, as far as this incarnation knows; 0: it is not
  std::int64_t asked_ns_ = 0;
  std::uint64_t last_request_ = first_home_request;
  bool is_told_ = false;         // that it leads elsewhere
  bool was_right_ = false;       // in this flight, as far as this incarnation knows
  bool is_led_back_ = false;     // a return that leads elsewhere was given up for a way home by a plan
  bool is_brought_anew_ = false; // a plan that ends with one was replaced
};

} // namespace godwit::executor
