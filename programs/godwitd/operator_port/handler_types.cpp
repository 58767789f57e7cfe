// The message types of the operator's handlers, their JSON and binary forms (runtime/define_message.hpp).
#include "programs/godwitd/operator_port/mission_handler.hpp"
#include "programs/godwitd/operator_port/operator_handler.hpp"
#include "programs/godwitd/operator_port/view_handler.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::operator_port, api_request, mission_upload, view_request);
