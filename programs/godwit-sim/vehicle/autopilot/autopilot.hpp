// What an autopilot decides: arming, modes, commands, and what its mission does. The base of all personalities.
//
//                 arm            mode of the mission, start
//   disarmed ──────────> armed ─────────────────────────────> flies the mission ─┐
//      ^   the task of the mode <── another mode, completed ──┘                  │
//      └──── disarm, landed, battery ───────────────────────────────────────────┘
//
// The base knows what they share; where they differ, a derived class answers (rover, px4, copter, plane), or a trait
// does.
// It moves nothing itself: it gives `flight` a task and hears what happened. Each order gets exactly one answer, unless
// the autopilot is known to do otherwise. Thread: one at a time. Source: MAVLink command protocol, and recordings.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "actors/ground_port/mission_server/server.hpp"
#include "actors/ground_port/vehicle_role/current_report.hpp"
#include "actors/ground_port/vehicle_role/message_schedule.hpp"
#include "actors/ground_port/vehicle_role/order.hpp"
#include "programs/godwit-sim/vehicle/autopilot/names.hpp"
#include "programs/godwit-sim/vehicle/autopilot/telemetry.hpp"

namespace godwit::sim {

// What the autopilot sends by itself on one line: its streams and MISSION_CURRENT, each as often as was asked for on
// that line. World time. Thread: one at a time.
struct line_streams {
  role::message_schedule messages;
  role::current_report current;

  [[nodiscard]] std::int64_t next_due_ns() const { return std::min(messages.next_due_ns(), current.next_due_ns()); }
};

// A fault on demand: commands that the vehicle refuses, whatever it would have done. Thread: one at a time.
class refused_orders {
public:
  // TIMES below 0: from now on; 0: no longer. Bounded by the number of commands there are.
  void refuse(std::uint16_t command, std::uint8_t result, int times) {
    if (times == 0)
      refused_.erase(command);
    else
      refused_[command] = {result, times};
  }

  // The answer to COMMAND if it is refused this time.
  [[nodiscard]] std::optional<std::uint8_t> take(std::uint16_t command) {
    const auto found = refused_.find(command);
    if (found == refused_.end())
      return std::nullopt;
    const auto result = found->second.result;
    if (found->second.times > 0 && --found->second.times == 0)
      refused_.erase(found);
    return result;
  }

private:
  struct entry {
    std::uint8_t result = 0;
    int times = 0;
  };
  std::map<std::uint16_t, entry> refused_;
};

// What an autopilot works with. All of it outlives the autopilot.
struct equipment {
  const traits& vehicle_traits;
  flight& craft;
  plans::server& plans;
  outlet& out;
  telemetry& tells;
  std::vector<line_streams>& streams; // by line
  condition& state;
  std::mt19937_64& random;
};

class autopilot {
public:
  explicit autopilot(const equipment& with) : with_(with) {}
  autopilot(const autopilot&) = delete;
  autopilot& operator=(const autopilot&) = delete;
  virtual ~autopilot() = default;

  // Before anything else: what the time is.
  void set_now(const instant& now) { now_ = now; }

  // -- what comes in
  void take(const role::order& what);
  void take(mavlink::sender from, const mavlink::set_mode& m);
  virtual void take(const mavlink::mission_set_current& m) = 0;
  virtual void hear_sticks() {} // MANUAL_CONTROL
  virtual void hear_heartbeat(mavlink::sender from, const mavlink::heartbeat& m);
  // An item that is no part of a plan. True: it is flown to.
  [[nodiscard]] virtual bool fly_to(const role::order&) { return false; }
  // A station asks to begin an upload of a mission, which need not be granted.
  virtual void expect_upload() {}
  virtual void on_change(const plans::plan_change& what) = 0;
  // An upload that had begun to replace the mission did not come to its end.
  virtual void on_half_a_plan() {}
  virtual void on_happening(const happening& what) = 0;
  virtual void on_time() {}
  // World time.
  [[nodiscard]] virtual std::int64_t next_timer_ns() const { return never_ns; }
  // After everything that an event leads to has been sent.
  virtual void end_turn() {}

  // -- faults
  void lose_position(bool lost);
  void block(bool is_blocked) { with_.craft.block(is_blocked); }
  void empty_battery();
  // Plans that lead farther from home are none that it flies; 0: no limit.
  virtual void limit_distance(double /*metres*/) {}
  // Of a fence of its own, which is a circle: whatever it does then.
  virtual void breach_fence() {}
  void restart();
  [[nodiscard]] refused_orders& refusals() { return refusals_; }

  // -- what it shows
  [[nodiscard]] virtual mavlink::mission_current progress() const = 0;
  // True once after each command to start again.
  [[nodiscard]] bool take_restart_request() { return std::exchange(wants_restart_, false); }

protected:
  using answer = mavlink::mav_result;

  // -- what personalities decide

