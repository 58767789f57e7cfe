// Who may say what to the run on the ground.
#pragma once

#include "messages/mission_client/handle.hpp"
#include "messages/vehicle_link/types.hpp"
#include "programs/godwitd/ground_run/messages.hpp"
#include "runtime/seam.hpp"

namespace godwit::ground_run {

using feed_handle = runtime::mailbox<runtime::tells<woken>>;
using status_handle = runtime::mailbox<runtime::asks<get_run, run_status>>;

using own_handle = runtime::combine<
    mission_client::listener_handle,
    runtime::mailbox<runtime::tells<vehicle_link::connection_changed>, runtime::tells<woken>, runtime::tells<tick>,
                     runtime::tells<retry_due>, runtime::asks<get_run, run_status>>>;

} // namespace godwit::ground_run
