// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/fleet_link/types.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::fleet_link, broker_closed, broker_opened, event_taken, fleet_view, get_fleet, text_left);
