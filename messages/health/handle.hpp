// Who may ask how the program is, and who is told.
#pragma once

#include "messages/health/types.hpp"
#include "runtime/seam.hpp"

namespace godwit::health {

using status_handle = runtime::mailbox<runtime::asks<get_health, health_status>>;
using report_handle = runtime::mailbox<runtime::tells<make_report>>;
using listener_handle = runtime::mailbox<runtime::tells<health_status>>;

// All of it.
using own_handle = runtime::mailbox<runtime::asks<get_health, health_status>, runtime::tells<make_report>>;

} // namespace godwit::health
