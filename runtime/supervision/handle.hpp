// Who may say what to the guardian, and whom it tells what happens. Thread: plain values.
#pragma once

#include "runtime/seam.hpp"
#include "runtime/supervision/messages.hpp"

namespace godwit::runtime {

using guardian_handle = mailbox<asks<get_children, children>, asks<supervise, supervised>>;
using supervisor_handle = mailbox<tells<child_event>>;
using liveness_handle = mailbox<tells<child_alive>>;

} // namespace godwit::runtime
