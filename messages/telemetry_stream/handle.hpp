// What the stream of telemetry hears. It is asked nothing: who wants to see takes part as a subscriber of its hub.
#pragma once

#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/position.hpp"
#include "messages/executor/flight.hpp"
#include "messages/executor/known_missions.hpp"
#include "messages/executor/traffic.hpp"
#include "messages/health/types.hpp"
#include "messages/scan_controller/handle.hpp"
#include "messages/vehicle_link/connection.hpp"
#include "runtime/seam.hpp"

namespace godwit::telemetry_stream {

using own_handle = runtime::combine<
    runtime::mailbox<runtime::tells<io::mavlink::global_position_int>, runtime::tells<io::mavlink::attitude>,
                     runtime::tells<io::mavlink::sys_status>, runtime::tells<io::mavlink::gps_raw_int>,
                     runtime::tells<io::mavlink::home_position>, runtime::tells<vehicle_link::connection_changed>,
                     runtime::tells<executor::flight_status>, runtime::tells<executor::known_missions>,
                     runtime::tells<executor::way_home_estimate>, runtime::tells<executor::heard_traffic>,
                     runtime::tells<health::health_status>>,
    scan_controller::subscriber_handle>;

} // namespace godwit::telemetry_stream
