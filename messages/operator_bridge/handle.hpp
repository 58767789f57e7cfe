// Who may say what to operator_bridge.
#pragma once

#include "messages/operator_bridge/audit.hpp"
#include "messages/operator_bridge/command.hpp"
#include "messages/operator_bridge/control.hpp"
#include "messages/operator_bridge/session.hpp"
#include "runtime/seam.hpp"

namespace godwit::operator_bridge {

// Who brings what operators say, and has made sure of the principal.
using handler_handle =
    runtime::mailbox<runtime::asks<operator_command, command_answer>, runtime::asks<change_control, control_answer>,
                     runtime::asks<get_operators, operators_view>, runtime::asks<read_audit, audit_leave>,
                     runtime::tells<audit_note>, runtime::asks<make_link, link_answer>,
                     runtime::asks<ask_leave, leave>>;

// Who lets operators in.
using door_handle = runtime::mailbox<runtime::asks<open_session, session_answer>,
                                     runtime::asks<use_link, session_answer>, runtime::asks<identify, identity>,
                                     runtime::asks<end_session, session_ended>, runtime::tells<audit_note>>;

// Who has to know who has control.
using control_listener = runtime::mailbox<runtime::tells<control_news>>;

// Who counts whoever has control as somebody who is there.
using holder_ear = runtime::mailbox<runtime::tells<holder_heard>>;

// Who reads the accounts.
using accounts_handle = runtime::mailbox<runtime::tells<accounts_read>>;

// All of it.
using own_handle = runtime::combine<handler_handle, door_handle, accounts_handle>;

} // namespace godwit::operator_bridge
