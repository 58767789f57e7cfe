#include "actors/failsafe/vehicle_texts.hpp"

#include "actors/domain/control_authority/mode_tables.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::failsafe {

namespace {

namespace mavlink = io::mavlink;
using vehicle_link::send_command;

send_command plain(mavlink::mav_cmd command) {
  send_command result;
  result.command = mavlink::number(command);
  return result;
}

std::optional<send_command> first_try(action what, const flight::mode_owner& whose) {
  switch (what) {
  case action::return_home:
    return plain(mavlink::mav_cmd::nav_return_to_launch);
  case action::land:
    return plain(mavlink::mav_cmd::nav_land);
  case action::do_land_start:
    return plain(mavlink::mav_cmd::do_land_start);
  case action::hold:
    break;
  }
  return flight::mode_command(whose, flight::mode_kind::hold);
}

} // namespace

std::optional<send_command> words_for(const command_vehicle& wanted, const flight::mode_owner& whose) {
  auto result = first_try(wanted.what, whose);
  if (result)
    result->confirmation = wanted.confirmation;
  return result;
}

std::optional<vehicle_link::set_mode> mode_words_for(const command_vehicle& wanted, const flight::mode_owner& whose) {
  if (wanted.what != action::hold)
    return std::nullopt;
  const auto number = flight::number_of(whose, flight::mode_kind::hold);
  if (!number)
    return std::nullopt;
  return vehicle_link::set_mode{mavlink::number(mavlink::mav_mode_flag::custom_mode_enabled), *number};
}

std::vector<std::uint32_t> modes_for(action what, const flight::mode_owner& whose) {
  switch (what) {
  case action::return_home:
    return flight::modes_obeying(whose, flight::mode_kind::returning);
  case action::land:
    return flight::modes_obeying(whose, flight::mode_kind::landing);
  case action::do_land_start:
    return flight::modes_obeying(whose, flight::mode_kind::mission);
  case action::hold:
    break;
  }
  return flight::modes_obeying(whose, flight::mode_kind::hold);
}

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
