// What the journal keeps of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/vehicle_link/state.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::signing_time_reserved);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::state);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::vehicle_kept);
