// The rover: an autopilot of nobody's make that does what the MAVLink text and the requirement of its mission say.
//
// | Mode | Does |
// |---|---|
// | MANUAL, HOLD | stands |
// | AUTO | holds while the mission is idle, drives while it runs; then changes to HOLD |
// | RTL | home, then HOLD |
//
// MISSION_START is answered as vehicle_role says, and changes to AUTO. It begins at the item that it names; if that is
// 0, at the one that MISSION_SET_CURRENT chose while nothing ran. Another mode pauses a running mission, AUTO goes on
// with it, disarming ends it. A new plan under way ends the old one; the rover then holds in AUTO until it is started
// again. Thread: one at a time.
#pragma once

#include "programs/godwit-sim/vehicle/autopilot/ardupilot.hpp"
#include "programs/godwit-sim/vehicle/autopilot/autopilot.hpp"

namespace godwit::sim {

class rover final : public autopilot {
public:
  rover(const equipment& with, bool arms_on_start) : autopilot(with), arms_on_start_(arms_on_start) {}

  using autopilot::take;
  void take(const mavlink::mission_set_current& m) override;
  void on_change(const plans::plan_change& what) override;
  void on_happening(const happening& what) override;
  [[nodiscard]] mavlink::mission_current progress() const override;

protected:
  [[nodiscard]] std::optional<refusal> why_not_arm(bool forced) const override;
  [[nodiscard]] std::optional<refusal> why_not_disarm(bool forced) const override;
  answer change_mode(const flight_mode* mode, std::uint32_t number) override;
  void on_mode_entered(const flight_mode& mode) override;
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
  // False: there is no such item.
  [[nodiscard]] bool choose(int sequence);

  bool arms_on_start_;
  std::optional<int> start_point_;
};

// ArduPilot's Rover.
//
// It can be armed in any mode, and drives off when it is armed in AUTO. After its last item it stays there, armed and
// standing (MIS_DONE_BEHAVE 0), and says that its mission is complete; after a return it stays in RTL. It never
// disarms itself. Thread: one at a time. Source: recordings of ArduRover 4.7; Rover/mode_auto.cpp.
class ardu_rover final : public ardupilot {
public:
  explicit ardu_rover(const equipment& with) : ardupilot(with) {}

  void breach_fence() override;

protected:
  void on_armed() override;
  void on_disarmed() override;
  void on_position_lost() override;
  void on_battery_empty() override;

  answer take_off(const role::order&) override { return answer::unsupported; }
  answer land(const role::order&) override { return answer::unsupported; }
  answer pause_or_continue(const role::order&) override { return answer::unsupported; }

  [[nodiscard]] std::optional<refusal> why_not_disarm(bool) const override { return std::nullopt; }
  [[nodiscard]] bool is_armable(mode_kind) const override { return true; }
  [[nodiscard]] bool begins_in_auto() const override { return state().is_armed; }
  [[nodiscard]] bool goes_to_places() const override { return true; }
  void on_landed() override {}
  void on_completed() override;
  [[nodiscard]] std::string words_of_reached(int sequence) const override;
  [[nodiscard]] bool says_mission_changed() const override { return true; }
};

} // namespace godwit::sim
