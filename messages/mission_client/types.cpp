// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/mission_client/types.hpp"

#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::mission_client, accept_copy, assignment_arrived, begin_mission, begin_next,
                       change_outcome, deliver_picture, get_service, insert_waypoint, map_pulled, mission_deleted,
                       earlier_found, mission_loaded, mission_refused, mission_resolved, picture_noted, pull_map,
                       push_map, replace_tail, report_progress, respond_to_assignment, retry_answer, retry_outbox,
                       service_status, wake);
