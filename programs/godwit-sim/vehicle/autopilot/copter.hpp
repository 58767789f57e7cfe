// ArduPilot's Copter.
//
// Armed on the ground it takes AUTO only for a mission that begins with a take-off, and begins it when MISSION_START
// comes; from then on also when AUTO is entered, until it is disarmed (Copter::update_auto_armed). After landing it
// disarms itself, and disarming puts the mission back to its beginning. Thread: one at a time.
#pragma once

#include "programs/godwit-sim/vehicle/autopilot/ardupilot.hpp"

namespace godwit::sim {

class copter final : public ardupilot {
public:
  explicit copter(const equipment& with) : ardupilot(with) {}

  void on_time() override;
  [[nodiscard]] std::int64_t next_timer_ns() const override { return preflight_ends_ns_; }

  static constexpr std::int64_t disarms_after_ns = 10 * ns_per_s; // DISARM_DELAY, without a take-off; outside

protected:
  void on_armed() override;
  void on_disarmed() override;
  void on_position_lost() override;
  void on_battery_empty() override;
  void on_restart() override;
  void on_mode_entered(const flight_mode& mode) override;

  answer start_mission(const role::order& what) override;
  answer take_off(const role::order& what) override;
  answer pause_or_continue(const role::order& what) override;

  [[nodiscard]] bool is_armable(mode_kind kind) const override;
  [[nodiscard]] std::string_view why_not_auto() const override;
  [[nodiscard]] bool begins_in_auto() const override { return craft().is_in_air() || is_auto_armed_; }
  void on_took_off() override { preflight_ends_ns_ = never_ns; }
  void on_landed() override;
  void on_completed() override;
  [[nodiscard]] std::string words_of_reached(int sequence) const override;
  [[nodiscard]] bool says_mission_changed() const override { return true; }

private:
  [[nodiscard]] bool begins_with_take_off() const;

  std::int64_t preflight_ends_ns_ = never_ns;
  bool is_auto_armed_ = false; // it was started since it was armed
};

} // namespace godwit::sim
