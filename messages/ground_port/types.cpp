// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/ground_port/types.hpp"

#include "messages/ground_port/mission.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::ground_port::get_port);
GODWIT_DEFINE_MESSAGE(godwit::ground_port::item_reached);
GODWIT_DEFINE_MESSAGE(godwit::ground_port::mission_progress);
GODWIT_DEFINE_MESSAGE(godwit::ground_port::operator_link);
GODWIT_DEFINE_MESSAGE(godwit::ground_port::plan_judged);
GODWIT_DEFINE_MESSAGE(godwit::ground_port::port_description);
GODWIT_DEFINE_MESSAGE(godwit::ground_port::set_mission);
GODWIT_DEFINE_MESSAGE(godwit::ground_port::status_text);
GODWIT_DEFINE_MESSAGE(godwit::ground_port::wake);
