// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/mission_client/types.hpp"

#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::mission_client::accept_copy);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::assignment_arrived);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::begin_mission);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::change_outcome);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::get_service);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::insert_waypoint);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::map_pulled);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::mission_deleted);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::earlier_found);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::mission_loaded);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::mission_refused);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::mission_resolved);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::pull_map);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::push_map);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::replace_tail);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::report_progress);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::respond_to_assignment);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::retry_answer);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::retry_outbox);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::service_status);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::wake);
