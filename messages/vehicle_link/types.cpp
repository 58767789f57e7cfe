// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/vehicle_link/types.hpp"

#include "messages/vehicle_link/command.hpp"
#include "messages/vehicle_link/connection.hpp"
#include "messages/vehicle_link/evidence.hpp"
#include "messages/vehicle_link/transfer.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::vehicle_link, cancel_transfer, clear_plan, command_outcome, connection,
                       connection_changed, download_plan, foreign_act, get_connection, keep_vehicle, line_findings,
                       look, looked, picture_taken, relayed_frame, send_command, set_current_item, set_mode,
                       set_up_signing, signing_answer, signing_alert, upload_plan, vehicle_restarted, wake,
                       watch_closely);
GODWIT_DEFINE_MESSAGES(godwit::vehicle_link::transfer, outcome, progress);
