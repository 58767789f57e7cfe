// ArduPilot's Copter, as version 4.7 was seen to behave, on the wire or by its sources.
//
// It is ready some seconds after its start; until then the pre-arm bit of SYS_STATUS is off and arming FAILS. It does
// not arm on MISSION_START. Armed on the ground it takes AUTO only for a mission that begins with a take-off, and
// begins it when MISSION_START comes; in the air AUTO begins at once. Leaving AUTO stops the mission, coming back goes
// on with it. An upload cuts a mission that is being flown, and the Copter stays where it is. After landing it disarms
// itself, and disarming puts the mission back to its beginning. Item 0 is home.
//
// What it is not: failsafes but for an empty battery and the loss of position; manual flight; fences are kept and a
// breach does nothing. Thread: one at a time.
#pragma once

#include <string>

#include "programs/godwit-sim/vehicle/autopilot/autopilot.hpp"

namespace godwit::sim {

class ardupilot final : public autopilot {
public:
  explicit ardupilot(const equipment& with) : autopilot(with) {}

  using autopilot::take;
  void take(const mavlink::mission_set_current& m) override;
  void on_change(const plans::plan_change& what) override;
  void on_half_a_plan() override;
  void on_happening(const happening& what) override;
  void on_time() override;
  [[nodiscard]] std::int64_t next_timer_ns() const override;
  [[nodiscard]] mavlink::mission_current progress() const override;

  static constexpr std::int64_t disarms_after_ns = 10 * ns_per_s; // DISARM_DELAY, without a take-off

protected:
  [[nodiscard]] std::optional<refusal> why_not_arm(bool forced) const override;
  [[nodiscard]] std::optional<refusal> why_not_disarm(bool forced) const override;
  answer change_mode(const flight_mode* mode, std::uint32_t number) override;
  void on_mode_left(const flight_mode& mode) override;
  void on_mode_entered(const flight_mode& mode) override;
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

private:
  enum class mission_phase { stopped, running, complete };

  [[nodiscard]] std::string why_not(const flight_mode& mode) const;
  [[nodiscard]] bool begins_with_take_off() const;
  void start_or_resume();
  void load_plan();
  // The mission is put back to its beginning, and says so by item 0.
  void reset_mission();
  [[nodiscard]] bool choose(int sequence);
  void end_by_landing();
  void tell_begun(int sequence);
  void tell_reached(int sequence);

  mission_phase phase_ = mission_phase::stopped;
  bool is_at_beginning_ = true; // no item has been current since the plan came or was put back
  std::int64_t preflight_ends_ns_ = never_ns;
};

} // namespace godwit::sim
