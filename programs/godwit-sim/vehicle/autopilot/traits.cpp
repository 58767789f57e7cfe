#include "programs/godwit-sim/vehicle/autopilot/traits.hpp"

#include "programs/godwit-sim/vehicle/autopilot/param_list.hpp"
#include "runtime/assert.hpp"

namespace godwit::sim {

namespace {

using mavlink::mav_result;

// MAV_PROTOCOL_CAPABILITY: mission float 1, param float 2, mission int 4, command int 8, param encoded by bytes 16, by
// value 131072, MAVLink 2 8192, mission fence 16384, mission rally 32768.
constexpr std::uint64_t rover_capabilities = 1 | 2 | 4 | 8 | 8192 | 16384 | 32768 | 131072;

traits rover_traits() {
  traits t;
  t.type = mavlink::mav_type::ground_rover;
  t.autopilot = mavlink::mav_autopilot::generic;
  t.body = rover_craft();
  t.modes = rover_modes();
  t.first_mode = 4; // HOLD
  t.plan_profile = plans::plain_profile();
  t.params = rover_params();
  t.param_encoding = role::param_encoding::as_value;
  t.streams = rover_streams();
  t.knows_stream_groups = true;
  t.unknown_message = mav_result::denied;
  t.unknown_interval = mav_result::denied;
  t.timesync_target = timesync_target::asker;
  t.sensors = {0x1200'002F | prearm_bit, 0x1200'002F | prearm_bit, 0x1200'002F | prearm_bit};
  t.version.capabilities = rover_capabilities;
  t.version.flight_sw_version = 0x0001'00FF; // 0.1.0, release
  return t;
}

// Of 1.17: armed by a start, "Takeoff detected" 1.74 to 1.83 s later.
constexpr double px4_spool_up_s = 1.8;

traits px4_traits() {
  traits t;
  t.type = mavlink::mav_type::quadrotor;
  t.autopilot = mavlink::mav_autopilot::px4;
  t.body = multirotor_craft();
  t.boots_ns = 3 * ns_per_s; // UNINIT
  t.body.spool_up_s = px4_spool_up_s;
  t.modes = px4_modes();
  t.first_mode = px4_mode(4, 3); // AUTO.LOITER
  t.plan_profile = plans::px4_profile();
  t.plan_profile.profile = mission::vehicle_profile::px4_multicopter;
  t.params = px4_params();
  t.param_encoding = role::param_encoding::as_bits;
  t.streams = px4_streams();
  t.current_is_a_request_away = false;
  t.sends_before_ack = true;
  // Mavlink::handleAndGetCurrentCommandAck: where MavlinkReceiver::component_was_seen; handle_message_set_mode.
  t.acknowledges_where_heard = true;
  t.acknowledges_set_mode = true;
  t.unknown_message = mav_result::denied;
  t.unknown_interval = mav_result::failed;
  t.numbers_each_text = true;
  t.tells_intended_mode = true;
  t.sets_home_when_armed = true;
  t.home_is_free_again = true;
  t.timesync_target = timesync_target::system_of_asker;
  t.sensors = {50348079, 50413615, 320915519};
  t.version.capabilities = 59647;
  t.version.flight_sw_version = 17891583; // 1.17.0, release
  t.version.middleware_sw_version = 17891583;
  t.version.os_sw_version = 101854463;
  t.version.board_version = 1;
  t.version.flight_custom_version = {0x00, 0x00, 0x00, 0x4b, 0x17, 0xda, 0xe0, 0x1c};
  t.version.middleware_custom_version = t.version.flight_custom_version;
  return t;
}

// What its vehicles have in common.
traits ardupilot_traits() {
  traits t;
  t.boots_ns = 2 * ns_per_s; // BOOT at 1.05, STANDBY at 3.07
  t.autopilot = mavlink::mav_autopilot::ardupilotmega;
  t.param_encoding = role::param_encoding::as_value;
  t.has_param_file = true;
  t.hides_param_index = true;
  t.streams = ardupilot_streams();
  t.knows_stream_groups = true;
  t.tells_current_on_change = false;
  t.unknown_message = mav_result::failed;
  t.unknown_interval = mav_result::denied;
  // MissionItemProtocol_Waypoints::complete and ::timeout say it with the send_text of their link.
  t.texts_for_uploader = {"Flight plan received", "Mission upload timeout"};
  t.flies_to_items = true; // GCS_MAVLINK::handle_mission_item
  t.answers_ping = false;
  t.hears_any_component = true;
  t.tells_stale_position = true;
  t.beats_at_mode_change = true;
  t.sets_home_when_armed = true;
  t.timesync_target = timesync_target::nobody;
  t.sensors = {322034735, 320986159, 322034991};
  t.fix_type = 6;                     // as its own simulator's receiver
  t.ready_after_ns = 5 * ns_per_s;    // a real one takes 35 to 40 s
  t.estimate_after_ns = 6 * ns_per_s; // and some 16 s more, in which it is not armed though its checks pass
  t.total_of_no_mission = 0;
  t.version.capabilities = 61935;
  t.version.flight_sw_version = 67567616; // 4.7.0, development
  t.version.flight_custom_version = {'9', '9', 'e', 'a', '6', '0', 'e', 'b'};
  t.tells_protocol_version = false;
  return t;
}

traits copter_traits() {
  auto t = ardupilot_traits();
  t.type = mavlink::mav_type::quadrotor;
  t.body = multirotor_craft();
  t.body.spool_up_s = 3.3; // of 4.7: landed until 3.29 s after it had acknowledged MISSION_START
  t.modes = copter_modes();
  t.first_mode = 0; // STABILIZE
  t.plan_profile = plans::ardupilot_copter_profile();
  t.plan_profile.profile = mission::vehicle_profile::arducopter;
  t.params = copter_params();
  t.banner = {"ArduCopter V4.7.0-dev (99ea60eb)", "3d1219c7c4c5404aaa1f6d2a48adfda4", "Frame: QUAD/PLUS"};
  return t;
}

traits plane_traits() {
  auto t = ardupilot_traits();
  t.type = mavlink::mav_type::fixed_wing;
  t.body = fixed_wing_craft();
  t.modes = plane_modes();
  t.first_mode = 0; // MANUAL
  t.plan_profile = plans::ardupilot_plane_profile();
  t.plan_profile.profile = mission::vehicle_profile::arduplane;
  t.params = plane_params();
  t.banner = {"ArduPlane V4.7.0-dev (99ea60eb)", "3d1219c7c4c5404aaa1f6d2a48adfda4"};
  return t;
}

traits quadplane_traits() {
  auto t = plane_traits();
  t.body = vtol_craft();
  t.body.takes_off_to_place = false;
  t.modes = quadplane_modes();
  t.plan_profile.profile = mission::vehicle_profile::quadplane;
  return t;
}

traits px4_vtol_traits() {
  auto t = px4_traits();
  t.type = mavlink::mav_type::vtol_fixedrotor;
  t.body = vtol_craft();
  t.body.lands_on_return = true;
  t.body.spool_up_s = px4_spool_up_s;
  t.plan_profile.profile = mission::vehicle_profile::px4_vtol;
  return t;
}

traits ardurover_traits() {
  auto t = ardupilot_traits();
  t.type = mavlink::mav_type::ground_rover;
  t.body = rover_craft();
  t.modes = ardurover_modes();
  t.first_mode = 0; // MANUAL
  t.plan_profile = plans::ardupilot_rover_profile();
  t.plan_profile.profile = mission::vehicle_profile::ardurover;
  t.params = copter_params(); // those that stations ask for are the same
  t.banner = {"ArduRover V4.7.0-dev (99ea60eb)", "3d1219c7c4c5404aaa1f6d2a48adfda4"};
  return t;
}

} // namespace

const traits& traits_of(personality who) {
  static const traits rover = rover_traits();
  static const traits px4 = px4_traits();
  static const traits copter = copter_traits();
  static const traits plane = plane_traits();
  static const traits ardurover = ardurover_traits();
  static const traits quadplane = quadplane_traits();
  static const traits px4_vtol = px4_vtol_traits();
  switch (who) {
  case personality::rover:
    return rover;
  case personality::px4:
    return px4;
  case personality::ardupilot:
    return copter;
  case personality::plane:
    return plane;
  case personality::ardurover:
    return ardurover;
  case personality::quadplane:
    return quadplane;
  case personality::px4_vtol:
    return px4_vtol;
  }
  GODWIT_ASSERT(false, "each personality has its traits");
}

} // namespace godwit::sim
