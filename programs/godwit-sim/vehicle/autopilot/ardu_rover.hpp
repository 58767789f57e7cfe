// ArduPilot's Rover.
//
// It can be armed in any mode, and drives off when it is armed in AUTO. Behind its last item it stays there, armed and
// standing (MIS_DONE_BEHAVE 0), and says that its mission is complete; after a return it stays in RTL. It never
// disarms itself. Thread: one at a time. Source: recordings of ArduRover 4.7; Rover/mode_auto.cpp.
#pragma once

#include "programs/godwit-sim/vehicle/autopilot/ardupilot.hpp"

namespace godwit::sim {

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
