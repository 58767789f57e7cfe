// What the journal keeps of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/executor/preflight/bit_announcements.hpp"
#include "actors/executor/preflight/bit_events.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::executor::preflight::acknowledged);
GODWIT_DEFINE_MESSAGE(godwit::executor::preflight::acknowledgement_answered);
GODWIT_DEFINE_MESSAGE(godwit::executor::preflight::checks_wanted);
GODWIT_DEFINE_MESSAGE(godwit::executor::preflight::flight_ended);
GODWIT_DEFINE_MESSAGE(godwit::executor::preflight::looked);
GODWIT_DEFINE_MESSAGE(godwit::executor::preflight::mission_changed);
GODWIT_DEFINE_MESSAGE(godwit::executor::preflight::phase_changed);
GODWIT_DEFINE_MESSAGE(godwit::executor::preflight::report_opened);
GODWIT_DEFINE_MESSAGE(godwit::executor::preflight::restarted);
GODWIT_DEFINE_MESSAGE(godwit::executor::preflight::took_off);
