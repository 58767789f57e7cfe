// What the journal keeps of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/ground_port/state.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::ground_port::plan_noted);
GODWIT_DEFINE_MESSAGE(godwit::ground_port::plan_resolved);
GODWIT_DEFINE_MESSAGE(godwit::ground_port::signing_time_reserved);
GODWIT_DEFINE_MESSAGE(godwit::ground_port::start_item_noted);
GODWIT_DEFINE_MESSAGE(godwit::ground_port::start_item_resolved);
GODWIT_DEFINE_MESSAGE(godwit::ground_port::start_noted);
GODWIT_DEFINE_MESSAGE(godwit::ground_port::start_resolved);
GODWIT_DEFINE_MESSAGE(godwit::ground_port::state);
