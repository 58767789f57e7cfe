// What the journal and the trace keep of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/fleet_link/actor.hpp"
#include "actors/fleet_link/state.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::fleet_link, delivered, live_text, noted, state, store_named, written);
