// What the journal keeps of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/operator_bridge/state.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::operator_bridge, audited, command_ended, command_kept, control_changed, link_dropped,
                       link_made, rows_moved, session_closed, session_opened, session_used, state);
