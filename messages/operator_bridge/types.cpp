// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/operator_bridge/audit.hpp"
#include "messages/operator_bridge/command.hpp"
#include "messages/operator_bridge/control.hpp"
#include "messages/operator_bridge/session.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::operator_bridge, accounts_read, ask_leave, audit_leave, audit_note, audit_page,
                       change_control, command_answer, control_answer, control_news, end_session, get_operators,
                       holder_heard, identify, identity, leave, link_answer, make_link, open_session, operator_command,
                       operators_view, read_audit, session_answer, session_ended, use_link);
