// Flies the items of a mission: begins each, executes the commands beside it, says when it is done.
//
// What a step says is in the order in which a ground station must hear it:
//
//   item_begun, [item_skipped]      when an item begins; skipped is the item itself
//   [command_executed, item_skipped ...]  the commands after the item before; skipped: it is of no use here
//   [took_off, landed]              said by flight, while the body moves
//   [pictured ...]                  each so many metres, while a trigger by distance is on
//   item_reached                    after the hold
//   [item_skipped ...]              commands that their CONDITION_DELAY has held back until now
//   item_begun of the next | mission_completed
//
// The commands after an item begin when it is reached, and what a delay or a distance among them holds back runs on the
// way to the next. Thread: one
// at a time. Source: seen of ArduCopter 4.7.0-dev and PX4 1.18.0-beta1.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/mavlink/messages/mission_transfer.hpp"
#include "programs/godwit-sim/vehicle/flight/craft.hpp"
#include "programs/godwit-sim/vehicle/flight/maneuver.hpp"
#include "programs/godwit-sim/vehicle/flight/mission_run.hpp"
#include "programs/godwit-sim/vehicle/world/position.hpp"

namespace godwit::sim {

// The DO commands of a mission that change something here. Thread: pure.

// DO_CHANGE_SPEED changes HOW_FAST, DO_SET_HOME changes HOME; jumps, delays, marks, cameras, servos and the like leave
// all as it is. The answer, if any, says why it was of no use.
[[nodiscard]] std::optional<std::string> execute_command(const io::mavlink::mission_item_int& command,
                                                         const craft& what, const position& here, pace& how_fast,
                                                         position& home);

// What happens on the way, for who tells the ground about it. Thread: values.
struct took_off {};
struct landed {};   // touched the ground
struct arrived {};  // a `go`, a `climb` or a rover's `come_back` is done
struct item_begun { // the current item is a new one
  int sequence = 0;
};
struct item_reached { // a NAV item is done; before the next one begins
  int sequence = 0;
};
struct item_skipped { // it is of no use here: an unknown DO command, a NAV command that this craft can not do
  int sequence = 0;
  std::string reason; // for a STATUSTEXT
};
struct command_executed { // one that is no NAV item
  int sequence = 0;
};
struct pictured {}; // the camera was triggered
struct load_moved { // half a second after a DO_GRIPPER
  bool is_released = true;
};
struct mission_completed {};
using happening = std::variant<took_off, landed, arrived, item_begun, item_reached, item_skipped, command_executed,
                               pictured, load_moved, mission_completed>;
using happenings = std::vector<happening>;

class mission_pilot {
public:
  explicit mission_pilot(const craft& what) : how_fast_(own_pace(what)) {}

  [[nodiscard]] mission_run& run() { return run_; }
  [[nodiscard]] const mission_run& run() const { return run_; }

  // A camera that is triggered by distance goes on in other modes and in other missions (ArduPilot). Else it stops with
  // the mission (PX4).
  void keep_trigger() { keeps_trigger_ = true; }
  // A command beside the mission: until the mission changes it, or is entered again.
  void change_speed(double speed_mps) { how_fast_.speed_mps = speed_mps; }
  // Nothing: none, or forgotten as the mission was entered again (ArduPilot: ModeAuto::init, auto_yaw and AP_Mount).
  [[nodiscard]] const std::optional<position>& region_of_interest() const { return region_; }
  void look_at(const std::optional<position>& where) { region_ = where; }
  // Outside of its mission it has moved to HERE.
  void moved_otherwise(const position& here, happenings& said);

  // The vehicle is somewhere else and comes back to the mission: the current item goes on, from its first leg.
  void resume();
  // One step: begins what is new, moves the vehicle.
  void step(mover& vehicle, position& home, double step_s, happenings& said);
  // After the step: whether the item is done, and what then is the next one.
  void settle(const mover& vehicle, position& home, happenings& said);
  // The next step would change nothing but the vehicle's motion.
  [[nodiscard]] bool is_settled() const;

private:
  void begin(const mover& vehicle, position& home, happenings& said);
  void go_on(const mover& vehicle, const position& home, happenings& said);
  bool begin_nav(const mover& vehicle, position& home, happenings& said);
  bool plan(const mover& vehicle, const position& home, happenings& said);
  void execute_next(const mover& vehicle, position& home, happenings& said);
  void execute_due(const mover& vehicle, position& home, happenings& said);
  void execute_all(const mover& vehicle, position& home, happenings& said);
  void drop_late(happenings& said);
  [[nodiscard]] bool are_held_back(const mover& vehicle, const position& home) const;
  void queue_commands();
  void execute(const io::mavlink::mission_item_int& command, const position& here, happenings& said);
  void move_load(double step_s, happenings& said);
  void trigger(const position& here, happenings& said);

  mission_run run_;
  maneuver maneuver_;
  pace how_fast_;
  position here_; // where the current item began
  std::optional<position> region_;
  bool keeps_trigger_ = false;
  double trigger_m_ = 0; // of the camera; 0: it is off
  position pictured_at_;
  double load_wait_s_ = 0; // a gripper is moving
  bool is_released_ = true;
  // The commands after the item before that are still to be executed, by sequence, and how long they wait. No more
  // than the plan has, for each jump in a row.
  std::deque<int> commands_;
  double commands_wait_s_ = 0;
  double commands_wait_m_ = 0; // until the place to which it flies is as near; 0: not
  bool hovers_ = true;         // a VTOL: its mission wants it on its rotors
  bool is_interrupted_ = false;
  std::uint64_t seen_changes_ = 0;
  std::uint64_t seen_starts_ = 0;
};

} // namespace godwit::sim
