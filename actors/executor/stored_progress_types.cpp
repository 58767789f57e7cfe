// What the journal keeps of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/executor/progress/effects.hpp"
#include "actors/executor/progress/events.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::executor::progress::act_told);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::came_down);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::current_told);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::look_at_vehicle);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::earlier_reports_told);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::found_begun);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::mission_aborted);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::mission_opened);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::progress_event);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::other_plan_found);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::picture_told);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::plan_read_back);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::reached_told);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::read_plan_back);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::resolve_start);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::start_ended);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::start_intended);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::upload_ended);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::upload_intended);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::vehicle_looked_at);
GODWIT_DEFINE_MESSAGE(godwit::executor::progress::vehicle_rebooted);
