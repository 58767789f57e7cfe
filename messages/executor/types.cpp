// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/executor/types.hpp"
#include "messages/executor/flight.hpp"
#include "messages/executor/known_missions.hpp"
#include "messages/executor/plan_view.hpp"
#include "messages/executor/station_act.hpp"
#include "messages/executor/traffic.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::executor, act_acknowledged, act_answer, act_resolved, current_answer, flight_status,
                       get_flight, get_missions, get_plan, get_preflight, get_traffic, heard_traffic, known_missions,
                       plan_cleared, plan_taken, plan_view, preflight_view, set_current, start_answer, start_mission,
                       station_act, tick, way_home_estimate);
