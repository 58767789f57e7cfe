#include "programs/godwit-sim/vehicle/autopilot/ardu_rover.hpp"

namespace godwit::sim {

using mavlink::mav_severity;

void ardu_rover::on_armed() {
  say(mav_severity::info, "Throttle armed");
  on_mode_entered(*state().mode);
}

void ardu_rover::on_disarmed() {
  say(mav_severity::info, "Throttle disarmed");
  if (state().is_in(mode_kind::mission))
    on_mode_left(*state().mode);
}

void ardu_rover::on_position_lost() {
  say(mav_severity::critical, "EKF failsafe");
  enter(mode_kind::hold);
}

void ardu_rover::on_battery_empty() {
  say(mav_severity::critical, "Battery 1 is critical");
  enter(mode_kind::hold);
}

// FENCE_ACTION 1, and no word of it (Rover/fence.cpp).
void ardu_rover::breach_fence() {
  if (state().is_armed)
    enter(mode_kind::come_back);
}

void ardu_rover::on_completed() { say(mav_severity::notice, "Mission Complete"); }

std::string ardu_rover::words_of_reached(int sequence) const {
  return is_waypoint(command_of(sequence)) ? "Reached waypoint #" + std::to_string(sequence) : "";
}

} // namespace godwit::sim
