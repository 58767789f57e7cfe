// Who may say what to the executor.
//
// start_mission is told and not asked: what is told as a durable effect reaches the executor once in effect, also when
// asker or executor crash. The executor tells start_answer, as a durable effect of its own, to ground_port's
// start_answer_handle.
#pragma once

#include "messages/executor/types.hpp"
#include "runtime/seam.hpp"

namespace godwit::executor {

// What a ground station can cause.
using station_handle = runtime::mailbox<runtime::tells<start_mission>, runtime::asks<set_current, current_answer>,
                                        runtime::tells<plan_taken>, runtime::tells<plan_cleared>>;

} // namespace godwit::executor
