// What the journal keeps of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/operator_bridge/state.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::audited);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::command_ended);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::command_kept);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::control_changed);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::link_dropped);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::link_made);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::rows_moved);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::session_closed);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::session_opened);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::session_used);
GODWIT_DEFINE_MESSAGE(godwit::operator_bridge::state);
