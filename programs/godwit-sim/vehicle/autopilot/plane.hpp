// ArduPilot's Plane.
//
// It arms in every mode but those that come home, in AUTO and TAKEOFF too, and takes off at once there. A landing item
// never ends: the plane stands on it, disarms itself some time later and stays in AUTO, without a word that the mission
// is complete. After any other last item, and as a return item begins, it changes to RTL by itself, which circles over
// home for ever. Disarming in another mode than AUTO puts the mission back to its beginning. It has no mode for
// landing; DO_LAND_START leads to the landing of its plan. Its RTL_AUTOLAND lets it arm with such a plan (3), and
// leaves RTL without a landing; by default (0) its own checks fail while it holds such a plan, which it says each 30 s.
// A pilot of the manual modes circles where he took it over. One with rotors (a quadplane) takes off and lands on them
// in its mission, flies on its wings in between unless the mission says otherwise, disarms itself 1.5 s after such a
// landing, and lands on them in QLAND; its other modes are those of its wings. Thread: one at a time. Source:
// recordings of a quadplane, ArduPlane 4.7 (commands_logic.cpp, mode_auto.cpp, AP_Arming_Plane.cpp,
// GCS_MAVLink_Plane.cpp), as remembered. With RTL_AUTOLAND 2 a return goes on at once with the landing that its plan
// marks: flown on a real one (4.7.0-dev) HEARTBEAT showed RTL, 10 ms later AUTO, and within 1 ms the text "Landing
// sequence start"; MISSION_CURRENT was at the item after DO_LAND_START 45 ms later.
#pragma once

#include <algorithm>

#include "programs/godwit-sim/vehicle/autopilot/ardupilot.hpp"

namespace godwit::sim {

class plane final : public ardupilot {
public:
  plane(const equipment& with, int rtl_autoland) : ardupilot(with), rtl_autoland_(rtl_autoland) {}

  void on_time() override;
  [[nodiscard]] std::int64_t next_timer_ns() const override {
    return std::min({disarms_ns_, says_checks_ns_, lands_ns_});
  }
  using ardupilot::on_change;
  void on_change(const plans::plan_change& what) override;

  static constexpr std::int64_t disarms_after_ns = 20 * ns_per_s; // LAND_DISARMDELAY
  static constexpr std::int64_t disarms_on_rotors_after_ns = 1'500'000'000;
  static constexpr std::int64_t lands_after_ns = 10'000'000; // the next cycle
  static constexpr std::int64_t says_checks_each_ns = 30 * ns_per_s;

protected:
  void on_mode_left(const flight_mode& mode) override;
  void on_mode_entered(const flight_mode& mode) override;
  void on_armed() override;
  void on_disarmed() override;
  void on_position_lost() override;
  void on_battery_empty() override;
  void on_restart() override;

  [[nodiscard]] std::optional<refusal> why_not_arm(bool forced) const override;
  answer take_off(const role::order& what) override;
  answer pause_or_continue(const role::order& what) override;
  answer start_landing(const role::order& what) override;

  [[nodiscard]] bool is_armable(mode_kind kind) const override { return kind != mode_kind::come_back; }
  [[nodiscard]] bool begins_in_auto() const override { return state().is_armed; }
  void on_item_begun(int sequence) override;
  void on_landed() override;
  void on_completed() override;
  [[nodiscard]] std::string words_of_reached(int sequence) const override;

private:
  void take_off_ahead();
  void check_plan();
  [[nodiscard]] std::optional<int> landing_sequence() const;
  bool land_by_plan();

  int rtl_autoland_;
  std::int64_t lands_ns_ = never_ns; // out of a return, by the plan
  std::int64_t disarms_ns_ = never_ns;
  std::int64_t says_checks_ns_ = never_ns;
};

} // namespace godwit::sim
