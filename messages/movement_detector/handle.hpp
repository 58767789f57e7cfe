// Who may say what to movement_detector. Hand out the narrowest handle that serves.
#pragma once

#include "io/mavlink/messages/gimbal.hpp"
#include "io/mavlink/messages/position.hpp"
#include "messages/mapobjects_store/observation.hpp"
#include "messages/movement_detector/types.hpp"
#include "messages/scan_controller/handle.hpp"
#include "runtime/seam.hpp"

namespace godwit::movement_detector {

// The port of the helper process.
using port_handle =
    runtime::mailbox<runtime::tells<helper_status>, runtime::tells<helper_candidates>, runtime::tells<helper_ended>>;

using status_handle = runtime::mailbox<runtime::asks<get_eyes, eyes_view>>;

// All of it; where the vehicle is and how it lies comes from vehicle_link, what is flown from the executor.
using own_handle = runtime::combine<
    port_handle, status_handle, scan_controller::flight_handle,
    runtime::mailbox<runtime::tells<io::mavlink::global_position_int>, runtime::tells<io::mavlink::attitude>,
                     runtime::tells<io::mavlink::gimbal_device_attitude_status>>>;

// Who takes what was seen.
using sightings_handle = runtime::mailbox<runtime::tells<mapobjects_store::sighting>>;

} // namespace godwit::movement_detector
