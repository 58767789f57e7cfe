// Who may say what to ground_port, and who hears what from it.
#pragma once

#include "io/mavlink/messages/clock.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/mission.hpp"
#include "io/mavlink/messages/position.hpp"
#include "io/mavlink/messages/vehicle_status.hpp"
#include "io/mavlink/messages/version.hpp"
#include "messages/executor/station_act.hpp"
#include "messages/executor/types.hpp"
#include "messages/ground_port/mission.hpp"
#include "messages/ground_port/types.hpp"
#include "messages/operator_bridge/control.hpp"
#include "messages/vehicle_link/evidence.hpp"
#include "runtime/seam.hpp"

namespace godwit::ground_port {

// The executor.
using handle = runtime::mailbox<runtime::tells<executor::start_answer>, runtime::tells<mission_progress>,
                                runtime::tells<item_reached>, runtime::tells<status_text>, runtime::tells<set_mission>,
                                runtime::tells<plan_judged>, runtime::tells<executor::act_resolved>,
                                runtime::asks<get_port, port_description>>;

// What the vehicle reports: the messages that are forwarded. Give this one to whoever listens for it.
using telemetry_handle =
    runtime::mailbox<runtime::tells<io::mavlink::heartbeat>, runtime::tells<io::mavlink::sys_status>,
                     runtime::tells<io::mavlink::system_time>, runtime::tells<io::mavlink::gps_raw_int>,
                     runtime::tells<io::mavlink::attitude>, runtime::tells<io::mavlink::global_position_int>,
                     runtime::tells<io::mavlink::mission_current>, runtime::tells<io::mavlink::mission_item_reached>,
                     runtime::tells<io::mavlink::vfr_hud>, runtime::tells<io::mavlink::battery_status>,
                     runtime::tells<io::mavlink::autopilot_version>, runtime::tells<io::mavlink::fence_status>,
                     runtime::tells<io::mavlink::home_position>, runtime::tells<io::mavlink::extended_sys_state>,
                     runtime::tells<io::mavlink::statustext>>;

// What its components say besides, as it came.
using relay_handle = runtime::mailbox<runtime::tells<vehicle_link::relayed_frame>>;

// The link's thread.
using wake_handle = runtime::mailbox<runtime::tells<wake>>;

// Who hears how the operator's link is.
using operator_ear = runtime::mailbox<runtime::tells<operator_link>>;

// Who knows who has control.
using control_handle = runtime::mailbox<runtime::tells<operator_bridge::control_news>>;

// All of it.
using own_handle = runtime::combine<handle, telemetry_handle, relay_handle, wake_handle, control_handle>;

} // namespace godwit::ground_port
