// The mission that the vehicle flies, and how far it is.
//
//            start()                 last item done
//   idle ──────────────> running ──────────────────────> completed
//    ^                    │  ^ start(): again from there      │
//    └── stop(), load() ──┘  └────────────────────────────────┘
//
// A completed one is idle again after load(), stop() and set_current(). Sequences are those of the plan as the vehicle
// keeps it; an ArduPilot's item 0 is home and is not flown. NAV commands (id <= 95) move; the DO and CONDITION commands
// between two NAV items are executed when the first of the two begins. Held, without moving on, after an item with
// autocontinue 0, when a NAV item follows; start() and set_current() go on from there. A DO_JUMP leads back as often as
// it says. A mission of DO commands alone completes at once. Pure: flight asks for the item to fly, and says when it
// was done. Thread: one at a time. Source: MAVLink mission protocol; MAV_CMD_DO_JUMP.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::sim {

enum class run_state { idle, running, completed };

[[nodiscard]] bool is_nav(const io::mavlink::mission_item_int& item);

class mission_run {
public:
  // The plan is another one now: idle, at its first item. FIRST_FLOWN: 1 where item 0 is home.
  void load(std::vector<io::mavlink::mission_item_int> items, int first_flown = 0);
  // How often each jump was taken is forgotten; load() does so, too. start() does not, but of a completed one.
  void forget_jumps() { jumps_taken_.clear(); }
  // A loop that was left counts anew when the run comes there again (ArduPilot).
  void count_left_loops_anew() { counts_anew_ = true; }
  // What is loaded changes under way and the run goes on at sequence CURRENT (a vehicle that replaces its plan in
  // flight), or at the first item where there is no such. A bound of the last start() is gone. Not running: as load(),
  // then set_current(). What jumps were taken is kept, by their sequences.
  void replace(std::vector<io::mavlink::mission_item_int> items, int first_flown, int current);

  // Both within the plan; FIRST may be home, and then means the first flown one; LAST < 0: to the end. From anywhere,
  // also while running.
  void start(int first, int last = -1);
  // Idle, at the current item.
  void stop();
  // Makes SEQUENCE the current one, running or not. Beyond the bound of start(), the bound is gone. False, and nothing
  // has changed: there is no such item.
  [[nodiscard]] bool set_current(int sequence);

  [[nodiscard]] run_state state() const { return state_; }
  [[nodiscard]] int current() const { return current_; }                      // the first flown one where there is none
  [[nodiscard]] int count() const { return static_cast<int>(items_.size()); } // home included
  [[nodiscard]] bool is_empty() const { return count() <= first_flown_; }
  [[nodiscard]] std::span<const io::mavlink::mission_item_int> items() const { return items_; }
  // The current one while running and not held.
  [[nodiscard]] const io::mavlink::mission_item_int* item() const;
  // Running, and waiting after an item with autocontinue 0.
  [[nodiscard]] bool is_held() const { return is_held_; }

  // flight: the current item is done. The next one is current; at the end, completed.
  void advance();
  // flight: the current item takes no time: it is a DO command, or one that the vehicle can not fly.
  void skip();
  // flight: the DO and CONDITION commands that belong to the current NAV item are those after it and before this one.
  [[nodiscard]] int commands_end() const;
  // flight: whether an item follows the current one, without a halt in between.
  [[nodiscard]] bool goes_on() const;
  // flight: differs after every change of the current item or of what it says, and after each start().
  [[nodiscard]] std::uint64_t changes() const { return changes_; }
  [[nodiscard]] std::uint64_t starts() const { return starts_; }

  // A jump that has been taken so often without a NAV item done in between is passed over: a plan that jumps in
  // circles would else never end.
  static constexpr int max_jumps_in_a_row = 16;

private:
  struct next_item {
    int to = -1;   // the sequence, or -1 at the end
    int jump = -1; // the sequence of the DO_JUMP that leads there
    bool pauses = false;
  };

  [[nodiscard]] next_item find_next() const;
  [[nodiscard]] bool has_nav_from(int sequence) const;
  [[nodiscard]] std::optional<int> jump_target(int sequence) const; // nothing: it is no jump, or is passed over
  [[nodiscard]] int end() const;                                    // after the last one to run
  void take(std::vector<io::mavlink::mission_item_int> items, int first_flown);
  void enter(int sequence);
  void count_jump(int sequence);
  [[nodiscard]] int taken(int jump) const;

  std::vector<io::mavlink::mission_item_int> items_;
  std::map<int, int> jumps_taken_; // by sequence
  bool counts_anew_ = false;
  int first_flown_ = 0;
  int current_ = 0;
  int last_ = -1;
  int jumps_in_a_row_ = 0;
  bool is_held_ = false;
  run_state state_ = run_state::idle;
  std::uint64_t changes_ = 0;
  std::uint64_t starts_ = 0;
};

} // namespace godwit::sim
