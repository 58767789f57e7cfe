#include "actors/domain/mission/commands/command_table.hpp"

#include <algorithm>
#include <iterator>

namespace godwit::mission {

namespace {

using enum command_class;

constexpr bool at_place = true;
constexpr bool anywhere = false;

constexpr std::string_view has_one; // a counterpart
constexpr std::string_view endless = "it never ends, and a mission's loiter has a duration";
constexpr std::string_view turns = "a mission's loiter lasts for seconds, not for turns";
constexpr std::string_view climbing = "no item of a mission changes the height in circles";
constexpr std::string_view no_way = "no item of a mission flies such a way";
constexpr std::string_view waiting = "a mission has no waits and conditions between its items";
constexpr std::string_view jumping = "the items of a mission are flown once, in order";
constexpr std::string_view no_home = "a mission can not move its return point in flight";
constexpr std::string_view payload = "a mission has no commands for servos, relays and payload";
constexpr std::string_view camera = "a mission has no commands for cameras and gimbals";
constexpr std::string_view landing = "a mission has no marks for landings";
constexpr std::string_view vtol = "a mission has no transitions between hovering and flying forward";
constexpr std::string_view fence_switch = "a mission does not switch fences or parachutes";
constexpr std::string_view unjudged = "what it does can not be judged before the flight";
constexpr std::string_view forbidden = "no mission may stop motors, change the mode or start another mission";
constexpr std::string_view own_fence = "it belongs to the fence, which is a file of its own";
constexpr std::string_view own_rally = "it belongs to the rally points, which are a file of their own";
constexpr std::string_view no_act = "a mission has no counterpart of it";

// In the order of their numbers.
constexpr command_row rows[] = {
    {16, "NAV_WAYPOINT", moves, at_place, "tttttttt", has_one},
    {17, "NAV_LOITER_UNLIM", moves, at_place, "tttttttt", endless},
    {18, "NAV_LOITER_TURNS", moves, at_place, "tttt----", turns},
    {19, "NAV_LOITER_TIME", moves, at_place, "tttttttt", has_one},
    {20, "NAV_RETURN_TO_LAUNCH", moves, anywhere, "tttttttt", has_one},
    {21, "NAV_LAND", moves, at_place, "tttstttt", has_one},
    {22, "NAV_TAKEOFF", moves, at_place, "tttstttt", has_one},
    {23, "NAV_LAND_LOCAL", moves, at_place, "--------", no_way},
    {24, "NAV_TAKEOFF_LOCAL", moves, at_place, "--------", no_way},
    {25, "NAV_FOLLOW", moves, at_place, "--------", no_way},
    {30, "NAV_CONTINUE_AND_CHANGE_ALT", moves, anywhere, "stts----", climbing},
    {31, "NAV_LOITER_TO_ALT", moves, at_place, "tttstttt", climbing},
    {32, "DO_FOLLOW", acts, anywhere, "--------", no_act},
    {33, "DO_FOLLOW_REPOSITION", acts, anywhere, "--------", no_act},
    {34, "DO_ORBIT", moves, at_place, "--------", no_way},
    {35, "DO_FIGURE_EIGHT", moves, at_place, "--------", no_way},
    {36, "NAV_ARC_WAYPOINT", moves, at_place, "--------", no_way},
    {80, "NAV_ROI", acts, at_place, "----tttt", camera},
    {81, "NAV_PATHPLANNING", moves, at_place, "--------", no_way},
    {82, "NAV_SPLINE_WAYPOINT", moves, at_place, "t--s----", has_one},
    {83, "NAV_ALTITUDE_WAIT", waits, anywhere, "stts----", waiting},
    {84, "NAV_VTOL_TAKEOFF", moves, at_place, "tststttt", has_one},
    {85, "NAV_VTOL_LAND", moves, at_place, "tststttt", has_one},
    {92, "NAV_GUIDED_ENABLE", guarded, anywhere, "tsst----", waiting},
    {93, "NAV_DELAY", waits, anywhere, "tttttttt", waiting},
    {94, "NAV_PAYLOAD_PLACE", moves, at_place, "tsts----", payload},
    {112, "CONDITION_DELAY", waits, anywhere, "tttttttt", waiting},
    {113, "CONDITION_CHANGE_ALT", waits, anywhere, "--------", waiting},
    {114, "CONDITION_DISTANCE", waits, anywhere, "tttt----", waiting},
    {115, "CONDITION_YAW", waits, anywhere, "tsss----", waiting},
    {176, "DO_SET_MODE", guarded, anywhere, "--------", unjudged},
    {177, "DO_JUMP", flow, anywhere, "tttttttt", jumping},
    {178, "DO_CHANGE_SPEED", acts, anywhere, "tttttttt", has_one},
    {179, "DO_SET_HOME", guarded, at_place, "tttttttt", no_home},
    {180, "DO_SET_PARAMETER", guarded, anywhere, "--------", unjudged},
    {181, "DO_SET_RELAY", acts, anywhere, "tttt----", payload},
    {182, "DO_REPEAT_RELAY", acts, anywhere, "tttt----", payload},
    {183, "DO_SET_SERVO", acts, anywhere, "tttt----", payload},
    {184, "DO_REPEAT_SERVO", acts, anywhere, "tttt----", payload},
    {185, "DO_FLIGHTTERMINATION", never, anywhere, "--------", forbidden},
    {186, "DO_CHANGE_ALTITUDE", acts, anywhere, "--------", no_act},
    {187, "DO_SET_ACTUATOR", guarded, anywhere, "----tttt", payload},
    {188, "DO_RETURN_PATH_START", flow, at_place, "ttts----", landing},
    {189, "DO_LAND_START", flow, at_place, "tttstttt", landing},
    {190, "DO_RALLY_LAND", flow, anywhere, "--------", landing},
    {191, "DO_GO_AROUND", flow, anywhere, "ssss----", landing},
    {192, "DO_REPOSITION", moves, at_place, "--------", no_way},
    {193, "DO_PAUSE_CONTINUE", flow, anywhere, "ssss----", landing},
    {194, "DO_SET_REVERSE", guarded, anywhere, "ssst----", unjudged},
    {195, "DO_SET_ROI_LOCATION", acts, at_place, "tttttttt", camera},
    {196, "DO_SET_ROI_WPNEXT_OFFSET", acts, anywhere, "----tttt", camera},
    {197, "DO_SET_ROI_NONE", acts, anywhere, "tttttttt", camera},
    {198, "DO_SET_ROI_SYSID", acts, anywhere, "--------", camera},
    {200, "DO_CONTROL_VIDEO", acts, anywhere, "----tttt", camera},
    {201, "DO_SET_ROI", acts, at_place, "tttt----", camera},
    {202, "DO_DIGICAM_CONFIGURE", acts, anywhere, "tttt----", camera},
    {203, "DO_DIGICAM_CONTROL", acts, anywhere, "tttttttt", camera},
    {204, "DO_MOUNT_CONFIGURE", acts, anywhere, "----tttt", camera},
    {205, "DO_MOUNT_CONTROL", acts, anywhere, "tttstttt", camera},
    {206, "DO_SET_CAM_TRIGG_DIST", acts, anywhere, "tttttttt", camera},
    {207, "DO_FENCE_ENABLE", guarded, anywhere, "tttt----", fence_switch},
    {208, "DO_PARACHUTE", guarded, anywhere, "tttt----", fence_switch},
    {209, "DO_MOTOR_TEST", guarded, anywhere, "--------", unjudged},
    {210, "DO_INVERTED_FLIGHT", guarded, anywhere, "stts----", unjudged},
    {211, "DO_GRIPPER", acts, anywhere, "tttttttt", payload},
    {212, "DO_AUTOTUNE_ENABLE", guarded, anywhere, "sttstttt", unjudged},
    {213, "NAV_SET_YAW_SPEED", guarded, anywhere, "ssst----", unjudged},
    {214, "DO_SET_CAM_TRIGG_INTERVAL", acts, anywhere, "----tttt", camera},
    {215, "DO_SET_RESUME_REPEAT_DIST", acts, anywhere, "tttt----", no_act},
    {216, "DO_SPRAYER", acts, anywhere, "tttt----", payload},
    {217, "DO_SEND_SCRIPT_MESSAGE", guarded, anywhere, "tttt----", unjudged},
    {218, "DO_AUX_FUNCTION", guarded, anywhere, "tttt----", unjudged},
    {220, "DO_MOUNT_CONTROL_QUAT", acts, anywhere, "--------", camera},
    {221, "DO_GUIDED_MASTER", acts, anywhere, "--------", no_act},
    {222, "DO_GUIDED_LIMITS", guarded, anywhere, "tsst----", unjudged},
    {223, "DO_ENGINE_CONTROL", guarded, anywhere, "stts----", unjudged},
    {224, "DO_SET_MISSION_CURRENT", never, anywhere, "--------", forbidden},
    {241, "PREFLIGHT_CALIBRATION", guarded, anywhere, "--------", unjudged},
    {246, "PREFLIGHT_REBOOT_SHUTDOWN", guarded, anywhere, "--------", unjudged},
    {252, "OVERRIDE_GOTO", moves, at_place, "--------", no_way},
    {260, "OBLIQUE_SURVEY", acts, anywhere, "----tttt", camera},
    {262, "DO_SET_STANDARD_MODE", acts, anywhere, "--------", no_act},
    {300, "MISSION_START", never, anywhere, "--------", forbidden},
    {310, "ACTUATOR_TEST", guarded, anywhere, "--------", unjudged},
    {400, "COMPONENT_ARM_DISARM", never, anywhere, "----tttt", forbidden},
    {401, "RUN_PREARM_CHECKS", acts, anywhere, "--------", no_act},
    {405, "ILLUMINATOR_ON_OFF", acts, anywhere, "--------", no_act},
    {406, "DO_ILLUMINATOR_CONFIGURE", acts, anywhere, "--------", no_act},
    {420, "INJECT_FAILURE", guarded, anywhere, "--------", unjudged},
    {511, "SET_MESSAGE_INTERVAL", acts, anywhere, "--------", no_act},
    {512, "REQUEST_MESSAGE", acts, anywhere, "--------", no_act},
    {530, "SET_CAMERA_MODE", acts, anywhere, "----tttt", camera},
    {531, "SET_CAMERA_ZOOM", acts, anywhere, "tttt----", camera},
    {532, "SET_CAMERA_FOCUS", acts, anywhere, "tttttttt", camera},
    {533, "SET_STORAGE_USAGE", acts, anywhere, "--------", camera},
    {534, "SET_CAMERA_SOURCE", acts, anywhere, "tttttttt", camera},
    {600, "JUMP_TAG", flow, anywhere, "tttt----", jumping},
    {601, "DO_JUMP_TAG", flow, anywhere, "tttt----", jumping},
    {1000, "DO_GIMBAL_MANAGER_PITCHYAW", acts, anywhere, "tttttttt", camera},
    {1001, "DO_GIMBAL_MANAGER_CONFIGURE", acts, anywhere, "----tttt", camera},
    {2000, "IMAGE_START_CAPTURE", acts, anywhere, "tttttttt", camera},
    {2001, "IMAGE_STOP_CAPTURE", acts, anywhere, "tttttttt", camera},
    {2003, "DO_TRIGGER_CONTROL", acts, anywhere, "----tttt", camera},
    {2004, "CAMERA_TRACK_POINT", acts, anywhere, "--------", camera},
    {2005, "CAMERA_TRACK_RECTANGLE", acts, anywhere, "--------", camera},
    {2010, "CAMERA_STOP_TRACKING", acts, anywhere, "--------", camera},
    {2500, "VIDEO_START_CAPTURE", acts, anywhere, "tttttttt", camera},
    {2501, "VIDEO_STOP_CAPTURE", acts, anywhere, "tttttttt", camera},
    {2502, "VIDEO_START_STREAMING", acts, anywhere, "--------", camera},
    {2503, "VIDEO_STOP_STREAMING", acts, anywhere, "--------", camera},
    {2510, "LOGGING_START", acts, anywhere, "--------", no_act},
    {2511, "LOGGING_STOP", acts, anywhere, "--------", no_act},
    {2520, "AIRFRAME_CONFIGURATION", acts, anywhere, "--------", no_act},
    {2600, "CONTROL_HIGH_LATENCY", acts, anywhere, "--------", no_act},
    {2800, "PANORAMA_CREATE", acts, anywhere, "--------", no_act},
    {3000, "DO_VTOL_TRANSITION", moves, anywhere, "sststttt", vtol},
    {4000, "SET_GUIDED_SUBMODE_STANDARD", acts, anywhere, "--------", no_act},
    {4001, "SET_GUIDED_SUBMODE_CIRCLE", acts, at_place, "--------", no_act},
    {4501, "CONDITION_GATE", waits, at_place, "--------", camera},
    {5000, "NAV_FENCE_RETURN_POINT", fence, at_place, "tttttttt", own_fence},
    {5001, "NAV_FENCE_POLYGON_VERTEX_INCLUSION", fence, at_place, "tttttttt", own_fence},
    {5002, "NAV_FENCE_POLYGON_VERTEX_EXCLUSION", fence, at_place, "tttttttt", own_fence},
    {5003, "NAV_FENCE_CIRCLE_INCLUSION", fence, at_place, "tttttttt", own_fence},
    {5004, "NAV_FENCE_CIRCLE_EXCLUSION", fence, at_place, "tttttttt", own_fence},
    {5100, "NAV_RALLY_POINT", rally, at_place, "tttttttt", own_rally},
    {5300, "DO_SET_SAFETY_SWITCH_STATE", acts, anywhere, "--------", no_act},
    {10001, "DO_ADSB_OUT_IDENT", acts, anywhere, "--------", no_act},
    {30001, "PAYLOAD_PREPARE_DEPLOY", moves, at_place, "--------", no_way},
    {30002, "PAYLOAD_CONTROL_DEPLOY", acts, anywhere, "--------", no_act},
    {31000, "WAYPOINT_USER_1", moves, at_place, "--------", no_way},
    {31001, "WAYPOINT_USER_2", moves, at_place, "--------", no_way},
    {31002, "WAYPOINT_USER_3", moves, at_place, "--------", no_way},
    {31003, "WAYPOINT_USER_4", moves, at_place, "--------", no_way},
    {31004, "WAYPOINT_USER_5", moves, at_place, "--------", no_way},
    {31005, "SPATIAL_USER_1", acts, at_place, "--------", no_act},
    {31006, "SPATIAL_USER_2", acts, at_place, "--------", no_act},
    {31007, "SPATIAL_USER_3", acts, at_place, "--------", no_act},
    {31008, "SPATIAL_USER_4", acts, at_place, "--------", no_act},
    {31009, "SPATIAL_USER_5", acts, at_place, "--------", no_act},
    {31010, "USER_1", acts, anywhere, "--------", no_act},
    {31011, "USER_2", acts, anywhere, "--------", no_act},
    {31012, "USER_3", acts, anywhere, "--------", no_act},
    {31013, "USER_4", acts, anywhere, "--------", no_act},
    {31014, "USER_5", acts, anywhere, "--------", no_act},
    {42000, "POWER_OFF_INITIATED", acts, anywhere, "--------", no_act},
    {42007, "SET_EKF_SOURCE_SET", acts, anywhere, "--------", no_act},
    {42600, "DO_WINCH", acts, anywhere, "tssstttt", payload},
    {42651, "BATTERY_RESET", acts, anywhere, "--------", no_act},
    {42701, "SCRIPTING", guarded, anywhere, "--------", unjudged},
    {42702, "NAV_SCRIPT_TIME", guarded, anywhere, "--------", unjudged},
    {42703, "NAV_ATTITUDE_TIME", guarded, anywhere, "tsss----", unjudged},
    {43000, "GUIDED_CHANGE_SPEED", acts, anywhere, "--------", no_act},
    {43001, "GUIDED_CHANGE_ALTITUDE", acts, anywhere, "--------", no_act},
    {43002, "GUIDED_CHANGE_HEADING", acts, anywhere, "--------", no_act},
    {43003, "EXTERNAL_POSITION_ESTIMATE", acts, at_place, "--------", no_act},
    {43005, "SET_HAGL", acts, anywhere, "--------", no_act},
};

static_assert(std::ranges::is_sorted(rows, {}, &command_row::id));
static_assert(std::ranges::all_of(rows, [](const command_row& each) { return each.answers.size() == 8; }));

} // namespace

const command_row* command_of(std::uint16_t id) {
  const auto* const found = std::ranges::lower_bound(rows, id, {}, &command_row::id);
  return found == std::end(rows) || found->id != id ? nullptr : found;
}

} // namespace godwit::mission
