// Who has the vehicle, watched from a start to the end of the flight: what takes it from godwit, and what gives it
// back.
//
// A person is one whom either of the two watches has seen, ours or the failsafe's; while it is unclear who has the
// vehicle nothing is sent. Pure. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/executor/flight/task_control.hpp"
#include "messages/executor/station_act.hpp"

namespace godwit::executor {

class control_watch {
public:
  control_watch(flight_context& flight, phase_machine& phases, task_control& tasks)
      : flight_(flight), phases_(phases), tasks_(tasks) {}

  // Of the vehicle, when it has reported its mode (HEARTBEAT), its mode and the one that was asked for last
  // (CURRENT_MODE), or its place in the plan.
  void on_mode(instant now);
  void on_current_mode(std::uint32_t intended, instant now);
  void on_place(instant now);
  // Somebody else acts on the vehicle, as its line shows.
  void on_foreign(const vehicle_link::foreign_act& m);

  // godwit starts the vehicle, and has it from here on.
  void begin_start(effects& out);
  // A new incarnation. LEFT_IN: the modes in which godwit may have left the vehicle.
  void resume(std::vector<std::uint32_t> left_in, instant now);
  void end_flight();
  // A new incarnation finds the start of the one before in a person's mode.
  void find_taken(effects& out);

  // True: somebody else has just got it, or it is unclear who has it.
  [[nodiscard]] bool check_authority(effects& out, instant now);
  // A start has ended before its ARM was heard obeyed. Where it shows at once the vehicle is disarmed; after a silence
  // or a restart nobody can tell whose it is by then: it is told, and nothing is sent.
  void look_at_left_armed(effects& out, instant now);
  // A station's own message has made it its person's.
  void give_to_station(effects& out, const station_act& m);
  // A start or resume by this station hands it back, and the vehicle is heard.
  [[nodiscard]] bool may_hand_back(const station& by) const;
  // An operator has handed it back. True: what follows from it is noted.
  [[nodiscard]] bool take_back(effects& out);

private:
  void know_plan_end(); // of the plan that was accepted last
  [[nodiscard]] bool judges_modes() const;
  void judge_mode(instant now);
  void judge_place(instant now);
  [[nodiscard]] bool judge_holder(effects& out);
  [[nodiscard]] std::string who_has_it() const;
  [[nodiscard]] std::string in_its_mode() const;       // the end of a sentence about who has the vehicle
  void drop_all(effects& out, const std::string& why); // what is under way, and what is wanted
  [[nodiscard]] std::string left_armed() const;
  void yield(effects& out, trigger to, const std::string& reason);
  void report_taken_over(effects& out);

  flight_context& flight_;
  phase_machine& phases_;
  task_control& tasks_;
  std::optional<std::uint32_t> known_end_;   // the generation whose end the authority knows
  bool was_armed_ = false;                   // in the start that is under way
  bool is_close_ = false;                    // the vehicle is watched closely, for a start
  bool disarms_ = false;                     // what somebody else has commanded; no heartbeat shows it yet
  std::optional<std::string> reason_before_; // of the pause, in which the vehicle was found armed
  std::string who_acts_;                     // the one whose command the vehicle obeys; empty: its mode alone shows it
};

} // namespace godwit::executor
