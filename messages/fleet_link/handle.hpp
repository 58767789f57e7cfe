// Who may say what to fleet_link. Hand out the narrowest handle that serves.
#pragma once

#include "messages/executor/flight.hpp"
#include "messages/failsafe/types.hpp"
#include "messages/fleet_link/types.hpp"
#include "messages/health/types.hpp"
#include "messages/scan_controller/handle.hpp"
#include "runtime/seam.hpp"

namespace godwit::fleet_link {

// The port of the broker.
using port_handle = runtime::mailbox<runtime::tells<broker_opened>, runtime::tells<broker_closed>,
                                     runtime::tells<event_taken>, runtime::tells<text_left>>;

using status_handle = runtime::mailbox<runtime::asks<get_fleet, fleet_view>>;

// All of it; what becomes an event comes from executor, failsafe, health and scan_controller.
using own_handle =
    runtime::combine<port_handle, status_handle, scan_controller::subscriber_handle,
                     runtime::mailbox<runtime::tells<executor::flight_status>, runtime::tells<health::health_status>,
                                      runtime::tells<failsafe::failsafe_status>>>;

} // namespace godwit::fleet_link
