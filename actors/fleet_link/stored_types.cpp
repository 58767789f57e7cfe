// What the journal and the trace keep of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/fleet_link/actor.hpp"
#include "actors/fleet_link/state.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::fleet_link::delivered);
GODWIT_DEFINE_MESSAGE(godwit::fleet_link::live_text);
GODWIT_DEFINE_MESSAGE(godwit::fleet_link::noted);
GODWIT_DEFINE_MESSAGE(godwit::fleet_link::state);
GODWIT_DEFINE_MESSAGE(godwit::fleet_link::store_named);
GODWIT_DEFINE_MESSAGE(godwit::fleet_link::written);
