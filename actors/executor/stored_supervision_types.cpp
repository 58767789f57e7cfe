// What the journal keeps of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/executor/supervision/state.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::executor::supervision::failsafe_missed);
