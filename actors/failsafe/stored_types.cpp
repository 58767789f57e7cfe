// What the journal keeps of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/failsafe/reaction.hpp"
#include "actors/failsafe/state.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::failsafe::command_vehicle);
GODWIT_DEFINE_MESSAGE(godwit::failsafe::remembered);
GODWIT_DEFINE_MESSAGE(godwit::failsafe::state);
