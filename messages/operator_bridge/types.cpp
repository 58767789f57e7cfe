// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/operator_bridge/audit.hpp"
#include "messages/operator_bridge/command.hpp"
#include "messages/operator_bridge/control.hpp"
#include "messages/operator_bridge/session.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::accounts_read);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::ask_leave);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::audit_leave);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::audit_note);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::audit_page);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::change_control);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::command_answer);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::control_answer);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::control_news);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::end_session);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::get_operators);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::identify);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::identity);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::leave);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::link_answer);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::make_link);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::open_session);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::operator_command);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::operators_view);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::read_audit);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::session_answer);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::session_ended);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::use_link);
