// The message types of the operator's desks, their JSON and binary forms (runtime/define_message.hpp).
#include "programs/godwitd/operator_port/mission_desk.hpp"
#include "programs/godwitd/operator_port/operator_desk.hpp"
#include "programs/godwitd/operator_port/view_desk.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::operator_port, api_request, mission_upload, view_request);
