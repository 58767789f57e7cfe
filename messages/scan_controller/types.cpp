// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/scan_controller/types.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::scan_controller::candidate);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::candidate_answer);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::decide_answer);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::decide_point);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::get_points);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::point_closed);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::point_shown);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::points);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::survey_progress);
GODWIT_DEFINE_MESSAGE(godwit::scan_controller::view);
