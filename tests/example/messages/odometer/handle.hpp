// The typed mailboxes: what can be said to an odometer, and to whoever listens to one.
#pragma once

#include "runtime/seam.hpp"
#include "tests/example/messages/odometer/types.hpp"

namespace godwit::odometer {

using handle =
    runtime::mailbox<runtime::tells<moved>, runtime::asks<reset, reset_done>, runtime::asks<get_total, total>>;
using listener_handle = runtime::mailbox<runtime::tells<milestone>>;

} // namespace godwit::odometer
