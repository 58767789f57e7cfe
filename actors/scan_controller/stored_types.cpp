// What the journal keeps of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/scan_controller/state.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::scan_controller::clock_restarted);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::mission_begun);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::pass_advanced);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::pass_begun);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::pass_completed);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::pass_delivered);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::pass_lost);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::point_dropped);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::point_opened);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::point_seen);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::showing_begun);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::showing_ended);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::state);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::verdict_delivered);
