// What the vehicle says and actors tell each other: JSON and binary forms (runtime/define_message.hpp).
#include "io/mavlink/messages/clock.hpp"
#include "io/mavlink/messages/gimbal.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/mission.hpp"
#include "io/mavlink/messages/position.hpp"
#include "io/mavlink/messages/traffic.hpp"
#include "io/mavlink/messages/vehicle_status.hpp"
#include "io/mavlink/messages/version.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::io::mavlink, adsb_vehicle, attitude, autopilot_version, battery_status, collision,
                       current_mode, ekf_status_report, estimator_status, extended_sys_state, fence_status,
                       gimbal_device_attitude_status, global_position_int, gps_raw_int, heartbeat, home_position,
                       mission_current, mission_item_reached, radio_status, statustext, sys_status, system_time,
                       vfr_hud);
