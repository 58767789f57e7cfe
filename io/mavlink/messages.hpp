// All messages that godwit reads and writes. A new one is a struct with its table in messages/ and its name here.
//
// The list is short on purpose: each entry is something that a peer can say to us. Of all other messages only the
// checksum is verified (io/mavlink/ids.hpp). Thread: pure.
#pragma once

#include "io/mavlink/message_list.hpp"
#include "io/mavlink/messages/battery.hpp"
#include "io/mavlink/messages/clock.hpp"
#include "io/mavlink/messages/command.hpp"
#include "io/mavlink/messages/estimator.hpp"
#include "io/mavlink/messages/fence.hpp"
#include "io/mavlink/messages/gimbal.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/mission.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "io/mavlink/messages/param.hpp"
#include "io/mavlink/messages/position.hpp"
#include "io/mavlink/messages/radio.hpp"
#include "io/mavlink/messages/setup_signing.hpp"
#include "io/mavlink/messages/version.hpp"

namespace godwit::io::mavlink {

using known_messages =
    message_list<heartbeat, sys_status, system_time, ping, set_mode, param_request_read, param_request_list,
                 param_value, param_set, gps_raw_int, attitude, global_position_int, mission_item, mission_request,
                 mission_set_current, mission_current, mission_request_list, mission_count, mission_clear_all,
                 mission_item_reached, mission_ack, mission_request_int, mission_item_int, vfr_hud, command_int,
                 command_long, command_ack, command_cancel, radio_status, timesync, battery_status, autopilot_version,
                 fence_status, ekf_status_report, estimator_status, home_position, extended_sys_state, statustext,
                 setup_signing, gimbal_device_attitude_status, protocol_version>;

// Decodes FRAME and calls F(const M&) with the message; false if it is not one of ours.
template <class F>
bool visit(const frame_view& frame, F&& f) {
  return known_messages::visit(frame, f);
}

} // namespace godwit::io::mavlink
