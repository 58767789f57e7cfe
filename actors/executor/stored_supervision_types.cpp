// What the journal keeps of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/supervision/state.hpp"
#include "actors/executor/supervision/table.hpp"
#include "runtime/define_message.hpp"

// What comes in beside the mailbox, for the trace.
GODWIT_DEFINE_MESSAGE(godwit::executor::preflight::camera_fact);
GODWIT_DEFINE_MESSAGE(godwit::executor::preflight::journal_facts);
GODWIT_DEFINE_MESSAGE(godwit::executor::preflight::operator_fact);
GODWIT_DEFINE_MESSAGE(godwit::executor::preflight::program_fact);
GODWIT_DEFINE_MESSAGE(godwit::executor::supervision::own_process);

GODWIT_DEFINE_MESSAGE(godwit::executor::supervision::failsafe_missed);
