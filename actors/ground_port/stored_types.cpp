// What the journal keeps of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/ground_port/state.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::ground_port, plan_noted, plan_resolved, signing_time_reserved, start_item_noted,
                       start_item_resolved, start_noted, start_resolved, state);
