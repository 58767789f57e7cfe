// What the journal keeps of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "runtime/define_message.hpp"
#include "tests/example/actors/odometer/state.hpp"

GODWIT_DEFINE_MESSAGE(godwit::odometer::state);
