// Who may say what to the run on the ground.
#pragma once

#include "messages/mission_client/handle.hpp"
#include "messages/vehicle_link/types.hpp"
#include "programs/godwitd/ground_run/messages.hpp"
#include "runtime/seam.hpp"

namespace godwit::ground_run {

using feed_handle = runtime::mailbox<runtime::tells<woken>>;
using status_handle = runtime::mailbox<runtime::asks<get_run, run_status>>;

using own_handle =
    mission_client::listener_handle::extend<runtime::tells<vehicle_link::connection_changed>::signature,
                                            runtime::tells<woken>::signature, runtime::tells<tick>::signature,
                                            runtime::tells<retry_due>::signature,
                                            runtime::asks<get_run, run_status>::signature>;

} // namespace godwit::ground_run
