// What is wanted of the flight and not begun yet: at most one command of each kind, the highest first.
//
//   halt           hold, or come home: gives up what is under way
//   hand_back      an operator gives the vehicle back to godwit
//   finish_replan  an incarnation before has held the vehicle to replace its plan, and died
//   guard_again    the failsafe may not know the limits of the plan that is flown
//   bring_return_anew   the plan that is flown ends with a return, and that would lead elsewhere
//   set_current_item    the vehicle holds the plan, and is elsewhere in it
//   change         go to, cancel, insert
//   go_on          resume
//   start          a ground station's, or an operator's
//   new_run        a start after the end of the mission: it is prepared again
//
// The last of halt, change and go_on counts: one takes the place of the others. Thread: plain values.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "actors/executor/state.hpp"
#include "messages/executor/types.hpp"

namespace godwit::executor {

struct plan_change {
  change_kind kind = change_kind::go_to;
  std::optional<std::string> after_item_id; // absent: in front of all items
  std::vector<mission::item> items;
  std::vector<mission::item> set_aside;
  std::optional<mission::position> to; // go_to
  bool leads_around = false;           // its way begins where the vehicle holds
  bool is_held_for = false;            // the vehicle was told to hold first
  std::int64_t held_since_ns = 0;      // 0: it was not seen to hold yet
  std::int64_t said_ns = 0;            // monotonic
  std::string after;                   // insert: as it was commanded
};

struct start_flight {
  std::optional<start_mission> asked; // by a ground station, which waits for its answer
  bool has_taken_off = false;         // under that station, which gives the vehicle back in the air
  // Its station has put it in its mission mode and said arm: it is armed and started from here.
  std::optional<std::uint16_t> armed_from = {};
  std::int64_t part_until_ns = 0; // it waits for so long until its part of the plan is ready; 0: it does not
};

struct command_queue {
  std::optional<task_kind> halt; // hold or come_home
  std::string why_halt;          // where no operator has said it
  bool hand_back = false;
  bool finish_replan = false;
  bool guard_again = false;
  bool set_current_item = false;
  bool bring_return_anew = false; // home was moved: the rest of the plan leads to the mission's
  bool bring_back = false;        // the plan before, in the place of one that the vehicle can not fly
  std::optional<plan_change> change;
  bool go_on = false;
  std::optional<start_flight> start;
  bool new_run = false;
  bool end_flight = false; // a person ends it: its vehicle is not waited for any more

  void put_halt(task_kind what) {
    drop_words();
    halt = what;
  }
  void put_change(plan_change what) {
    drop_words();
    change = std::move(what);
  }
  void put_go_on() {
    drop_words();
    go_on = true;
  }
  // What was to be done to a flight that is over.
  void drop_all_of_flight() {
    finish_replan = false;
    guard_again = false;
    set_current_item = false;
    bring_return_anew = false;
    bring_back = false;
  }
  // Somebody else has the vehicle: all but a hand-back is void.
  void drop_all_after_takeover() {
    drop_words();
    finish_replan = false;
    bring_back = false;
    start.reset();
    new_run = false;
  }

private:
  void drop_words() {
    halt.reset();
    why_halt.clear();
    change.reset();
    go_on = false;
  }
};

} // namespace godwit::executor
