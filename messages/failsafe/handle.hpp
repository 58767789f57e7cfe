// Who may say what to the failsafe, and what it needs others to accept.
#pragma once

#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/mission.hpp"
#include "io/mavlink/messages/position.hpp"
#include "messages/failsafe/types.hpp"
#include "messages/ground_port/mission.hpp"
#include "messages/ground_port/types.hpp"
#include "messages/operator_bridge/control.hpp"
#include "messages/vehicle_link/types.hpp"
#include "runtime/seam.hpp"

namespace godwit::failsafe {

// The executor, and whoever speaks for an authenticated operator.
using handle = runtime::mailbox<runtime::asks<guard_mission, guard_answer>, runtime::tells<expect_mode>,
                                runtime::tells<taken_over>, runtime::tells<command_pending>, runtime::tells<following>,
                                runtime::tells<hand_back>, runtime::asks<override_rule, override_answer>,
                                runtime::asks<get_failsafe_status, failsafe_status>, runtime::tells<return_taken>>;

// What the vehicle says. vehicle_link tells its listeners.
using telemetry_handle =
    runtime::mailbox<runtime::tells<io::mavlink::heartbeat>, runtime::tells<io::mavlink::extended_sys_state>,
                     runtime::tells<io::mavlink::global_position_int>, runtime::tells<io::mavlink::home_position>,
                     runtime::tells<io::mavlink::sys_status>, runtime::tells<io::mavlink::mission_current>,
                     runtime::tells<io::mavlink::current_mode>, runtime::tells<io::mavlink::statustext>,
                     runtime::tells<vehicle_link::connection_changed>, runtime::tells<vehicle_link::foreign_act>>;

// All of it; ground_port tells operator_link, operator_bridge holder_heard.
using own_handle =
    runtime::combine<handle, telemetry_handle,
                     runtime::mailbox<runtime::tells<ground_port::operator_link>,
                                      runtime::tells<operator_bridge::holder_heard>, runtime::tells<tick>>>;

// What the failsafe needs of the link to the vehicle.
using vehicle_handle = runtime::mailbox<runtime::asks<vehicle_link::send_command, vehicle_link::command_outcome>,
                                        runtime::tells<vehicle_link::set_mode>>;

// Who hears how the failsafe stands.
using failsafe_status_ear = runtime::mailbox<runtime::tells<failsafe_status>>;

// Who passes its warnings on to people.
using people_handle = runtime::mailbox<runtime::tells<ground_port::status_text>>;

} // namespace godwit::failsafe
