// The end of a flight: when the vehicle is down, what that means for the mission, and that it is left in a mode in
// which it is safe to arm. Pure. Thread: one at a time.
#pragma once

#include <cstdint>
#include <string>

#include "actors/executor/flight/watches/control_watch.hpp"

namespace godwit::executor {

class flight_end {
public:
  flight_end(flight_context& flight, phase_machine& phases, task_control& tasks, control_watch& watch)
      : flight_(flight), phases_(phases), tasks_(tasks), watch_(watch) {}

  // Of the vehicle, when it has told its mode.
  void on_heartbeat(instant now);
  [[nodiscard]] bool end_flight(effects& out, instant now);
  // A person has said that it is over.
  [[nodiscard]] bool end_by_person(effects& out, instant now);
  // Whoever arms a vehicle that stands in its mission mode is run over: PX4 goes back into it when it disarms,
  // ArduPilot stays in it. The only thing that is sent to a vehicle that somebody else has, and never while it is
  // armed. An ArduPilot's rover stays armed in it after its last item: when the mission is over, and nobody else has
  // the vehicle, it is told to hold.
  [[nodiscard]] bool leave_mission_mode(effects& out, instant now);

private:
  // Disarmed, or down after the end of the plan; a rover: at the end of its plan.
  [[nodiscard]] bool is_down(instant now) const;
  // What a Copter and PX4 do not say: that the landing, or the return, with which the plan ends is done.
  [[nodiscard]] bool was_brought_down(instant now) const;
  [[nodiscard]] bool end_late(effects& out);
  [[nodiscard]] bool hold_where_mission_ended(effects& out);
  void close(effects& out);
  void end_mission(effects& out, const std::string& why = {});
  [[nodiscard]] std::string who_keeps_it() const; // after the flight

  flight_context& flight_;
  phase_machine& phases_;
  task_control& tasks_;
  control_watch& watch_;
  std::int64_t down_since_ns_ = 0;     // 0: it is not
  std::int64_t disarmed_since_ns_ = 0; // 0: it is armed
  bool has_stood_by_ = false;          // tried, since it was armed last
  bool was_told_to_hold_ = false;      // after the end of this mission
  bool was_put_there_ = false;         // in its mission mode, since it was armed last
};

} // namespace godwit::executor
