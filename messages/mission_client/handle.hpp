// Who may say what to mission_client, and what the executor has to understand.
//
// What mission_client tells its listener is a durable effect each time: once in effect, also over crashes of both.
#pragma once

#include "messages/mission_client/types.hpp"
#include "runtime/seam.hpp"

namespace godwit::mission_client {

// What the executor may ask for.
using flight_handle =
    runtime::mailbox<runtime::tells<begin_mission>, runtime::tells<begin_next>, runtime::tells<pull_map>,
                     runtime::tells<accept_copy>, runtime::tells<push_map>, runtime::tells<report_progress>,
                     runtime::tells<respond_to_assignment>, runtime::tells<insert_waypoint>,
                     runtime::tells<replace_tail>, runtime::asks<get_service, service_status>>;

// What the operator may ask for.
using operator_handle =
    runtime::mailbox<runtime::asks<retry_outbox, retry_answer>, runtime::asks<get_service, service_status>>;

// Who has pictures.
using picture_handle = runtime::mailbox<runtime::asks<deliver_picture, picture_noted>>;

// Whom mission_client tells: the executor.
using listener_handle =
    runtime::mailbox<runtime::tells<mission_loaded>, runtime::tells<mission_refused>, runtime::tells<map_pulled>,
                     runtime::tells<change_outcome>, runtime::tells<assignment_arrived>,
                     runtime::tells<mission_deleted>, runtime::tells<mission_resolved>, runtime::tells<earlier_found>>;

// The thread of the connection to the service.
using wake_handle = runtime::mailbox<runtime::tells<wake>>;

// All that mission_client takes.
using own_handle = runtime::mailbox<
    runtime::tells<begin_mission>, runtime::tells<begin_next>, runtime::tells<pull_map>, runtime::tells<accept_copy>,
    runtime::tells<push_map>, runtime::tells<report_progress>, runtime::tells<respond_to_assignment>,
    runtime::tells<insert_waypoint>, runtime::tells<replace_tail>, runtime::asks<get_service, service_status>,
    runtime::asks<retry_outbox, retry_answer>, runtime::asks<deliver_picture, picture_noted>, runtime::tells<wake>>;

} // namespace godwit::mission_client
