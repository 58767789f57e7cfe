// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/fleet_link/types.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::fleet_link::broker_closed);
GODWIT_DEFINE_MESSAGE(godwit::fleet_link::broker_opened);
GODWIT_DEFINE_MESSAGE(godwit::fleet_link::event_taken);
GODWIT_DEFINE_MESSAGE(godwit::fleet_link::fleet_view);
GODWIT_DEFINE_MESSAGE(godwit::fleet_link::get_fleet);
GODWIT_DEFINE_MESSAGE(godwit::fleet_link::text_left);
