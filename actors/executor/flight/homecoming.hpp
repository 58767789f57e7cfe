// come-home: straight where no fence lies in the way, and else around the fences, by a plan of its own.
//
//   come-home ──> holding ──> held ──> bringing ──> on the way home
//       │            │          │          │
//       └────────────┴──────────┴──────────┴──> the autopilot's return, which is straight
//
//   at once      no fence lies in the way, or there is no way around it
//   from there   a step failed, or it is not flown 5 s after the command (30 s where it could only hold instead)
//   both         the battery is low, or it is not known where the vehicle is
//
// It holds in the turn in which the command is given. The way begins where the vehicle holds, at the altitude that it
// has or at that of a return, and ends with the autopilot's own return, which lands; a rover is told to hold at home.
// The plan is a generation of its own, and no item of the mission belongs to it: what is reached on it is no progress,
// and the mission is over. A command that comes later takes its place; come-home said again changes nothing.
//
// Where the vehicle's own return leads elsewhere than to the home of the mission (return_place.hpp), the plan lands
// there, also on a straight way and with a low battery; where no plan is flown it holds, but for the failsafe, which
// has it return all the same. Pure. Thread: one at a time.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "actors/executor/flight/task_control.hpp"

namespace godwit::executor {

class homecoming {
public:
  static constexpr std::int64_t flown_within_ns = 5'000'000'000;
  // Where it could only hold otherwise: an ArduPilot whose upload was given up takes no other for 8 s.
  static constexpr std::int64_t flown_elsewhere_within_ns = 30'000'000'000;

  homecoming(flight_context& flight, phase_machine& phases, task_control& tasks)
      : flight_(flight), phases_(phases), tasks_(tasks) {}

  // The command.
  void begin(effects& out, instant now);
  // The failsafe has a return flown by a plan: it is told whether that is done.
  void answer_failsafe(effects& out, bool has_looked, instant now);
  // To be asked before any other word. True: it is seen to, and the rest waits.
  [[nodiscard]] bool advance(effects& out, instant now);
  [[nodiscard]] std::int64_t next_deadline_ns() const;

private:
  using turns_or_why = tl::expected<std::vector<mission::waypoint>, std::string>;

  // None: it may fly straight. The error: it has to, though a fence may lie there.
  [[nodiscard]] turns_or_why turns(instant now) const;
  [[nodiscard]] std::int64_t time_for_plan_ns() const;
  [[nodiscard]] bool is_battery_low() const;
  [[nodiscard]] std::string why_not_for_failsafe(instant now) const;
  [[nodiscard]] bool is_coming_home() const; // by a plan
  [[nodiscard]] std::string why_not_by_plan(instant now) const;
  void begin_return(effects& out);
  void hold_instead(effects& out, const std::string& why);
  [[nodiscard]] std::optional<mission::position> home() const; // above the mission's zero
  void begin_straight(effects& out, const std::string& why);
  void bring(effects& out, const std::vector<mission::waypoint>& turns, instant now);
  [[nodiscard]] bool go_on(effects& out, instant now);
  [[nodiscard]] bool stop_at_home(effects& out, instant now);

  flight_context& flight_;
  phase_machine& phases_;
  task_control& tasks_;
  std::uint64_t answered_ = 0;   // the last request of the failsafe
  bool is_for_failsafe_ = false; // better home to where the vehicle's return leads than not at all
  std::uint32_t stopped_in_ = 0; // the generation at whose end a rover was told to hold
};

} // namespace godwit::executor
