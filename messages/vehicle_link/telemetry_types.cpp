// What the vehicle says and actors tell each other: JSON and binary forms (runtime/define_message.hpp).
#include "io/mavlink/messages/clock.hpp"
#include "io/mavlink/messages/gimbal.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/mission.hpp"
#include "io/mavlink/messages/position.hpp"
#include "io/mavlink/messages/vehicle_status.hpp"
#include "io/mavlink/messages/version.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::attitude);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::autopilot_version);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::battery_status);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::current_mode);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::ekf_status_report);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::estimator_status);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::extended_sys_state);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::fence_status);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::gimbal_device_attitude_status);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::global_position_int);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::gps_raw_int);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::heartbeat);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::home_position);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::mission_current);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::mission_item_reached);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::radio_status);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::statustext);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::sys_status);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::system_time);
GODWIT_DEFINE_MESSAGE(godwit::io::mavlink::vfr_hud);
