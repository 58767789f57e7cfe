// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/vehicle_link/types.hpp"

#include "messages/vehicle_link/command.hpp"
#include "messages/vehicle_link/connection.hpp"
#include "messages/vehicle_link/evidence.hpp"
#include "messages/vehicle_link/transfer.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::cancel_transfer);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::clear_plan);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::command_outcome);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::connection);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::connection_changed);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::download_plan);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::foreign_act);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::get_connection);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::keep_vehicle);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::line_findings);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::look);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::looked);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::relayed_frame);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::send_command);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::set_current_item);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::set_mode);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::set_up_signing);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::signing_answer);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::signing_alert);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::upload_plan);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::vehicle_restarted);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::wake);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::watch_closely);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::transfer::outcome);
GODWIT_DEFINE_MESSAGE(godwit::vehicle_link::transfer::progress);
