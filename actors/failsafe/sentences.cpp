#include "actors/failsafe/sentences.hpp"

namespace godwit::failsafe {

std::string cause_of(rule why, const battery_verdict& level, const fence_verdict& fences) {
  switch (why) {
  case rule::battery_critical:
  case rule::battery_low:
    return "the battery is at " + std::to_string(level.percent) + " %";
  case rule::fence:
    return fences.found ? "a fence is breached: " + fences.found->sentence() : std::string("a fence is breached");
  case rule::operator_link:
    break;
  }
  return "the operator's ground station is lost";
}

std::string deed_of(action what) {
  switch (what) {
  case action::return_home:
    return "the vehicle returns";
  case action::land:
    return "the vehicle lands";
  case action::hold:
    return "the vehicle holds";
  case action::do_land_start:
    break;
  }
  return "the vehicle goes on at the landing of its mission";
}

} // namespace godwit::failsafe
