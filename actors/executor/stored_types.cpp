// What the journal keeps of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/executor/state.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::executor::arrival_refused);
GODWIT_DEFINE_MESSAGE(godwit::executor::assignment_kept);
GODWIT_DEFINE_MESSAGE(godwit::executor::assignment_rejected);
GODWIT_DEFINE_MESSAGE(godwit::executor::change_answered);
GODWIT_DEFINE_MESSAGE(godwit::executor::change_asked);
GODWIT_DEFINE_MESSAGE(godwit::executor::change_commanded);
GODWIT_DEFINE_MESSAGE(godwit::executor::change_flown);
GODWIT_DEFINE_MESSAGE(godwit::executor::change_resolved);
GODWIT_DEFINE_MESSAGE(godwit::executor::change_stopped);
GODWIT_DEFINE_MESSAGE(godwit::executor::home_commanded);
GODWIT_DEFINE_MESSAGE(godwit::executor::home_kept);
GODWIT_DEFINE_MESSAGE(godwit::executor::last_line_brought);
GODWIT_DEFINE_MESSAGE(godwit::executor::deletion_told);
GODWIT_DEFINE_MESSAGE(godwit::executor::mission_arrived);
GODWIT_DEFINE_MESSAGE(godwit::executor::mission_taken);
GODWIT_DEFINE_MESSAGE(godwit::executor::person_acted);
GODWIT_DEFINE_MESSAGE(godwit::executor::state_set_again);
GODWIT_DEFINE_MESSAGE(godwit::executor::start_resolved);
GODWIT_DEFINE_MESSAGE(godwit::executor::state);
GODWIT_DEFINE_MESSAGE(godwit::executor::station_fence_taken);
GODWIT_DEFINE_MESSAGE(godwit::executor::station_plan_dropped);
GODWIT_DEFINE_MESSAGE(godwit::executor::station_plan_taken);
GODWIT_DEFINE_MESSAGE(godwit::executor::station_rally_taken);
GODWIT_DEFINE_MESSAGE(godwit::executor::station_took_over);
GODWIT_DEFINE_MESSAGE(godwit::executor::phase_status);
GODWIT_DEFINE_MESSAGE(godwit::executor::task_begun);
GODWIT_DEFINE_MESSAGE(godwit::executor::task_ended);
