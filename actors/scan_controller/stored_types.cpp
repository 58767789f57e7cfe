// What the journal keeps of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/scan_controller/state.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::scan_controller, clock_restarted, mission_begun, pass_advanced, pass_begun,
                       pass_completed, pass_delivered, pass_lost, point_dropped, point_opened, point_seen,
                       showing_begun, showing_ended, state, verdict_delivered);
