// Who may say what to vehicle_link, and who hears what from it.
//
// Hand out the narrowest handle that serves: most need only to send commands. What the vehicle says is told to
// listeners message by message; a listener accepts those that it wants (see listeners.hpp of the actor).
#pragma once

#include "messages/vehicle_link/types.hpp"
#include "runtime/seam.hpp"
#include "runtime/supervision/handle.hpp"

namespace godwit::vehicle_link {

// Commands alone.
using command_handle = runtime::mailbox<runtime::asks<send_command, command_outcome>>;

// Who flies the vehicle.
using handle =
    runtime::mailbox<runtime::asks<send_command, command_outcome>, runtime::tells<set_mode>,
                     runtime::asks<set_current_item, command_outcome>, runtime::asks<upload_plan, transfer::outcome>,
                     runtime::asks<download_plan, transfer::outcome>, runtime::tells<cancel_transfer>,
                     runtime::asks<set_up_signing, signing_answer>, runtime::asks<get_connection, connection>,
                     runtime::asks<look, looked>, runtime::tells<watch_closely>, runtime::tells<keep_vehicle>>;

// The link's thread.
using wake_handle = runtime::mailbox<runtime::tells<wake>>;

// Who passes on to the vehicle what ground stations say.
using relay_handle = runtime::mailbox<runtime::tells<relayed_frame>>;

// All of it.
using own_handle = runtime::combine<handle, relay_handle, wake_handle, runtime::liveness_handle>;

} // namespace godwit::vehicle_link
