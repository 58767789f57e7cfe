// What ArduPilot's vehicles have in common, as version 4.7 was seen to behave, on the wire or by its sources.
//
// It is ready some seconds after its start; until then the pre-arm bit of SYS_STATUS is off and arming FAILS. It does
// not arm on MISSION_START. In the air AUTO begins at once. Leaving AUTO stops the mission, coming back goes on with
// it. An upload of as many items changes a mission that is being flown under way, at the item that is current; one that
// ends before that item cuts it, and the vehicle stays where it is. Item 0 is home, which moves to
// where it is armed until a command has set it.
//
// What it is not: failsafes but for an empty battery, the loss of position and a breach of its own fence on demand;
// manual flight; fences are kept, and that one is left does nothing by itself. Thread: one at a time.
#pragma once

#include <string>

#include "programs/godwit-sim/vehicle/autopilot/autopilot.hpp"

namespace godwit::sim {

class ardupilot : public autopilot {
public:
  explicit ardupilot(const equipment& with) : autopilot(with) {}

  using autopilot::take;
  void take(const mavlink::mission_set_current& m) override;
  void on_change(const plans::plan_change& what) override;
  void on_half_a_plan() override;
  void on_happening(const happening& what) override;
  [[nodiscard]] mavlink::mission_current progress() const override;
  void breach_fence() override;
  [[nodiscard]] bool fly_to(const role::order& what) override;

protected:
  enum class mission_phase { stopped, running, complete };

  [[nodiscard]] std::optional<refusal> why_not_arm(bool forced) const override;
  [[nodiscard]] std::optional<refusal> why_not_disarm(bool forced) const override;
  answer change_mode(const flight_mode* mode, std::uint32_t number) override;
  void on_mode_left(const flight_mode& mode) override;
  void on_mode_entered(const flight_mode& mode) override;
  void on_restart() override;

  answer start_mission(const role::order& what) override;
  answer set_mission_current(const role::order& what) override;
  answer reposition(const role::order& what) override;
  answer restart_or_shut_down(const role::order& what) override;

  // -- what Copter, Plane and Rover decide

  [[nodiscard]] virtual bool is_armable(mode_kind kind) const = 0;
  // A sentence if AUTO can not begin there, armed and with a mission.
  [[nodiscard]] virtual std::string_view why_not_auto() const { return {}; }
  // AUTO is entered or told to begin: whether the mission goes on without MISSION_START.
  [[nodiscard]] virtual bool begins_in_auto() const = 0;
  // Where a DO_REPOSITION names: what flies has to be in the air.
  [[nodiscard]] virtual bool goes_to_places() const { return craft().is_in_air(); }
  virtual void on_item_begun(int) {}
  virtual void on_took_off() {}
  virtual void on_landed() = 0;
  virtual void on_completed() = 0;
  [[nodiscard]] virtual std::string words_of_reached(int sequence) const = 0;
  // Of one that is replaced while it is flown (mode_auto.cpp of Copter and Rover; Plane has none).
  [[nodiscard]] virtual bool says_mission_changed() const { return false; }

  // -- what they have at hand

  void start_or_resume();
  // The mission is put back to its beginning, and says so by item 0.
  void reset_mission();
  [[nodiscard]] bool choose(int sequence);
  [[nodiscard]] mission_phase phase() const { return phase_; }
  // Its Copter takes a mission that was set back for one that runs.
  void set_back_and_running();
  [[nodiscard]] std::uint16_t command_of(int sequence) const {
    return run().items()[static_cast<std::size_t>(sequence)].command;
  }

  static constexpr int first_flown = 1; // item 0 is home

private:
  [[nodiscard]] std::string why_not(const flight_mode& mode) const;
  void load_plan();
  void take_plan_under_way();
  void tell_begun(int sequence);
  void tell_executed(int sequence);
  void tell_picture();
  void tell_reached(int sequence);

  mission_phase phase_ = mission_phase::stopped;
  bool is_at_beginning_ = true; // no item has been current since the plan came or was put back
};

[[nodiscard]] bool is_waypoint(std::uint16_t command);

} // namespace godwit::sim