  // Why it can not be armed now; FORCED passes over what is a matter of safety. Nothing: it can.
  struct refusal {
    answer result{};
    mavlink::mav_severity severity{};
    std::string_view text;
  };
  [[nodiscard]] virtual std::optional<refusal> why_not_arm(bool forced) const = 0;
  [[nodiscard]] virtual std::optional<refusal> why_not_disarm(bool forced) const = 0;
  // By a command or a message; MODE is none where the number is not known. Changes it if it may.
  virtual answer change_mode(const flight_mode* mode, std::uint32_t number) = 0;
  [[nodiscard]] virtual std::uint32_t mode_in(const role::order& what) const;
  // Before it is looked at.
  virtual void on_mode_commanded(const role::order&) {}
  virtual void on_mode_left(const flight_mode&) {}
  virtual void on_mode_entered(const flight_mode&) {}
  // Asked when it is armed on the ground.
  [[nodiscard]] virtual bool may_move_home() const { return true; }
  virtual void on_armed() {}
  virtual void on_disarmed() {}
  virtual void on_position_lost() = 0;
  virtual void on_battery_empty() = 0;
  virtual void on_restart() {}

  // Commands that the personalities take in different ways.
  virtual answer start_mission(const role::order& what) = 0;
  virtual answer set_mission_current(const role::order& what) = 0;
  virtual answer take_off(const role::order& what) = 0;
  virtual answer land(const role::order&);
  virtual answer start_landing(const role::order&) { return answer::unsupported; }
  virtual answer reposition(const role::order& what) = 0;
  virtual answer pause_or_continue(const role::order& what) = 0;
  virtual answer restart_or_shut_down(const role::order& what) = 0;

  // -- what they have at hand

  void enter(const flight_mode& mode);
  void enter(mode_kind kind) { enter(mode_of_kind(with_.vehicle_traits.modes, kind)); }
  // By itself: what people have intended stays.
  void enter_by_failsafe(mode_kind kind);
  void arm();
  void disarm();
  // A vehicle that keeps its home as item 0 shows it there.
  void move_home(const position& where);
  // Gives the vehicle the task of the mode.
  void steer();
  void go_to(const position& where);
  void climb_to(double altitude_m);
  void hold_here() { with_.craft.set_task(task::hold{}); }
  // Above mean sea level; NaN: as high as it is.
  [[nodiscard]] virtual double altitude_in(const role::order& what) const;
  // The place that an order names; what is not a number stays as it is.
  [[nodiscard]] position place_in(const role::order& what) const;

  void say(mavlink::mav_severity severity, std::string_view text) { with_.out.say(severity, text); }
  [[nodiscard]] mission_run& run() { return with_.craft.mission(); }
  [[nodiscard]] const mission_run& run() const { return with_.craft.mission(); }
  [[nodiscard]] const condition& state() const { return with_.state; }
  [[nodiscard]] const traits& vehicle_traits() const { return with_.vehicle_traits; }
  [[nodiscard]] const flight& craft() const { return with_.craft; }
  [[nodiscard]] const instant& now() const { return now_; }
  [[nodiscard]] const equipment& with() const { return with_; }
  [[nodiscard]] const plans::held_plan& held_mission() const {
    return with_.plans.plan(mavlink::mav_mission_type::mission);
  }
  [[nodiscard]] bool flies_mission() const {
    return state().is_armed && state().is_in(mode_kind::mission) && run().state() == run_state::running;
  }
  // Of the line on which the frame came that is handled.
  [[nodiscard]] line_streams& streams() { return with_.streams[with_.out.line_of_event()]; }
  [[nodiscard]] outlet::aimed aim_back() { return with_.out.aim(with_.out.line_of_event()); }
  // Where its autopilot sends it: on the line of who asked, or wherever it was heard.
  void acknowledge(const role::order& what, answer result);
  void ask_for_restart() { wants_restart_ = true; }
  // A message that goes out after the answer to the order that is being executed.
  void owe(std::uint32_t message) { owed_message_ = message; }

private:
  using handler = answer (autopilot::*)(const role::order&);
  struct row {
    std::uint16_t command;
    handler handle;
  };
  [[nodiscard]] static handler handler_for(std::uint16_t command);
  [[nodiscard]] answer execute(const role::order& what);

  // orders.cpp
  answer arm_or_disarm(const role::order& what);
  answer set_mode(const role::order& what);
  answer return_home(const role::order& what);
  answer loiter(const role::order& what);
  answer change_speed(const role::order& what);
  answer look_at(const role::order& what);
  answer set_home(const role::order& what);
  answer request_message(const role::order& what);
  answer set_message_interval(const role::order& what);
  answer get_message_interval(const role::order& what);
  answer request_capabilities(const role::order& what);
  answer request_protocol_version(const role::order& what);
  answer get_home(const role::order& what);
  answer give(std::uint32_t message);
  answer give_or_owe(std::uint32_t message);

  equipment with_;
  instant now_;
  refused_orders refusals_;
  std::optional<std::uint32_t> owed_message_; // goes out after the answer
  double speed_mps_ = 0;                      // of a `go`; 0: the craft's own
  bool wants_restart_ = false;
};

} // namespace godwit::sim
