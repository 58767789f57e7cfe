// What the journal keeps of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/failsafe/reaction.hpp"
#include "actors/failsafe/state.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::failsafe, command_vehicle, remembered, state);
