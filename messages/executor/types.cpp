// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/executor/types.hpp"
#include "messages/executor/flight.hpp"
#include "messages/executor/known_missions.hpp"
#include "messages/executor/plan_view.hpp"
#include "messages/executor/station_act.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::executor::act_acknowledged);
GODWIT_DEFINE_MESSAGE(godwit::executor::act_answer);
GODWIT_DEFINE_MESSAGE(godwit::executor::act_resolved);
GODWIT_DEFINE_MESSAGE(godwit::executor::current_answer);
GODWIT_DEFINE_MESSAGE(godwit::executor::flight_status);
GODWIT_DEFINE_MESSAGE(godwit::executor::get_flight);
GODWIT_DEFINE_MESSAGE(godwit::executor::get_missions);
GODWIT_DEFINE_MESSAGE(godwit::executor::get_plan);
GODWIT_DEFINE_MESSAGE(godwit::executor::get_preflight);
GODWIT_DEFINE_MESSAGE(godwit::executor::known_missions);
GODWIT_DEFINE_MESSAGE(godwit::executor::plan_cleared);
GODWIT_DEFINE_MESSAGE(godwit::executor::plan_taken);
GODWIT_DEFINE_MESSAGE(godwit::executor::plan_view);
GODWIT_DEFINE_MESSAGE(godwit::executor::preflight_view);
GODWIT_DEFINE_MESSAGE(godwit::executor::set_current);
GODWIT_DEFINE_MESSAGE(godwit::executor::start_answer);
GODWIT_DEFINE_MESSAGE(godwit::executor::start_mission);
GODWIT_DEFINE_MESSAGE(godwit::executor::station_act);
GODWIT_DEFINE_MESSAGE(godwit::executor::tick);
GODWIT_DEFINE_MESSAGE(godwit::executor::way_home_estimate);
