// PX4, a multirotor or a VTOL, as versions 1.17 and 1.18 were seen to behave.
//
// It arms on MISSION_START, goes on at its old index with a plan that marks no item, does not activate a plan that it
// holds already, repeats MISSION_ITEM_REACHED, and for a moment after the change of a plan may tell old news. After
// landing it disarms itself. It takes any plan, and then checks it: one that leads beyond its own limit has its id and
// is no mission (state 1), and the mission mode is refused (MissionBase::check_mission_valid; seen with
// GF_MAX_HOR_DIST). The same plan is not checked anew. After a restart the plan that it has kept is no mission either
// until its position is there, 3 s later (1.18, SIH). A finished mission that does not end on the ground ends in
// AUTO.LOITER, and so does the mission mode of one that is finished: 0.4 s later, also after the return with which it
// ended (1.18: a mission is complete as its return begins; Mission::on_activation, Commander::checkForMissionUpdate).
//
// What it is not: failsafes but for an empty battery, the loss of position and of sticks; manual flight; fences are
// kept and a breach does nothing. Thread: one at a time. Source: recordings; PX4's commander and navigator.
#pragma once

#include <string>
#include <string_view>

#include "programs/godwit-sim/vehicle/autopilot/autopilot.hpp"
#include "programs/godwit-sim/vehicle/autopilot/px4_behaviour.hpp"

namespace godwit::sim {

class px4 final : public autopilot {
public:
  // HOLDS_WHEN_LANDED: after the landing of a mission, until it disarms (PX4 1.18's VTOL was seen to). HAS_STICKS: of a
  // pilot; without any the modes that need them can not be taken once it is armed.
  explicit px4(const equipment& tools, bool holds_when_landed = false, bool has_sticks = true);

  using autopilot::take;
  void take(const mavlink::mission_set_current& m) override;
  void hear_heartbeat(mavlink::sender from, const mavlink::heartbeat& m) override;
  void hear_sticks() override { sticks_.hear(now()); }
  void expect_upload() override { reached_.forget(); }
  void on_change(const plans::plan_change& what) override;
  void on_happening(const happening& what) override;
  void on_time() override;
  [[nodiscard]] std::int64_t next_timer_ns() const override;
  void end_turn() override;
  void limit_distance(double metres) override { max_distance_m_ = metres; }
  [[nodiscard]] mavlink::mission_current progress() const override;

  static constexpr std::int64_t station_lost_after_ns = 10 * ns_per_s;  // COM_DL_LOSS_T
  static constexpr std::int64_t disarms_after_ns = 10 * ns_per_s;       // COM_DISARM_PRFLT, without a take-off; outside
  static constexpr std::int64_t holds_after_ns = 400'000'000;           // a finished mission, in flight
  static constexpr std::int64_t checks_after_restart_ns = 6 * ns_per_s; // 3 s after it is heard again
  static constexpr std::int64_t disarms_after_hold_ns = 170'000'000;

protected:
  [[nodiscard]] std::optional<refusal> why_not_arm(bool forced) const override;
  [[nodiscard]] std::optional<refusal> why_not_disarm(bool forced) const override;
  answer change_mode(const flight_mode* mode, std::uint32_t number) override;
  [[nodiscard]] std::uint32_t mode_in(const role::order& what) const override;
  void on_mode_commanded(const role::order& what) override;
  void on_mode_entered(const flight_mode& mode) override;
  [[nodiscard]] bool may_move_home() const override;
  void on_armed() override;
  void on_disarmed() override;
  void on_position_lost() override;
  void on_battery_empty() override;
  void on_restart() override;

  answer start_mission(const role::order& what) override;
  answer set_mission_current(const role::order& what) override;
  answer take_off(const role::order& what) override;
  answer reposition(const role::order& what) override;
  answer pause_or_continue(const role::order& what) override;
  answer restart_or_shut_down(const role::order& what) override;
  [[nodiscard]] double altitude_in(const role::order& what) const override;

private:
  // On the way into its mission: from where it stands, or from the beginning when it is done and on the ground.
  void begin_mission();
  void announce_mission();
  void refuse_finished_mission();
  void begin_return(int sequence);
  void finish_mission();
  void finish_on_ground();
  void stop_trigger(std::uint8_t confirmation);
  void take_plan(const plans::plan_change& what);
  void check_plan();
  void act_on_lost_sticks();
  void disarm_by(std::string_view reason);
  void say_tabbed(mavlink::mav_severity severity, const std::string& text) { say(severity, text + '\t'); }

  repeated_reached reached_;
  bool says_complete_ = false; // it stands after a landing, whoever landed it
  stale_messages stale_messages_;
  stick_loss sticks_;
  std::int64_t heard_station_ns_ = -1; // real time
  std::int64_t preflight_ends_ns_ = never_ns;
  std::int64_t trigger_again_ns_ = never_ns;
  double max_distance_m_ = 0;
  bool is_infeasible_ = false; // the plan that it holds, as it was checked
  bool holds_when_landed_;
  bool has_sticks_;
  std::int64_t disarms_at_ns_ = never_ns;
  std::int64_t unchecked_until_ns_ = 0; // its plan, after a restart
  std::int64_t holds_at_ns_ = never_ns; // in its mission mode, and its mission is finished
  double takeoff_altitude_m_ = 0;
  std::string_view reason_ = by_command; // for arming and disarming

  static constexpr std::string_view by_command = "external command";
};

} // namespace godwit::sim
