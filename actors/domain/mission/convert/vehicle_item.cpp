#include "actors/domain/mission/convert/vehicle_item.hpp"

#include <algorithm>
#include <string_view>

#include "io/fields/json_text.hpp"

namespace godwit::mission {

namespace {

constexpr std::string_view endless = "it never ends, and a mission's loiter has a duration";
constexpr std::string_view turns = "a mission's loiter lasts for seconds, not for turns";
constexpr std::string_view climbing = "no item of a mission changes the height in circles";
constexpr std::string_view waiting = "a mission has no waits and conditions between its items";
constexpr std::string_view jumping = "the items of a mission are flown once, in order";
constexpr std::string_view no_home = "a mission can not move its return point in flight";
constexpr std::string_view payload = "a mission has no commands for servos, relays and payload";
constexpr std::string_view camera = "a mission has no commands for cameras and gimbals";
constexpr std::string_view landing = "a mission has no marks for landings";
constexpr std::string_view vtol = "a mission has no transitions between hovering and flying forward";
constexpr std::string_view fence = "a mission does not switch fences or parachutes";

struct command_row {
  std::uint16_t id;
  std::string_view name;
  std::string_view why; // empty: it has a counterpart
};

// The commands that ground stations put into plans.
constexpr command_row rows[] = {
    {16, "NAV_WAYPOINT", ""},
    {17, "NAV_LOITER_UNLIM", endless},
    {18, "NAV_LOITER_TURNS", turns},
    {19, "NAV_LOITER_TIME", ""},
    {20, "NAV_RETURN_TO_LAUNCH", ""},
    {21, "NAV_LAND", ""},
    {22, "NAV_TAKEOFF", ""},
    {30, "NAV_CONTINUE_AND_CHANGE_ALT", climbing},
    {31, "NAV_LOITER_TO_ALT", climbing},
    {80, "NAV_ROI", camera},
    {82, "NAV_SPLINE_WAYPOINT", ""},
    {84, "NAV_VTOL_TAKEOFF", ""},
    {85, "NAV_VTOL_LAND", ""},
    {92, "NAV_GUIDED_ENABLE", waiting},
    {93, "NAV_DELAY", waiting},
    {94, "NAV_PAYLOAD_PLACE", payload},
    {112, "CONDITION_DELAY", waiting},
    {113, "CONDITION_CHANGE_ALT", waiting},
    {114, "CONDITION_DISTANCE", waiting},
    {115, "CONDITION_YAW", waiting},
    {177, "DO_JUMP", jumping},
    {178, "DO_CHANGE_SPEED", ""},
    {179, "DO_SET_HOME", no_home},
    {181, "DO_SET_RELAY", payload},
    {182, "DO_REPEAT_RELAY", payload},
    {183, "DO_SET_SERVO", payload},
    {184, "DO_REPEAT_SERVO", payload},
    {189, "DO_LAND_START", landing},
    {195, "DO_SET_ROI_LOCATION", camera},
    {196, "DO_SET_ROI_WPNEXT_OFFSET", camera},
    {197, "DO_SET_ROI_NONE", camera},
    {201, "DO_SET_ROI", camera},
    {202, "DO_DIGICAM_CONFIGURE", camera},
    {203, "DO_DIGICAM_CONTROL", camera},
    {204, "DO_MOUNT_CONFIGURE", camera},
    {205, "DO_MOUNT_CONTROL", camera},
    {206, "DO_SET_CAM_TRIGG_DIST", camera},
    {207, "DO_FENCE_ENABLE", fence},
    {208, "DO_PARACHUTE", fence},
    {211, "DO_GRIPPER", payload},
    {214, "DO_SET_CAM_TRIGG_INTERVAL", camera},
    {530, "SET_CAMERA_MODE", camera},
    {1000, "DO_GIMBAL_MANAGER_PITCHYAW", camera},
    {2000, "IMAGE_START_CAPTURE", camera},
    {2001, "IMAGE_STOP_CAPTURE", camera},
    {2500, "VIDEO_START_CAPTURE", camera},
    {2501, "VIDEO_STOP_CAPTURE", camera},
    {3000, "DO_VTOL_TRANSITION", vtol},
};

const command_row* row_of(std::uint16_t id) {
  const auto found = std::ranges::find(rows, id, &command_row::id);
  return found == std::end(rows) ? nullptr : &*found;
}

} // namespace

std::string command_name(std::uint16_t id) {
  const auto* row = row_of(id);
  return row == nullptr ? "command " + std::to_string(id) : std::string(row->name);
}

std::string why_no_counterpart(std::uint16_t id) {
  const auto* row = row_of(id);
  return row == nullptr ? "a mission has no counterpart of it" : std::string(row->why);
}

std::optional<planned_home> home_at(double latitude, double longitude, double above_sea_m) {
  const bool is_place = std::isfinite(latitude) && std::isfinite(longitude) && (latitude != 0 || longitude != 0);
  if (!is_place)
    return std::nullopt;
  return planned_home{latitude, longitude, std::isfinite(above_sea_m) ? std::optional(above_sea_m) : std::nullopt};
}

std::string number_text(double value) {
  std::string result;
  io::append_json_number(result, value);
  return result;
}

} // namespace godwit::mission
