// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/ground_port/types.hpp"

#include "messages/ground_port/mission.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::ground_port, get_port, item_reached, mission_progress, operator_link, plan_judged,
                       port_description, set_mission, status_text, wake);
