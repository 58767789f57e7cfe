// Who may say what to scan_controller, and what it tells its subscribers. Hand out the narrowest handle that serves.
#pragma once

#include "io/mavlink/messages/position.hpp"
#include "messages/scan_controller/types.hpp"
#include "runtime/seam.hpp"

namespace godwit::scan_controller {

// Who recognises things.
using candidate_handle = runtime::mailbox<runtime::asks<candidate, candidate_answer>>;

// Who speaks for an operator.
using operator_handle = runtime::mailbox<runtime::asks<get_points, points>, runtime::asks<decide_point, decide_answer>>;

// Who flies.
using flight_handle = runtime::mailbox<runtime::tells<survey_progress>>;

// Who looks at the ground.
using view_handle = runtime::mailbox<runtime::tells<view>>;

// All of it; where the vehicle is comes from vehicle_link.
using own_handle = runtime::combine<candidate_handle, operator_handle, flight_handle, view_handle,
                                    runtime::mailbox<runtime::tells<io::mavlink::global_position_int>>>;

// Who wants to know which points are shown. Both are durable effects: once in effect for each.
using subscriber_handle = runtime::mailbox<runtime::tells<point_shown>, runtime::tells<point_closed>>;

} // namespace godwit::scan_controller
