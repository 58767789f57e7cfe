#include "actors/domain/control_authority/mode_tables.hpp"

#include "io/mavlink/enums.hpp"

namespace godwit::flight {
namespace {

using io::mavlink::mav_autopilot;
using io::mavlink::mav_cmd;
using io::mavlink::number;

constexpr std::uint32_t plane_auto = 10;
constexpr std::uint32_t plane_rtl = 11;
constexpr std::uint32_t plane_qland = 20;
constexpr std::uint32_t plane_qrtl = 21;
constexpr std::uint32_t copter_loiter = 5;
constexpr std::uint32_t plane_fbwa = 5;

bool is_px4(const mode_owner& whose) { return whose.autopilot == mav_autopilot::px4; }

bool is_plane(const mode_owner& whose) {
  return whose.autopilot == mav_autopilot::ardupilotmega && whose.vehicle == vehicle_class::fixed_wing;
}

bool is_by_the_text(const mode_owner& whose) {
  return !is_px4(whose) && whose.autopilot != mav_autopilot::ardupilotmega;
}

bool is_landing(std::uint16_t command) {
  return command == number(mav_cmd::nav_land) || command == number(mav_cmd::nav_vtol_land);
}

bool is_return(std::uint16_t command) { return command == number(mav_cmd::nav_return_to_launch); }

} // namespace

std::vector<std::uint32_t> modes_obeying(const mode_owner& whose, mode_kind kind) {
  if (kind == mode_kind::returning && is_plane(whose))
    return {plane_rtl, plane_qrtl, plane_qland};
  const auto ordered = number_of(whose, kind);
  return ordered ? std::vector{*ordered} : std::vector<std::uint32_t>();
}

std::vector<std::uint32_t> modes_of_start(const mode_owner& whose) {
  auto result = is_px4(whose) ? modes_obeying(whose, mode_kind::take_off) : std::vector<std::uint32_t>();
  for (const auto each : modes_obeying(whose, mode_kind::mission))
    result.push_back(each);
  return result;
}

std::optional<std::uint32_t> standing_mode(const mode_owner& whose) {
  if (whose.autopilot == mav_autopilot::ardupilotmega && whose.vehicle == vehicle_class::multirotor)
    return copter_loiter;
  if (is_plane(whose))
    return plane_fbwa;
  return number_of(whose, mode_kind::hold);
}

bool leads_down(std::uint16_t last_command) { return is_landing(last_command) || is_return(last_command); }

plan_end plan_end_of(const mode_owner& whose, std::uint16_t last_command, std::uint16_t last_sequence) {
  plan_end result{last_sequence, false, {}};
  const bool returns = is_return(last_command);
  if (is_landing(last_command) && !is_px4(whose))
    return result;
  if (is_plane(whose)) {
    result.as_it_begins = returns;
    result.modes = modes_obeying(whose, mode_kind::returning);
  } else if (is_px4(whose)) {
    result.as_it_begins = returns;
    result.modes = modes_obeying(whose, returns ? mode_kind::returning : mode_kind::hold);
  } else if (is_by_the_text(whose) && !returns) {
    result.modes = modes_obeying(whose, mode_kind::hold);
  }
  return result;
}

bool may_follow_disarm(const mode_owner& whose, std::uint32_t custom_mode) {
  return is_px4(whose) &&
         (custom_mode == number_of(whose, mode_kind::mission) || custom_mode == number_of(whose, mode_kind::hold));
}

bool may_land_by_plan(const mode_owner& whose, std::uint32_t before, std::uint32_t after) {
  return is_plane(whose) && before == plane_rtl && after == plane_auto;
}

bool follows_by_itself(const mode_owner& whose, std::uint32_t before, std::uint32_t after, bool was_ordered) {
  if (is_plane(whose))
    return (before == plane_rtl && (after == plane_qrtl || after == plane_qland)) ||
           (before == plane_qrtl && after == plane_qland);
  if (is_px4(whose))
    return before == number_of(whose, mode_kind::take_off) &&
           (after == number_of(whose, mode_kind::mission) || after == number_of(whose, mode_kind::hold));
  return was_ordered && is_by_the_text(whose) && before == number_of(whose, mode_kind::returning) &&
         after == number_of(whose, mode_kind::hold);
}

} // namespace godwit::flight
