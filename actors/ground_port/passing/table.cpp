#include "actors/ground_port/passing/table.hpp"

#include <algorithm>
#include <array>

#include "actors/ground_port/passing/payload_byte.hpp"

namespace godwit::ground_port::passing {

namespace {

using enum pass_list;
using kind = executor::act_kind;

constexpr bool alone = false; // names a system and no component

constexpr message_row message(std::uint32_t id, pass_list on, int target_at, std::string_view name,
                              bool component = true) {
  return {id, on, target_at, component, kind::stream, name};
}

// Sorted by id.
constexpr std::array messages{
    message(0, passes, no_target, "HEARTBEAT"),
    message(2, setting, no_target, "SYSTEM_TIME"),
    message(11, person, 4, "SET_MODE", alone),
    message(20, passes, 2, "PARAM_REQUEST_READ"),
    message(21, passes, 0, "PARAM_REQUEST_LIST"),
    message(23, disarmed, 4, "PARAM_SET"),
    message(37, owned, 4, "MISSION_REQUEST_PARTIAL_LIST"),
    message(38, owned, 4, "MISSION_WRITE_PARTIAL_LIST"),
    message(39, owned, 32, "MISSION_ITEM"),
    message(40, owned, 2, "MISSION_REQUEST"),
    message(41, owned, 2, "MISSION_SET_CURRENT"),
    message(43, owned, 0, "MISSION_REQUEST_LIST"),
    message(44, owned, 2, "MISSION_COUNT"),
    message(45, owned, 0, "MISSION_CLEAR_ALL"),
    message(47, owned, 0, "MISSION_ACK"),
    message(48, disarmed, 12, "SET_GPS_GLOBAL_ORIGIN", alone),
    message(51, owned, 2, "MISSION_REQUEST_INT"),
    message(66, passes, 2, "REQUEST_DATA_STREAM"),
    message(69, person, 10, "MANUAL_CONTROL", alone),
    message(70, person, 16, "RC_CHANNELS_OVERRIDE"),
    message(73, owned, 32, "MISSION_ITEM_INT"),
    message(75, person, 30, "COMMAND_INT"),
    message(76, person, 30, "COMMAND_LONG"),
    message(77, passes, 8, "COMMAND_ACK"), // of a calibration that asks for the next step
    message(82, person, 36, "SET_ATTITUDE_TARGET"),
    message(84, person, 50, "SET_POSITION_TARGET_LOCAL_NED"),
    message(86, person, 50, "SET_POSITION_TARGET_GLOBAL_INT"),
    message(102, setting, no_target, "VISION_POSITION_ESTIMATE"),
    message(103, setting, no_target, "VISION_SPEED_ESTIMATE"),
    message(110, passes, 1, "FILE_TRANSFER_PROTOCOL"),
    message(113, setting, no_target, "HIL_GPS"),
    message(117, passes, 4, "LOG_REQUEST_LIST"),
    message(119, passes, 10, "LOG_REQUEST_DATA"),
    message(121, disarmed, 0, "LOG_ERASE"),
    message(122, passes, 0, "LOG_REQUEST_END"),
    message(123, passes, 0, "GPS_INJECT_DATA"),
    message(126, setting, no_target, "SERIAL_CONTROL"),
    message(134, setting, no_target, "TERRAIN_DATA"), // heights that a return may be flown by
    message(139, setting, 41, "SET_ACTUATOR_CONTROL_TARGET"),
    message(144, person, no_target, "FOLLOW_TARGET"),
    message(149, person, no_target, "LANDING_TARGET"),
    message(157, passes, 12, "MOUNT_CONTROL"),
    message(160, owned, 8, "FENCE_POINT"),
    message(161, owned, 0, "FENCE_FETCH_POINT"),
    message(175, owned, 14, "RALLY_POINT"),
    message(176, owned, 0, "RALLY_FETCH_POINT"),
    message(183, passes, 0, "AUTOPILOT_VERSION_REQUEST"),
    message(232, setting, no_target, "GPS_INPUT"),
    message(233, passes, no_target, "GPS_RTCM_DATA"),
    message(243, disarmed, 52, "SET_HOME_POSITION", alone),
    message(246, setting, no_target, "ADSB_VEHICLE"), // an autopilot that avoids traffic leaves its way for it
    message(253, passes, no_target, "STATUSTEXT"),
    message(268, passes, 2, "LOGGING_ACK"),
    message(282, passes, 32, "GIMBAL_MANAGER_SET_ATTITUDE"),
    message(287, passes, 20, "GIMBAL_MANAGER_SET_PITCHYAW"),
    message(288, passes, 20, "GIMBAL_MANAGER_SET_MANUAL_CONTROL"),
    message(320, passes, 2, "PARAM_EXT_REQUEST_READ"),
    message(321, passes, 0, "PARAM_EXT_REQUEST_LIST"),
    message(323, passes, 0, "PARAM_EXT_SET"), // of cameras: no autopilot has such parameters
    message(331, setting, no_target, "ODOMETRY"),
    message(385, setting, 2, "TUNNEL"), // what is in it nobody here can tell
    message(412, passes, 4, "REQUEST_EVENT"),
};

constexpr command_row command(std::uint16_t number, pass_list on, std::string_view name, kind how = kind::command) {
  return {number, on, how, name};
}

// Sorted by number.
constexpr std::array commands{
    command(17, owned, "Loiter"),
    command(20, person, "Return", kind::stop),
    command(21, person, "Land", kind::stop),
    command(22, person, "Take off", kind::take_off),
    command(23, person, "Land", kind::stop), // NAV_LAND_LOCAL; PX4: NAV_PRECLAND
    command(24, person, "Take off", kind::take_off),
    command(34, person, "Orbit"),
    command(35, person, "Figure eight"),
    command(84, person, "Take off", kind::take_off), // NAV_VTOL_TAKEOFF
    command(85, person, "Land", kind::stop),         // NAV_VTOL_LAND
    command(115, person, "Heading"),
    command(176, person, "Mode"),
    command(178, person, "Speed"),
    command(179, disarmed, "Home"),
    command(185, person, "Terminate", kind::stop),
    command(186, person, "Height"),
    command(188, owned, "DO_RETURN_PATH_START"),
    command(189, owned, "DO_LAND_START"),
    command(191, person, "Go around"),
    command(192, owned, "Go to"),
    command(193, owned, "Pause"),
    command(195, person, "Region of interest"), // without a gimbal it turns the vehicle
    command(196, person, "Region of interest"),
    command(197, person, "Region of interest"),
    command(198, person, "Region of interest"),
    command(200, passes, "DO_CONTROL_VIDEO"),
    command(201, person, "Region of interest"),
    command(202, passes, "DO_DIGICAM_CONFIGURE"),
    command(203, passes, "DO_DIGICAM_CONTROL"),
    command(204, passes, "DO_MOUNT_CONFIGURE"),
    command(205, passes, "DO_MOUNT_CONTROL"),
    command(206, passes, "DO_SET_CAM_TRIGG_DIST"),
    command(207, person, "Fence"),
    command(208, person, "Parachute", kind::stop),
    command(209, setting, "DO_MOTOR_TEST"),
    command(211, passes, "DO_GRIPPER"),
    command(212, person, "Autotune"),
    command(214, passes, "DO_SET_CAM_TRIGG_INTERVAL"),
    command(218, person, "Switch"), // DO_AUX_FUNCTION: any switch of a remote control
    command(224, owned, "Set current"),
    command(241, disarmed, "Calibration"),
    command(242, disarmed, "Sensor offsets"),
    command(243, disarmed, "UAVCAN"),
    command(245, disarmed, "Storage"),
    command(246, disarmed, "Restart"),
    command(300, owned, "Mission start"),
    command(310, setting, "ACTUATOR_TEST"),
    command(311, disarmed, "Actuators"),
    command(400, person, "Arm", kind::arm), // disarm: see act_kind_of
    command(401, disarmed, "Checks"),       // RUN_PREARM_CHECKS
    command(410, passes, "GET_HOME_POSITION"),
    command(500, disarmed, "Pairing"), // START_RX_PAIR
    command(510, passes, "GET_MESSAGE_INTERVAL"),
    command(511, passes, "SET_MESSAGE_INTERVAL"),
    command(512, passes, "REQUEST_MESSAGE"),
    command(519, passes, "REQUEST_PROTOCOL_VERSION"),
    command(520, passes, "REQUEST_AUTOPILOT_CAPABILITIES"),
    command(521, passes, "REQUEST_CAMERA_INFORMATION"),
    command(522, passes, "REQUEST_CAMERA_SETTINGS"),
    command(525, passes, "REQUEST_STORAGE_INFORMATION"),
    command(526, passes, "STORAGE_FORMAT"), // of a camera
    command(527, passes, "REQUEST_CAMERA_CAPTURE_STATUS"),
    command(528, passes, "REQUEST_FLIGHT_INFORMATION"),
    command(529, passes, "RESET_CAMERA_SETTINGS"),
    command(530, passes, "SET_CAMERA_MODE"),
    command(531, passes, "SET_CAMERA_ZOOM"),
    command(532, passes, "SET_CAMERA_FOCUS"),
    command(534, passes, "SET_CAMERA_SOURCE"),
    command(611, disarmed, "Origin"), // DO_SET_GLOBAL_ORIGIN
    command(1000, passes, "DO_GIMBAL_MANAGER_PITCHYAW"),
    command(1001, passes, "DO_GIMBAL_MANAGER_CONFIGURE"),
    command(2000, passes, "IMAGE_START_CAPTURE"),
    command(2001, passes, "IMAGE_STOP_CAPTURE"),
    command(2003, passes, "DO_TRIGGER_CONTROL"),
    command(2500, passes, "VIDEO_START_CAPTURE"),
    command(2501, passes, "VIDEO_STOP_CAPTURE"),
    command(2502, passes, "VIDEO_START_STREAMING"),
    command(2503, passes, "VIDEO_STOP_STREAMING"),
    command(2504, passes, "REQUEST_VIDEO_STREAM_INFORMATION"),
    command(2505, passes, "REQUEST_VIDEO_STREAM_STATUS"),
    command(2510, passes, "LOGGING_START"),
    command(2511, passes, "LOGGING_STOP"),
    command(2600, passes, "CONTROL_HIGH_LATENCY"), // of lines that are slow by themselves
    command(3000, person, "Transition"),
    command(42001, person, "Solo's button"),
    command(42002, person, "Solo's button"),
    command(42003, person, "Solo's button"),
    command(42004, person, "Solo's button"),
    command(42006, disarmed, "Compass"), // FIXED_MAG_CAL_YAW
    command(42424, disarmed, "Compass"), // DO_START_MAG_CAL
    command(42425, disarmed, "Compass"), // DO_ACCEPT_MAG_CAL
    command(42426, disarmed, "Compass"), // DO_CANCEL_MAG_CAL
    command(43000, person, "Speed"),
    command(43001, person, "Height"),
    command(43002, person, "Heading"),
};

static_assert(std::ranges::is_sorted(messages, {}, &message_row::id));
static_assert(std::ranges::is_sorted(commands, {}, &command_row::command));

} // namespace

const message_row* find_message(std::uint32_t id) {
  const auto found = std::ranges::lower_bound(messages, id, {}, &message_row::id);
  return found != messages.end() && found->id == id ? &*found : nullptr;
}

const command_row* find_command(std::uint16_t number) {
  const auto found = std::ranges::lower_bound(commands, number, {}, &command_row::command);
  return found != commands.end() && found->command == number ? &*found : nullptr;
}

io::mavlink::sender target_of(const message_row& row, const io::mavlink::frame_view& frame) {
  if (row.target_at == no_target)
    return {};
  const auto at = static_cast<std::size_t>(row.target_at);
  return {byte_at(frame.payload(), at), row.names_component ? byte_at(frame.payload(), at + 1) : std::uint8_t{0}};
}

bool is_for_setting(std::string_view name) {
  const auto is_it = [&](const auto& each) { return each.on == setting && each.name == name; };
  return std::ranges::any_of(messages, is_it) || std::ranges::any_of(commands, is_it);
}

} // namespace godwit::ground_port::passing
