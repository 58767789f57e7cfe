// Who may say what to the executor.
//
// start_mission is told and not asked: what is told as a durable effect reaches the executor once in effect, also when
// asker or executor crash. The executor tells start_answer, as a durable effect of its own, to ground_port's
// start_answer_handle.
#pragma once

#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/mission.hpp"
#include "io/mavlink/messages/position.hpp"
#include "io/mavlink/messages/traffic.hpp"
#include "io/mavlink/messages/vehicle_status.hpp"
#include "messages/executor/flight.hpp"
#include "messages/executor/known_missions.hpp"
#include "messages/executor/plan_view.hpp"
#include "messages/executor/station_act.hpp"
#include "messages/executor/traffic.hpp"
#include "messages/executor/types.hpp"
#include "messages/failsafe/types.hpp"
#include "messages/mission_client/handle.hpp"
#include "messages/operator/types.hpp"
#include "messages/scan_controller/handle.hpp"
#include "messages/vehicle_link/types.hpp"
#include "runtime/seam.hpp"
#include "runtime/supervision/messages.hpp"

namespace godwit::executor {

// What a ground station can cause.
using station_handle =
    runtime::mailbox<runtime::tells<start_mission>, runtime::asks<set_current, current_answer>,
                     runtime::tells<plan_taken>, runtime::tells<plan_cleared>, runtime::asks<station_act, act_answer>,
                     runtime::tells<act_acknowledged>, runtime::asks<operators::command, operators::answer>>;

// What an operator can cause, and see.
using operator_handle =
    runtime::mailbox<runtime::asks<operators::command, operators::answer>, runtime::asks<get_flight, flight_status>>;

// What those ask for who show a flight; they can cause nothing.
using view_handle = runtime::mailbox<runtime::asks<get_plan, plan_view>, runtime::asks<get_preflight, preflight_view>,
                                     runtime::asks<get_traffic, heard_traffic>>;

// The missions that it knows.
using missions_handle = runtime::mailbox<runtime::asks<get_missions, known_missions>>;

// Who shows a flight to people, and is told what changes beside its status.
using viewer =
    runtime::mailbox<runtime::tells<known_missions>, runtime::tells<way_home_estimate>, runtime::tells<heard_traffic>>;

// Who is told how the flight stands, when it stands otherwise than before.
using flight_watcher = runtime::mailbox<runtime::tells<flight_status>>;

// What the vehicle says, as far as the executor listens. vehicle_link tells its listeners.
using telemetry_handle =
    runtime::mailbox<runtime::tells<io::mavlink::heartbeat>, runtime::tells<io::mavlink::sys_status>,
                     runtime::tells<io::mavlink::gps_raw_int>, runtime::tells<io::mavlink::global_position_int>,
                     runtime::tells<io::mavlink::home_position>, runtime::tells<io::mavlink::extended_sys_state>,
                     runtime::tells<io::mavlink::mission_current>, runtime::tells<io::mavlink::mission_item_reached>,
                     runtime::tells<io::mavlink::ekf_status_report>, runtime::tells<io::mavlink::estimator_status>,
                     runtime::tells<io::mavlink::current_mode>, runtime::tells<io::mavlink::statustext>,
                     runtime::tells<io::mavlink::adsb_vehicle>, runtime::tells<io::mavlink::collision>,
                     runtime::tells<vehicle_link::connection_changed>, runtime::tells<vehicle_link::vehicle_restarted>,
                     runtime::tells<vehicle_link::foreign_act>, runtime::tells<vehicle_link::line_findings>,
                     runtime::tells<vehicle_link::picture_taken>>;

// All of it.
using own_handle = runtime::combine<mission_client::listener_handle, operator_handle, view_handle, missions_handle,
                                    station_handle, telemetry_handle, scan_controller::subscriber_handle,
                                    runtime::mailbox<runtime::tells<failsafe::failsafe_status>,
                                                     runtime::tells<runtime::child_event>, runtime::tells<tick>>>;

} // namespace godwit::executor
